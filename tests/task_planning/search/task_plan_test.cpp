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
  EXPECT_EQ(plan.at(-1.), VectorXd(plan.path.row(0)));
  EXPECT_EQ(plan.at(7.), VectorXd(plan.path.row(2)));
  EXPECT_EQ(plan.at(.5), VectorXd(Eigen::Vector2d(1., 1.)));
  EXPECT_EQ(plan.at(2.), VectorXd(Eigen::Vector2d(2., 3.)));
}

TEST(TaskPlan, WithoutAMotionItSaysWhy) {
  TaskPlan plan;
  plan.message = "the goal is too far";
  EXPECT_EQ(plan.duration(), 0.);
  EXPECT_EQ(plan.why(), "the goal is too far");
  expectError<ValueError>([&] { plan.at(0.); }, {"at: there is no motion; the goal is too far"});
  expectError<ValueError>([&] { plan.repair(Config()); }, {"was not made by planTask"});
}

TEST(TaskPlan, TheTextListsActionsThenCauses) {
  TaskPlan plan = twoRows();
  plan.message = "1 action";
  plan.actions = {{"pick", "cup", "table", "hand"}};
  plan.causes = {{"too wide", 3}, {"too far", 1}};
  EXPECT_EQ(plan.str(), "solved: 1 action\n  1. (pick cup table hand)\n  3 x too wide\n  1 x too far");
  EXPECT_EQ(plan.why(), "too wide (3 branches)\ntoo far (1 branches)");
}

TEST(TaskPlan, BranchesWithACommonBeginningAreOneTree) {
  const TaskAction a = {"a"}, b = {"b"}, c = {"c"};
  EXPECT_EQ(treeText({{{a, b}, "x", nullptr}, {{a, c}, "", nullptr}, {{a}, "y", nullptr}}),
            "(a)\n  (b): x\n  (c): found\n(a): y");
  EXPECT_EQ(treeText({}), "");
}

}  // namespace
}  // namespace kinegraph
