#include "kinegraph/task_planning/search/plan_task.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/task_planning/task_tools.h"
#include "tests/support/expect_error.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

Config pandaAndCup() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("cup", "table").setRelativePosition({-.3, .25, .1}).setShape(ShapeType::ssBox, {.05, .05, .1, .005});
  C.getFrame("cup").setJoint(JointType::rigid).setContact(1);
  C.addFrame("tray", "table").setRelativePosition({0., .45, .055}).setShape(ShapeType::ssBox, {.2, .2, .01, .004});
  C.getFrame("tray").setContact(1);
  return C;
}

std::vector<std::string> namesOf(const TaskPlan& plan) {
  std::vector<std::string> names;
  for (const TaskAction& action : plan.actions) names.push_back(action[0]);
  return names;
}

TEST(PlanTask, ATowerIsBuiltAndTheCheckerAgrees) {
  const Config C = cubesOnATable(3);
  const MatrixXd before = C.getFrameState();
  const TaskPlan plan = planTask(C, "(on b0 b1) (on b1 b2)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"pick", "place", "pick", "place"}));
  EXPECT_TRUE(checkTaskPlan(C, plan).empty());
  EXPECT_EQ(C.getFrameState(), before);
  EXPECT_EQ(plan.path.rows(), plan.segments.back().end);
  EXPECT_EQ(plan.waypoints.rows(), 4);
  EXPECT_EQ(plan.scenes.size(), 4u);
  EXPECT_EQ(plan.attachments[0].second, plan.actions[0][1]);
}

TEST(PlanTask, APandaPutsACupOntoATrayInASceneThatSaysNothingOfLogic) {
  const TaskPlan plan = planTask(pandaAndCup(), "(on tray cup)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"pick", "place"}));
  EXPECT_TRUE(checkTaskPlan(pandaAndCup(), plan).empty());
}

TEST(PlanTask, APlanDoesNotDependOnThreads) {
  const Config C = cubesOnATable(3);
  const TaskPlan one = planTask(C, "(on b0 b1) (on b1 b2)", {.seed = 4});
  for (const int threads : {2, 4}) {
    const TaskPlan other = planTask(C, "(on b0 b1) (on b1 b2)", {.seed = 4, .threads = threads});
    EXPECT_EQ(other.path, one.path);
    EXPECT_EQ(other.times, one.times);
    EXPECT_EQ(other.evaluations, one.evaluations);
    EXPECT_EQ(other.str(), one.str());
  }
}

TEST(PlanTask, PlansGetFasterAsLongAsEffortIsGiven) {
  const Config C = cubesOnATable(2);
  TaskPlans plans = planTasks(C, "(on b0 b1)", {.max_evaluations = 1500});
  double before = std::numeric_limits<double>::infinity();
  int count = 0;
  while (const auto plan = plans.next()) {
    EXPECT_LT(plan->duration(), before);
    EXPECT_TRUE(checkTaskPlan(C, *plan).empty());
    before = plan->duration();
    ++count;
  }
  EXPECT_GT(count, 1);
  EXPECT_FALSE(plans.next());
}

TEST(PlanTask, AnActionOfOnesOwnWithVariants) {
  const Config C = pandaAndCup();
  TaskOptions options;
  options.domain = defaultDomain();
  addAction(*options.domain, "show", {"Obj", "Hand"}, "(is_gripper Hand) (is_object Obj) (on Hand Obj)", "(shown Obj)");
  EXPECT_THROW(planTask(C, "(shown cup)", options), ValueError);
  options.rules["show"] = {
      [](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
        const double height = variant == "high" ? 1.1 : 3.;
        const MatrixXd up = Eigen::RowVector3d(0., 0., 10.);
        w.komo().addObjective({time}, FeatureSymbol::position, {action[1]}, ObjectiveType::eq, up, {0., 0., height});
      },
      [](const Config&, const TaskAction&) {
        return std::vector<std::string>{"too high", "high"};
      }};
  const TaskPlan plan = planTask(C, "(shown cup)", options);
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"pick", "show"}));
  Config last = plan.scenes.back();
  last.setJointState(plan.waypoints.row(1));
  EXPECT_NEAR(last.getFrame("cup").getPosition().z(), 1.1, 1e-3);
}

TEST(PlanTask, WhatIsImpossibleIsProvedWithItsCause) {
  Config C = cubesOnATable(2);
  C.addFrame("far", "base", "shape: ssBox, size: [.2 .2 .01 .004], rel: [3 0 .005], logical: { is_place }");
  const TaskPlan far = planTask(C, "(on far b0)");
  EXPECT_EQ(far.status, TaskStatus::infeasible);
  EXPECT_NE(far.message.find("'far' is at least"), std::string::npos) << far.message;
  EXPECT_EQ(far.path.rows(), 0);
  const TaskPlan twice = planTask(C, "(on b1 b0) (on table b0)");
  EXPECT_EQ(twice.status, TaskStatus::infeasible);
  EXPECT_NE(twice.message.find("no sequence of actions reaches"), std::string::npos) << twice.message;
}

TEST(PlanTask, WhatIsBeyondReachIsPulledWithAStick) {
  const Config C = stickAndBox(.3);
  const TaskPlan plan = planTask(C, "(on hand box)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"pick", "hook_start", "hook_end", "place", "pick"}));
  EXPECT_TRUE(checkTaskPlan(C, plan).empty());
  const TaskPlan near = planTask(stickAndBox(.05), "(on hand box)");
  EXPECT_EQ(namesOf(near), std::vector<std::string>{"pick"}) << "without the stick where that is not needed";
}

TEST(PlanTask, WhatHasSlippedIntoTheModelOfTheHandIsPutDown) {
  Config C = drawerAndCup();
  C.getFrame("cup").setParent(C.getFrame("gripper")).setJoint(JointType::rigid).setRelativePosition({0., 0., .015});
  EXPECT_FALSE(wedgedPairs(C, {"gripper"}, {"cup"}, 1e-3).empty());
  TaskPlan plan = planTask(C, "(on table cup)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_TRUE(checkTaskPlan(C, plan).empty());
  plan.actions.push_back({"pick", "cup", "table", "gripper"});  // the hand has not gone away from it
  plan.segments.push_back({plan.path.rows() - 1, plan.path.rows()});
  ASSERT_FALSE(checkTaskPlan(C, plan).empty());
  EXPECT_NE(checkTaskPlan(C, plan)[0].find("overlap still"), std::string::npos);
}

TEST(PlanTask, WhatIsBeyondReachWithAStickTooIsProvedSo) {
  const TaskPlan plan = planTask(stickAndBox(.95), "(on hand box)");
  EXPECT_EQ(plan.status, TaskStatus::infeasible);
  EXPECT_NE(plan.message.find("beyond the reach of 'hand', with 'stick', too"), std::string::npos) << plan.message;
}

TEST(PlanTask, NothingIsPulledUpAStep) {
  Config C = stickAndBox(.3);
  C.addFrame("step", "base", "shape: ssBox, size: [.4 .4 .02 .004], rel: [.3 -.3 .01], logical: { is_place }");
  const TaskPlan plan = planTask(C, "(on step box)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(plan.actions.back()[0], "place");
  for (const TaskAction& action : plan.actions) EXPECT_FALSE(action[0] == "hook_end" && action[3] == "step");
}

TEST(PlanTask, ADrawerIsOpenedBecauseTheGeometrySaysSo) {
  const Config C = drawerAndCup();
  const TaskPlan plan = planTask(C, "(on floor cup) (closed drawer)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"hold", "open", "pick", "place", "hold", "close"}));
  EXPECT_TRUE(checkTaskPlan(C, plan).empty());
  EXPECT_NE(plan.explain().find("while (closed drawer): (place cup gripper floor)"), std::string::npos)
      << plan.explain();
  const Eigen::Index drawer = 4;
  const RowRange opening = plan.segments[1];
  EXPECT_LE(plan.path(opening.end - 1, drawer), -.8 * .3);
  EXPECT_NEAR(plan.path(plan.path.rows() - 1, drawer), 0., .05 * .3);
  for (const std::size_t still : {0u, 2u, 3u, 4u}) {
    const auto column = plan.path.col(drawer).segment(plan.segments[still].begin, plan.segments[still].size());
    EXPECT_EQ(column.maxCoeff(), column.minCoeff()) << still;
  }
}

TEST(PlanTask, WhatStandsInADrawerGoesAlong) {
  Config C = drawerAndCup();
  C.getFrame("cup").setParent(C.getFrame("floor")).setRelativePosition({0., 0., .06});
  const TaskPlan plan = planTask(C, "(opened drawer)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"hold", "open"}));
  C.setJointState(plan.path.row(plan.path.rows() - 1));
  EXPECT_LE(C.getFrame("cup").getPosition().y(), .48 - .8 * .3);
  EXPECT_TRUE(planTask(C, "(opened drawer)").actions.empty());
}

TEST(PlanTask, PlansWithDoorsDoNotDependOnThreads) {
  const TaskPlan one = planTask(drawerAndCup(), "(on floor cup)"),
                 other = planTask(drawerAndCup(), "(on floor cup)", {.threads = 4});
  ASSERT_TRUE(one.feasible()) << one.str();
  EXPECT_EQ(other.path, one.path);
  EXPECT_EQ(other.str(), one.str());
}

TEST(PlanTask, WhyADoorCannotBeMovedIsProved) {
  const auto message = [](const Config& C, const std::string& goal) {
    const TaskPlan plan = planTask(C, goal);
    EXPECT_EQ(plan.status, TaskStatus::infeasible) << plan.str();
    return plan.message;
  };
  Config C = drawerAndCup();
  C.addFrame("post", "base", "shape: ssBox, size: [.03 .03 .2 .004], contact: 1, rel: [.1 .2 .1]");
  EXPECT_EQ(message(C, "(opened drawer)"), "'drawer' meets 'post' at 24 % of its range");
  C.getFrame("drawer").setJointState(VectorXd::Constant(1, -.15));  // the post is behind the front now
  C.getFrame("post").setRelativePosition({.1, .245, .1});
  EXPECT_NE(message(C, "(closed drawer)").find("'drawer' meets 'post' at 7 % of its range"), std::string::npos);
  C = drawerAndCup();
  C.getFrame("rail").setRelativePosition({0., 1.6, 0.});
  EXPECT_NE(message(C, "(opened drawer)").find("'handle' is at least "), std::string::npos);
  C = drawerAndCup();
  C.getFrame("handle").setShape(ShapeType::ssBox, {.1, .1, .1, .004});
  EXPECT_EQ(message(C, "(opened drawer)"), "'handle' is wider than 'gripper' opens (0.090 m) along all of its axes");
  C.getFrame("handle").editAttributes().nodes.clear();
  EXPECT_EQ(message(C, "(opened drawer)"), "'drawer' has no part labeled is_handle");
  EXPECT_NE(message(C, "(opened table)").find("'table' is no door or drawer"), std::string::npos);
}

TEST(PlanTask, WhatIsInADrawerIsNotTheDrawer) {
  Config C = drawerAndCup();
  C.getFrame("drawer").setJointState(VectorXd::Constant(1, -.29));
  C.getFrame("cup").setShape(ShapeType::ssBox, {.06, .06, .25, .004});
  C.getFrame("cup").setParent(C.getFrame("floor")).setRelativePosition({0., -.08, .135});  // higher than the case
  C.addFrame("tray", "base", "shape: ssBox, size: [.2 .2 .01 .004], rel: [.6 -.5 .005], logical: { is_place }");
  const TaskPlan plan = planTask(C, "(on tray cup) (closed drawer)");
  ASSERT_TRUE(plan.feasible()) << plan.str();
  EXPECT_EQ(namesOf(plan), (std::vector<std::string>{"pick", "place", "hold", "close"}));
  const TaskPlan within = planTask(C, "(on floor cup) (closed drawer)", {.max_evaluations = 3000});
  EXPECT_EQ(within.status, TaskStatus::no_plan_found) << "that is no proof";
}

TEST(PlanTask, AGoalThatHoldsAndEffortThatEnds) {
  const Config C = cubesOnATable(2);
  const TaskPlan done = planTask(C, "(on table b0)");
  EXPECT_TRUE(done.feasible() && done.actions.empty() && done.message.empty());
  EXPECT_EQ(done.warnings, std::vector<std::string>{"the goal already holds"});
  EXPECT_EQ(done.path, MatrixXd(C.getJointState().transpose()));
  const TaskPlan none = planTask(C, "(on b0 b1)", {.time_limit = 0.});
  EXPECT_TRUE(none.feasible() || none.status == TaskStatus::timeout) << none.message;
}

TEST(PlanTask, ItGoesOnFromAnotherScene) {
  const Config C = cubesOnATable(2);
  const TaskPlan plan = planTask(C, "(on b0 b1)");
  Config moved = C;
  moved.getFrame("b1").setRelativePosition({.5, .5, .1});
  const TaskPlan repaired = plan.repair(moved);
  ASSERT_TRUE(repaired.feasible());
  EXPECT_TRUE(checkTaskPlan(moved, repaired).empty());
  EXPECT_FALSE(checkTaskPlan(moved, plan).empty());
}

TEST(PlanTask, MistakesAreToldBeforeAnythingIsSearched) {
  const Config C = cubesOnATable(2);
  expectError<ParseError>([&] { planTask(C, "(on b0 b7)"); }, {"unknown symbol 'b7' in the goal"});
  expectError<ValueError>([&] { planTask(C, "(on b0 b1)", {.threads = 0}); }, {"threads is 0; expected 1 or more"});
  expectError<ValueError>([&] { planTask(C, "(on b0 b1)", {.velocity = Eigen::Vector2d(1., 1.)}); },
                          {"velocity has 2 numbers; expected one, or 3"});
  TaskOptions options;
  options.domain = readFol(R"(is_object on
    DecisionRule pick { Obj, { (is_object Obj) } { (on Obj Obj) } })");
  expectError<ValueError>([&] { planTask(C, "(on b0 b0)", options); }, {"expected (pick obj from hand)"});
}

TEST(PlanTask, BetweenMayEndIt) {
  TaskOptions options;
  options.cancellation = [] { throw std::runtime_error("pressed"); };
  EXPECT_THROW(planTask(cubesOnATable(3), "(on b0 b1) (on b1 b2)", options), std::runtime_error);
}

}  // namespace
}  // namespace kinegraph
