#include "kinegraph/task_planning/manipulation_helper.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"

namespace kinegraph {
namespace {

Config pandaAndBox() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("box", "table").setRelativePosition({-.25, .3, .11}).setShape(ShapeType::ssBox, {.06, .05, .12, .005});
  C.getFrame("box").setJoint(JointType::rigid).setContact(1);
  C.addFrame("goal", "table").setRelativePosition({.3, .3, .055}).setShape(ShapeType::ssBox, {.2, .2, .01, .004});
  return C;
}

TEST(ManipulationHelper, PicksAndPlacesABoxWhereItIsTold) {
  const Config C = pandaAndBox();
  ManipulationHelper m;
  m.setup_pick_and_place_waypoints(C, "l_gripper", "box");
  m.grasp_box(1., "l_gripper", "box", "l_palm", "x");
  m.place_box(2., "box", "goal", "l_palm", "z");
  m.target_relative_xy_position(2., "box", "goal", Eigen::Vector2d(.02, -.03));
  ASSERT_TRUE(m.solve(0).feasible);
  const Config end = m.komo->configuration(1);
  const Pose X = end.getFrame("goal").getPose().inverse() * end.getFrame("box").getPose();
  EXPECT_LT((X.p - Vector3d(.02, -.03, .065)).norm(), 2e-3);
  const ManipulationHelper motion = m.sub_motion(1);
  EXPECT_EQ(motion.komo->slices(), 50);
  EXPECT_EQ(motion.komo->configuration(0).getFrame("box").getParent()->getName(), "box_grasp");
}

TEST(ManipulationHelper, NormsOfFramesThatAreAddedLaterAreNoRows) {
  const Config C = pandaAndBox();
  ManipulationHelper m;
  m.setup_sequence(C, 2.);
  const auto rows = m.komo->nlp()->types().size();
  m.add_stable_frame(JointType::free, "l_gripper", "grasp", "box");
  EXPECT_EQ(m.komo->nlp()->types().size(), rows);
  m.komo->addQuaternionNorms();
  EXPECT_EQ(m.komo->nlp()->types().size(), rows + 2);
}

TEST(ManipulationHelper, SaysWhatIsMissing) {
  ManipulationHelper m;
  EXPECT_THROW(m.grasp_top_box(1., "a", "b"), Error);
  m.setup_inverse_kinematics(pandaAndBox());
  EXPECT_THROW(m.grasp_top_box(1., "l_gripper", "box", "xx"), ValueError);
  EXPECT_THROW(m.place_box(1., "box", "l_gripper", ""), ValueError);
  EXPECT_THROW(m.retract({.5}, "l_gripper"), ValueError);
}

}  // namespace
}  // namespace kinegraph
