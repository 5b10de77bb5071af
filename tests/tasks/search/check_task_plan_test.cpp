#include "kinegraph/tasks/search/check_task_plan.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/tasks/task_scenes.h"

namespace kinegraph {
namespace {

/// A ball in space that is a hand, and one that it takes.
Config ballAndHand() {
  Config C;
  C.addFrame("world");
  C.addFrame("hand", "world", "shape: sphere, size: [.01], contact: 1, joint: trans3, limits: [-1 -1 -1 1 1 1]");
  C.addFrame("obj", "world").setRelativePosition({.9, 0., 0.}).setShape(ShapeType::sphere, {.02});
  C.getFrame("obj").setJoint(JointType::rigid);
  return C;
}

TaskPlan reaching(double x) {
  TaskPlan plan;
  plan.actions = {{"pick", "obj", "table", "hand"}};
  plan.path = MatrixXd{{0., 0., 0.}, {x, 0., 0.}};
  plan.times = Eigen::Vector2d(0., 1.);
  plan.segments = {{0, 2}};
  return plan;
}

std::string firstOf(const std::vector<std::string>& lines) { return lines.empty() ? "" : lines[0]; }

TEST(CheckTaskPlan, WhatIsTakenIsTouchedToAMillimeter) {
  const Config C = ballAndHand();
  EXPECT_EQ(firstOf(checkTaskPlan(C, reaching(.87))), "");
  EXPECT_EQ(firstOf(checkTaskPlan(C, reaching(.85))),
            "(pick obj table hand): the hand is 0.0200 m away from what it takes");
}

TEST(CheckTaskPlan, ItLooksBetweenRows) {
  Config C = ballAndHand();
  C.addFrame("foil").setPosition({.5, 0., 0.}).setShape(ShapeType::box, {.002, .5, .5}).setContact(1);
  EXPECT_NE(firstOf(checkTaskPlan(C, reaching(.87))).find("foil"), std::string::npos);
}

TEST(CheckTaskPlan, JumpsHasteAndJointsBeyondTheirLimitsAreTold) {
  const Config C = ballAndHand();
  TaskPlan plan = reaching(.87);
  plan.limits = MatrixXd{{1., 1., 1.}, {4., 4., 4.}};
  EXPECT_EQ(firstOf(checkTaskPlan(C, plan)), "");
  plan.times *= .5;
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("faster than its limit"), std::string::npos);
  plan.times *= 1.9;
  plan.limits.row(1).setConstant(1.5);
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("accelerates more"), std::string::npos);
  plan.path.col(1).setConstant(.1);
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("jumps where it begins"), std::string::npos);
  EXPECT_NE(firstOf(checkTaskPlan(C, reaching(1.2))).find("joint hand:0 is beyond its limits"), std::string::npos);
}

TEST(CheckTaskPlan, TheGoalHasToHoldInTheLastState) {
  TaskPlan plan = reaching(.87);
  plan.goal = {{"on", {"hand", "obj"}}, {"busy", {"hand"}, true}};
  const auto wrong = checkTaskPlan(ballAndHand(), plan, {{}, {{"busy", {"hand"}}}});
  ASSERT_EQ(wrong.size(), 2u);
  EXPECT_EQ(wrong[0], "the goal (on hand obj) does not hold after the last action");
  EXPECT_EQ(wrong[1], "the goal (busy hand)! does not hold after the last action");
}

TEST(CheckTaskPlan, PushingIsNotPullingNorLifting) {
  Config C;
  C.addFrame("table", "", "shape: ssBox, size: [4 4 .1 .02], contact: 1");
  C.addFrame("hand", "table", "shape: sphere, size: [.01], joint: trans3, limits: [-1 -1 0 1 1 1]");
  C.addFrame("obj", "table").setRelativePosition({0., 0., .1}).setShape(ShapeType::ssBox, {.1, .1, .1, .004});
  C.getFrame("obj").setJoint(JointType::rigid).setContact(1);
  const auto wrong = [&](const Vector3d& to, const Vector3d& from = Vector3d(-.06, 0., .1)) {
    C.setJointState(from);
    TaskPlan plan;
    plan.actions = {{"push_start", "obj", "table", "hand"}, {"push_end", "obj", "hand", "table"}};
    plan.path.resize(4, 3);
    plan.path.rowwise() = from.transpose();
    plan.path.row(3) = to;
    plan.times = Vector4d(0., 0., 0., 1.);
    plan.segments = {{0, 2}, {2, 4}};
    return firstOf(checkTaskPlan(C, plan));
  };
  EXPECT_EQ(wrong({.3, 0., .1}), "");
  EXPECT_NE(wrong({-.4, 0., .1}).find("'obj' is not pushed from behind"), std::string::npos);
  EXPECT_NE(wrong({-.06, .3, .1}).find("'obj' is not pushed from behind"), std::string::npos);
  EXPECT_NE(wrong({.3, 0., .2}).find("'obj' does not slide straight"), std::string::npos);
  EXPECT_NE(wrong({.3, 0., .16}, {-.03, 0., .16}).find("'obj' is not pushed from behind"), std::string::npos)
      << "a hand that lies on it";
}

TEST(CheckTaskPlan, WhatIsPulledIsPulledByAHookThatAHandHolds) {
  Config C = stickAndBox(.3);
  C.getFrame("stick").setRelativePosition({.015, .3 + .03 + .0155 - .235, .08});  // the hook is behind the box
  const Vector3d at = C.getFrame("stick").getPosition() - Vector3d(0., .2, .6);
  const auto wrong = [&](const Vector3d& way, bool is_held) {
    C.setJointState(at);
    TaskPlan plan;
    plan.actions = {{"hook_start", "box", "table", "hook", "stick", "hand"},
                    {"hook_end", "box", "hook", "table", "stick", "hand"}};
    plan.start = {{"is_gripper", {"hand"}}, {"is_object", {"stick"}}, {"is_object", {"box"}}};
    if (is_held) {
      plan.actions.insert(plan.actions.begin(), {"pick", "stick", "table", "hand"});
      plan.segments.push_back({0, 2});
    }
    plan.path.resize(6, 3);
    plan.path.rowwise() = at.transpose();
    for (int row = 3; row < 6; ++row) plan.path.row(row) = at + .5 * (row - 3) * way;
    plan.times = (VectorXd(6) << 0., 0., 0., 0., 1., 2.).finished();
    plan.segments.push_back({0, 2});
    plan.segments.push_back({3, 6});
    return firstOf(checkTaskPlan(C, plan));
  };
  const Vector3d back(0., -.2, 0.);
  EXPECT_EQ(wrong(back, true), "");
  EXPECT_NE(wrong(back, false).find("'hand' does not hold 'stick'"), std::string::npos);
  EXPECT_NE(wrong(-.5 * back, true).find("'box' is not pushed from behind"), std::string::npos)
      << "it is not hooked to it";
  EXPECT_NE(wrong({.2, 0., 0.}, true).find("'box' is not pushed from behind"), std::string::npos);
  EXPECT_NE(wrong({0., -.2, .1}, true).find("'box' does not slide straight"), std::string::npos);
}

TEST(CheckTaskPlan, PartsThatDoNotFitAreRefused) {
  const Config C = ballAndHand();
  TaskPlan plan = reaching(.87);
  plan.segments = {{0, 3}};
  expectError<ValueError>([&] { checkTaskPlan(C, plan); }, {"rows 0 to 3 of a path of 2"});
  plan.segments.clear();
  expectError<ValueError>([&] { checkTaskPlan(C, plan); }, {"0 segments for 1 actions"});
  plan = reaching(.87);
  plan.times = Vector3d::Zero();
  expectError<ValueError>([&] { checkTaskPlan(C, plan); }, {"shape (2, 3), and there are 3 times"});
  plan = reaching(.87);
  plan.actions = {{"pick", "obj"}};
  expectError<ValueError>([&] { checkTaskPlan(C, plan); }, {"(pick obj) has 1 words", "expected (pick obj from hand)"});
}

}  // namespace
}  // namespace kinegraph
