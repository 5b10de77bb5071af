#include "kinegraph/api/execution/task_execution.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"
#include "kinegraph/robot/drivers.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

Config pandaAndCubes() {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  const Vector3d places[] = {{-.3, .25, .075}, {.3, .3, .075}};
  for (int i = 0; i < 2; ++i) {
    Frame cube = C.addFrame("b" + std::to_string(i), "table").setRelativePosition(places[i]).setJoint(JointType::rigid);
    cube.setShape(ShapeType::ssBox, {.05, .05, .05, .004}).setContact(1).setMass(.1);
  }
  return C;
}

double heightOf(const Config& C) { return C.getFrame("b0").getPosition().z(); }

struct Stacking {
  Config C = pandaAndCubes();
  TaskPlan plan = planTask(C, "(on b1 b0)");
};

TEST(TaskExecution, ACubeIsPutOntoAnotherByForcesAlone) {
  Stacking s;
  ASSERT_TRUE(s.plan.feasible()) << s.plan.str();
  const double before = heightOf(s.C);
  BotOp bot(s.C);
  const TaskExecution run = s.plan.execute(bot);
  EXPECT_TRUE(run.feasible) << run.str();
  EXPECT_EQ(run.done, 2);
  EXPECT_EQ(run.str(), "reached the goal after 2 actions");
  EXPECT_EQ(run.C.getFrame("b0").getParent()->getName(), "b1");
  EXPECT_NEAR(heightOf(bot.getWorld()), before + .05, 1e-3);
  BotOp again(s.C);
  EXPECT_EQ(s.plan.execute(again).C.getFrameState(), run.C.getFrameState());
}

TEST(TaskExecution, WhatIsTakenOutOfTheHandIsNoticedAndRepaired) {
  Stacking s;
  const double before = heightOf(s.C);
  BotOp* robot = nullptr;
  bool is_taken = false;
  BotOpOptions options;
  options.show = [&](const BotOp&, Config& C, const std::string&) {
    if (is_taken || heightOf(C) < before + .06) return 0;
    is_taken = true;
    robot->setFramePose("b0", {{-.3, .1, .7}, Quaterniond::Identity()});
    return 0;
  };
  BotOp bot(s.C, std::make_shared<SimulatedDriver>(s.C), options);
  robot = &bot;
  const TaskExecution run = s.plan.execute(bot, {.repairs = 0});
  EXPECT_FALSE(run.feasible);
  EXPECT_EQ(run.done, 1);
  EXPECT_NE(run.message.find("'b0' is not in 'l_gripper'"), std::string::npos) << run.message;
  EXPECT_EQ(run.C.getFrame("b0").getParent()->getName(), "table");
  const TaskPlan repaired = s.plan.repair(run.C);
  ASSERT_TRUE(repaired.feasible()) << repaired.str();
  EXPECT_TRUE(repaired.execute(bot).feasible);
}

TEST(TaskExecution, StepsAreReportedAndAWorldThatIsDisturbedBetweenThemIsRepaired) {
  Stacking s;
  BotOp bot(s.C);
  Config seen = worldOf(bot, s.plan);
  TaskRun run(s.plan, bot, seen);
  std::vector<std::string> kinds;
  while (const std::optional<TaskEvent> event = run.next()) {
    kinds.push_back(taskEventName(event->kind));
    if (kinds.size() == 1) bot.setFramePose("b0", {{-.25, .12, .675}, Quaterniond::Identity()});
  }
  const std::vector<std::string> expected = {"start", "failure", "repair", "start", "motion",
                                             "grip",  "motion",  "grip",   "end"};
  EXPECT_EQ(kinds, expected);
  EXPECT_TRUE(run.result().feasible) << run.result().str();
  EXPECT_EQ(run.result().str(), "reached the goal after 2 actions and 1 repair");
  EXPECT_FALSE(run.next());
}

TEST(TaskExecution, ARobotThatIsElsewhereMovesToTheStart) {
  Stacking s;
  for (const double off : {.002, .05, .3}) {
    Config beside = s.C;
    const VectorXd signs = VectorXd::LinSpaced(7, -1., 1.).unaryExpr([](double x) { return x < 0. ? -1. : 1.; });
    beside.setJointState(s.C.getJointState() + off * signs);
    BotOp bot(beside);
    const TaskExecution run = s.plan.execute(bot);
    EXPECT_TRUE(run.feasible) << off << ": " << run.str();
    EXPECT_EQ(run.repairs, 0);
  }
}

TEST(TaskExecution, MotionsAreThoseOfThePlan) {
  Stacking s;
  const RowRange rows = s.plan.segments[0];
  const MatrixXd path = s.plan.path.middleRows(rows.begin, rows.size());
  double worst = 0.;
  int seen_at = 0;
  BotOpOptions options;
  options.show = [&](const BotOp&, Config& C, const std::string&) {
    const VectorXd q = C.getJointState();
    double nearest = 1.;
    for (Eigen::Index i = 0; i + 1 < path.rows(); ++i) {
      const VectorXd chord = path.row(i + 1) - path.row(i), offset = q - path.row(i).transpose();
      const double share = std::clamp(offset.dot(chord) / std::max(chord.squaredNorm(), 1e-30), 0., 1.);
      nearest = std::min(nearest, (offset - share * chord).cwiseAbs().maxCoeff());
    }
    worst = std::max(worst, nearest);
    ++seen_at;
    return 0;
  };
  BotOp bot(s.C, std::make_shared<KinematicDriver>(s.C), options);
  Config seen = worldOf(bot, s.plan);
  TaskRun run(s.plan, bot, seen);
  ASSERT_EQ(run.next()->kind, TaskEventKind::start);
  ASSERT_EQ(run.next()->kind, TaskEventKind::motion);
  EXPECT_GT(seen_at, 10);
  EXPECT_LT(worst, 1e-4);
}

TEST(TaskExecution, ACallerEndsIt) {
  Stacking s;
  BotOp bot(s.C);
  ExecutionOptions options;
  options.callback = [](const TaskEvent& event) { return event.kind != TaskEventKind::grip; };
  const TaskExecution run = s.plan.execute(bot, options);
  EXPECT_FALSE(run.feasible);
  EXPECT_EQ(run.done, 1);
  EXPECT_EQ(run.message, "the execution was stopped by its caller");
  EXPECT_EQ(run.C.getFrame("b0").getParent()->getName(), "l_gripper");
}

TEST(TaskExecution, AMotionThatMeetsTooMuchForceStops) {
  Stacking s;
  BotOp bot(s.C);
  ExecutionOptions options;
  options.repairs = 0;
  options.max_external_effort = VectorXd::Constant(1, 1e-6);
  const TaskExecution run = s.plan.execute(bot, options);
  EXPECT_NE(run.message.find("unexpected contact: joint '"), std::string::npos) << run.message;
  options.max_external_effort = VectorXd::Ones(3);
  expectError<ValueError>([&] { s.plan.execute(bot, options); }, {"max_external_effort has 3 numbers", "or 7"});
}

TEST(TaskExecution, CamerasThatLeaveObjectsOutAreBelieved) {
  Stacking s;
  BotOp bot(s.C);
  int looks = 0;
  ExecutionOptions options;
  options.observe = [&](Config&) {
    ++looks;
    const Config world = bot.getWorld();
    ObservedPoses poses;
    poses["b1"] = world.getFrame("b1").getPose();
    poses["b0"] = std::nullopt;
    return poses;
  };
  const TaskExecution run = s.plan.execute(bot, options);
  EXPECT_TRUE(run.feasible) << run.str();
  EXPECT_GT(looks, 5);
  EXPECT_NEAR((run.C.getFrame("b0").getPosition() - bot.getWorld().getFrame("b0").getPosition()).norm(), 0., .01);
}

TEST(TaskExecution, MistakesAreToldBeforeAnythingMoves) {
  Stacking s;
  Config light = s.C;
  light.getFrame("b0").setMass(0.);
  BotOp of_light(light);
  expectError<ValueError>([&] { s.plan.execute(of_light); }, {"'b0' has no mass"});
  BotOp bot(s.C);
  expectError<ValueError>([&] { TaskPlan().execute(bot); }, {"TaskPlan.execute", "the plan has no motion"});
  expectError<ValueError>([&] { TaskPlan().frames(s.C); }, {"TaskPlan.frames", "the plan has no motion"});
}

TEST(TaskView, FramesShowWhatIsHeldInTheHandAndEndWhereThePlanDoes) {
  Stacking s;
  const std::vector<MatrixXd> frames = s.plan.frames(s.C, 10.);
  EXPECT_EQ(long(frames.size()), std::lround(s.plan.duration() * 10.));
  Config C = s.C;
  C.setFrameState(frames.back());
  EXPECT_NEAR((C.getFrame("b0").getPosition() - C.getFrame("b1").getPosition()).z(), .05, 1e-3);
  double highest = 0.;
  for (const MatrixXd& poses : frames) {
    C.setFrameState(poses);
    highest = std::max(highest, heightOf(C));
    if (heightOf(C) < heightOf(s.C) + .06) continue;
    EXPECT_LT((C.getFrame("b0").getPosition() - C.getFrame("l_gripper").getPosition()).norm(), .05);
  }
  EXPECT_GT(highest, heightOf(s.C) + .06);
}

TEST(TaskView, TheFailedConfigurationIsThatOfTheLongestBranch) {
  Stacking s;
  Config there = s.C;
  there.getFrame("b0").setPosition({0., .3, 1.});
  TaskPlan failed;
  failed.message = "nothing";
  expectError<ValueError>([&] { failed.failedConfiguration(s.C); }, {"no branch failed"});
  failed.tree.push_back({{{"pick", "b0", "table", "l_gripper"}}, "why", std::make_shared<const Config>(there)});
  const Config shown = failed.failedConfiguration(s.C);
  EXPECT_EQ(shown.getFrames().size(), s.C.getFrames().size() + 1);
  EXPECT_EQ(shown.getFrame("failed b0").getPosition(), there.getFrame("b0").getPosition());
  EXPECT_EQ(shown.getFrame("failed b0").getShapeType(), ShapeType::ssBox);
}

}  // namespace
}  // namespace kinegraph
