#include "kinegraph/task_planning/search/plan_task.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/task_planning/task_scenes.h"

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
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("jumps at its beginning"), std::string::npos);
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

/// A hand that takes the handle from above, and pulls the drawer by `way` m.
TaskPlan pulling(Config& C, double way) {
  const Vector3d at = C.getFrame("handle").getPosition() - Vector3d(0., 0., .57);
  VectorXd q(5);
  q << at, 0., 0.;
  C.setJointState(q);
  TaskPlan plan;
  plan.actions = {{"hold", "drawer", "handle", "gripper"}, {"open", "drawer", "handle", "gripper"}};
  plan.start = {{"is_gripper", {"gripper"}}, {"is_object", {"cup"}}};
  plan.path = q.transpose().replicate(12, 1);
  plan.times = VectorXd::Zero(12);
  for (int i = 0; i < 10; ++i) {
    plan.path(2 + i, 1) -= way * i / 9.;
    plan.path(2 + i, 4) -= way * i / 9.;
    plan.times[2 + i] = .5 * i;
  }
  plan.segments = {{0, 2}, {2, 12}};
  return plan;
}

TEST(CheckTaskPlan, ADrawerMovesOnlyWithAHandThatHoldsItsHandle) {
  Config C = drawerAndCup();
  TaskPlan plan = pulling(C, .25);
  EXPECT_EQ(firstOf(checkTaskPlan(C, plan)), "");
  TaskPlan other = plan;
  other.actions.erase(other.actions.begin());
  other.segments.erase(other.segments.begin());
  EXPECT_NE(firstOf(checkTaskPlan(C, other)).find("'gripper' does not hold 'drawer'"), std::string::npos);
  other = plan;
  other.actions[1] = {"pose", "cup", "gripper", "cup"};
  EXPECT_NE(firstOf(checkTaskPlan(C, other)).find("'drawer' moves without being opened or closed"), std::string::npos);
  other = plan;
  other.path.col(0).segment(4, 3).array() += .0015;
  EXPECT_NE(firstOf(checkTaskPlan(C, other)).find("'gripper' slips on 'handle' by 0.0015 m"), std::string::npos);
  other = plan;
  other.path.col(3).segment(4, 3).array() += .02;
  EXPECT_NE(firstOf(checkTaskPlan(C, other)).find("'gripper' turns on 'handle'"), std::string::npos);
  other = plan;
  other.path.col(4).tail(10).setZero();
  EXPECT_NE(firstOf(checkTaskPlan(C, other)).find("'gripper' slips on 'handle'"), std::string::npos);
}

TEST(CheckTaskPlan, ADrawerIsOpenFromFourFifthsOfItsRangeOn) {
  Config C = drawerAndCup();
  EXPECT_NE(firstOf(checkTaskPlan(C, pulling(C, .2))).find("'drawer' is not opened: it is at 66.7 % of its range"),
            std::string::npos);
  TaskPlan plan = pulling(C, .25);
  plan.goal = {{"closed", {"drawer"}}, {"opened", {"drawer"}, true}};
  EXPECT_EQ(checkTaskPlan(C, plan).size(), 2u);
}

TEST(CheckTaskPlan, WhatIsTakenOfADoorIsItsHandle) {
  Config C = drawerAndCup();
  TaskPlan plan = pulling(C, .25);
  for (TaskAction& action : plan.actions) action[2] = "cup";
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("'cup' is no handle of a door"), std::string::npos);
}

TEST(CheckTaskPlan, WhatStandsInADrawerIsNotThrownAbout) {
  Config C = drawerAndCup();
  C.getFrame("cup").setParent(C.getFrame("floor")).setRelativePosition({0., 0., .06});
  TaskPlan plan = pulling(C, .25);
  EXPECT_EQ(firstOf(checkTaskPlan(C, plan)), "");
  plan.times *= .04;
  EXPECT_NE(firstOf(checkTaskPlan(C, plan)).find("'cup' is accelerated too much"), std::string::npos);
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
