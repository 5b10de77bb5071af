#include "kinegraph/task_planning/search/task_plan.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

TaskPlan twoRows() {
  TaskPlan plan;
  plan.status = TaskStatus::solved;
  plan.path = MatrixXd{{0., 1.}, {2., 1.}, {2., 5.}};
  plan.times = Vector3d(0., 1., 3.);
  return plan;
}

TEST(TaskPlan, ItsMotionIsStraightBetweenRowsAndHeldAtItsEnds) {
  const TaskPlan plan = twoRows();
  EXPECT_EQ(plan.duration(), 3.);
  EXPECT_EQ(plan.eval(-1.).q, VectorXd(plan.path.row(0)));
  EXPECT_EQ(plan.eval(7.).q, VectorXd(plan.path.row(2)));
  EXPECT_EQ(plan.eval(.5).q, VectorXd(Eigen::Vector2d(1., 1.)));
  EXPECT_EQ(plan.eval(2.).q, VectorXd(Eigen::Vector2d(2., 3.)));
}

TEST(TaskPlan, AsATrajectoryItsVelocityIsTheSlopeAndZeroAtItsEnds) {
  const TaskPlan plan = twoRows();
  EXPECT_EQ(plan.dimension(), 2);
  EXPECT_EQ(plan.eval(.5).velocity, VectorXd(Eigen::Vector2d(2., 0.)));
  EXPECT_EQ(plan.eval(1.).velocity, VectorXd(Eigen::Vector2d(0., 2.)));
  for (const double end : {-1., 0., 3., 7.}) EXPECT_EQ(plan.eval(end).velocity, VectorXd::Zero(2)) << end;
  const MotionStates states = plan.sample(1.);
  EXPECT_EQ(states.q, (MatrixXd{{0., 1.}, {2., 1.}, {2., 3.}, {2., 5.}}));
  EXPECT_EQ(states.acceleration, MatrixXd::Zero(4, 2));
}

TEST(TaskPlan, StatusesAreNamedAsTheyAreSpelled) {
  EXPECT_EQ(taskStatusName(TaskStatus::solved), "solved");
  EXPECT_EQ(taskStatusName(TaskStatus::infeasible), "infeasible");
  EXPECT_EQ(taskStatusName(TaskStatus::no_plan_found), "no_plan_found");
  EXPECT_EQ(taskStatusName(TaskStatus::timeout), "timeout");
}

TEST(TaskPlan, WithoutAMotionItSaysWhy) {
  TaskPlan plan;
  plan.message = "the goal is too far";
  EXPECT_EQ(plan.duration(), 0.);
  EXPECT_EQ(plan.explain().find("no_plan_found: the goal is too far\n"), 0u);
  expectError<ValueError>([&] { plan.eval(0.); }, {"TaskPlan.eval: the plan has no motion; the goal is too far"});
  expectError<ValueError>([&] { plan.repair(Config()); }, {"was not made by planTask"});
}

TEST(TaskPlan, APlanOfOnesOwnWithoutScenesCannotBePlayed) {
  TaskPlan plan = twoRows();
  plan.actions = {{"pick", "cup", "table", "hand"}};
  Config C;
  expectError<ValueError>([&] { plan.play(C); }, {"TaskPlan.play: the plan has 1 actions, 0 scenes and 0 segments"});
}

TEST(TaskPlan, TheTextListsActionsThenCauses) {
  TaskPlan plan = twoRows();
  plan.actions = {{"pick", "cup", "table", "hand"}};
  plan.causes = {{"too wide", 3}, {"too far", 1}};
  EXPECT_EQ(plan.str(), "solved: 1 action, 3.00 s\n  1. (pick cup table hand)\n  3 x too wide\n  1 x too far");
  EXPECT_NE(plan.explain().find("\ntoo wide (3 branches)\ntoo far (1 branch)"), std::string::npos);
}

TEST(TaskPlan, BranchesWithACommonBeginningAreOneTree) {
  const TaskAction a = {"a"}, b = {"b"}, c = {"c"};
  EXPECT_EQ(treeText({{{a, b}, "x", nullptr}, {{a, c}, "", nullptr}, {{a}, "y", nullptr}}),
            "(a)\n  (b): x\n  (c): plan\n(a): y");
  EXPECT_EQ(treeText({}), "");
}

}  // namespace
}  // namespace kinegraph
