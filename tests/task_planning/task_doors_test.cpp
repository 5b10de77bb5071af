#include "kinegraph/task_planning/task_doors.h"

#include <gtest/gtest.h>

#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TEST(TaskDoors, TheLimitNearerToZeroIsWhereADoorIsClosed) {
  Config C = drawerAndCup();
  const std::vector<TaskDoor> doors = doorsOf(C);
  ASSERT_EQ(doors.size(), 1u);
  EXPECT_EQ(doors[0].name, "drawer");
  EXPECT_EQ(C.getJointNames()[std::size_t(doors[0].dof)], "drawer");
  EXPECT_EQ(doors[0].closed, 0.);
  EXPECT_EQ(doors[0].open, -.3);
  EXPECT_EQ(doors[0].stateAt(-.014), "closed");
  EXPECT_EQ(doors[0].stateAt(-.016), "ajar");
  EXPECT_EQ(doors[0].stateAt(-.241), "opened");
  C.getFrame("drawer").setJoint(JointType::transY, {.1, .5});
  EXPECT_EQ(doorsOf(C)[0].closed, .1);
  C.getFrame("drawer").setJoint(JointType::transY);
  EXPECT_TRUE(doorsOf(C).empty()) << "without limits it is never open";
}

TEST(TaskDoors, FactsSayWhatIsTrueOfThem) {
  Config C = drawerAndCup();
  EXPECT_TRUE(contains(taskFacts(C), {"closed", {"drawer"}}));
  EXPECT_TRUE(contains(taskFacts(C), {"partOf", {"drawer", "handle"}}));
  C.getFrame("drawer").setJointState(VectorXd::Constant(1, -.15));
  EXPECT_TRUE(contains(taskFacts(C), {"ajar", {"drawer"}}));
  C.getFrame("drawer").setJointState(VectorXd::Constant(1, -.29));
  EXPECT_TRUE(contains(taskFacts(C), {"opened", {"drawer"}}));
}

TEST(TaskDoors, TheyStayWhereNothingMovesThem) {
  const Config C = drawerAndCup();
  MatrixXd waypoints = MatrixXd::Zero(4, 5);
  waypoints.col(4) << 1e-4, -.3001, -.28, -.01;
  const std::vector<TaskAction> actions = {{"hold", "drawer", "handle", "gripper"},
                                           {"open", "drawer", "handle", "gripper"},
                                           {"pick", "cup", "table", "gripper"},
                                           {"close", "drawer", "handle", "gripper"}};
  const MatrixXd settled = withSettledDoors(C, actions, waypoints);
  EXPECT_EQ(VectorXd(settled.col(4)), VectorXd(Vector4d(0., -.3, -.3, -.01)));
  EXPECT_EQ(settled.leftCols(4), waypoints.leftCols(4));
}

TEST(TaskDoors, AStillDrawerIsNoDof) {
  const Config C = drawerAndCup();
  const StillDoors still = withStillDoors(C, doorsOf(C));
  EXPECT_EQ(still.scene.getJointDimension(), 4);
  EXPECT_EQ(still.dofs, (std::vector<Eigen::Index>{0, 1, 2, 3}));
  EXPECT_EQ(C.getJointDimension(), 5);
}

TEST(TaskDoors, WhatADrawerIsMadeOfAndWhatItTakesAlong) {
  Config C = drawerAndCup();
  C.getFrame("cup").setParent(C.getFrame("floor"));
  EXPECT_EQ(partsOf(C, "drawer"), (std::vector<std::string>{"drawer", "floor", "front", "handle"}));
  EXPECT_EQ(movedBy(C, "drawer", {"cup", "table"}), std::vector<std::string>{"cup"});
}

}  // namespace
}  // namespace kinegraph
