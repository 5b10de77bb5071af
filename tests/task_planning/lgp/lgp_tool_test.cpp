#include "kinegraph/task_planning/lgp/lgp_tool.h"

#include "kinegraph/komo/komo.h"
#include "tests/support/expect_error.h"
#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {
namespace {

using Words = std::vector<std::string>;

TEST(LgpTool, TheTutorialWithOneArmFromWaypointsToMotions) {
  const LgpProblem problem("panda_unblock", "kitchen_single");
  LgpTool lgp(problem.C, problem.tamp);
  ASSERT_TRUE(lgp.solve(0)) << lgp.message;
  EXPECT_EQ(lgp.status, LgpStatus::solved);
  EXPECT_EQ(namesOf(lgp), (Words{"pick_touch", "place_straightOn", "pick_touch", "place_straightOn"}));
  const Config end = lgp.getSolvedKOMO()->configuration(3);
  for (const auto& [obj, tray] : {std::pair{"objG", "trayG"}, std::pair{"objB", "trayB"}}) {
    const Vector3d offset = end.getFrame(obj).getPosition() - end.getFrame(tray).getPosition();
    EXPECT_LT(offset.head<2>().cwiseAbs().maxCoeff(), .04);
    EXPECT_NEAR(offset.z(), .055, 2e-3);
  }
  EXPECT_EQ(lgp.get_piecewiseMotionProblem(1)->slices(), 30);
  EXPECT_EQ(lgp.get_fullMotionProblem()->slices(), 120);
  const std::vector<SolverResult> pieces = lgp.solvePiecewiseMotions(0);
  ASSERT_EQ(pieces.size(), 4u);
  ASSERT_EQ(lgp.paths.size(), 4u);
  const MatrixXd waypoints = lgp.getSolvedKOMO()->getPath();
  for (int i = 0; i < 4; ++i) EXPECT_LT((lgp.paths[std::size_t(i)].row(29) - waypoints.row(i)).norm(), .1);
}

TEST(LgpTool, TheTutorialWithTwoArmsHandsOver) {
  const LgpProblem problem("bimanual", "kitchen_handover");
  LgpTool lgp(problem.C, problem.tamp);
  ASSERT_TRUE(lgp.solve(0)) << lgp.message;
  EXPECT_EQ(namesOf(lgp), (Words{"pick_touch", "handover", "place_straightOn"}));
  EXPECT_EQ(lgp.getSolvedPlan().back().back(), "trayG");

  // In the waypoints the hands overlap; the motion does not start there.
  EXPECT_NE(sliceCollisions(*lgp.getSolvedKOMO(), 1, -.01), "");
  const SolverResult result = lgp.solveFullMotion(0);
  EXPECT_TRUE(result.feasible) << result.message;
  for (int t = 0; t < lgp.motion->slices(); ++t) EXPECT_EQ(sliceCollisions(*lgp.motion, t, -2e-3), "") << t;
  const Config end = lgp.motion->configuration(89);
  const Vector3d offset = end.getFrame("objG").getPosition() - end.getFrame("trayG").getPosition();
  EXPECT_LT(offset.head<2>().cwiseAbs().maxCoeff(), .04);
  EXPECT_NEAR(offset.z(), .055, 2e-3);
}

TEST(LgpTool, AMotionOverAllActionsEndsWhereTheWaypointsDo) {
  const LgpProblem problem("unblock");
  LgpTool lgp(problem.C, problem.tamp);
  ASSERT_TRUE(lgp.solve(0));
  const SolverResult result = lgp.solveFullMotion(0);
  EXPECT_TRUE(result.feasible) << result.message;
  EXPECT_EQ(lgp.path.rows(), 120);
  EXPECT_EQ(lgp.motion->getPath(), lgp.path);
  const Config end = lgp.motion->configuration(119);
  const Vector3d offset = end.getFrame("red").getPosition() - end.getFrame("padA").getPosition();
  EXPECT_NEAR(offset.z(), .5 * (end.getFrame("red").getSize()[2] + end.getFrame("padA").getSize()[2]), 1e-3);
}

TEST(LgpTool, WhatIsFoundDoesNotDependOnThreads) {
  std::vector<MatrixXd> waypoints, paths, pieces;
  std::vector<long> evaluations;
  for (const int threads : {1, 2, 4}) {
    const LgpProblem problem("unblock");
    LgpTool lgp(problem.C, problem.tamp, {.threads = threads});
    ASSERT_TRUE(lgp.solve(0));
    waypoints.push_back(lgp.getSolvedKOMO()->getPath());
    evaluations.push_back(lgp.evaluations());
    evaluations.push_back(lgp.solves());
    evaluations.push_back(lgp.solveFullMotion(0).evals);
    paths.push_back(lgp.path);
    lgp.solvePiecewiseMotions(0);
    pieces.push_back(lgp.paths.back());
  }
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_EQ(waypoints[i], waypoints[0]);
    EXPECT_EQ(paths[i], paths[0]);
    EXPECT_EQ(pieces[i], pieces[0]);
    for (const std::size_t k : {0u, 1u, 2u}) EXPECT_EQ(evaluations[3 * i + k], evaluations[k]);
  }
}

TEST(LgpTool, RepeatedCallsGiveFurtherPlansAndEnd) {
  const LgpProblem problem("gantry");
  LgpTool lgp(problem.C, problem.tamp);
  std::vector<LgpTool::Plan> plans;
  while (lgp.solve(0)) {
    EXPECT_EQ(std::count(plans.begin(), plans.end(), lgp.getSolvedPlan()), 0);
    plans.push_back(lgp.getSolvedPlan());
    ASSERT_LT(plans.size(), 10u);
  }
  EXPECT_FALSE(plans.empty());
  EXPECT_EQ(lgp.status, LgpStatus::no_plan_found);
  EXPECT_TRUE(lgp.hasPlan());
}

TEST(LgpTool, APushUpAStepIsNotFeasibleAndTheMessageSaysWhatIsMissed) {
  const LgpProblem problem("push");
  LgpTool lgp(problem.C, problem.tamp);
  EXPECT_FALSE(lgp.solve(0));
  EXPECT_EQ(lgp.status, LgpStatus::no_plan_found);
  EXPECT_NE(lgp.message.find("(end_push g_gripper disc table pad): "), std::string::npos) << lgp.message;
}

TEST(LgpTool, WhatIsTakenForSolvedCanBeSaidOtherwise) {
  const LgpProblem problem("push");
  LgpOptions options;
  options.accepts = [](const SolverResult& result) { return result.eq < .1 && result.ineq < .1; };
  LgpTool lgp(problem.C, problem.tamp, options);
  EXPECT_TRUE(lgp.solve(0)) << lgp.message;
}

TEST(LgpTool, AnAbstractionOfOnesOwnIsToldWhichPlansFail) {
  const LgpProblem problem("unblock");
  const auto tamp = std::make_shared<Reaches>(problem.C, std::vector{50., 1.});
  LgpTool lgp(problem.C, tamp);
  ASSERT_TRUE(lgp.solve(0)) << lgp.message;
  EXPECT_NEAR(lgp.getSolvedKOMO()->configuration(0).getFrame("hand").getPosition().z(), 1., 1e-3);
  ASSERT_EQ(tamp->forbidden.size(), 1u);
  EXPECT_EQ(std::stod(tamp->forbidden[0][0][1]), 50.);
  EXPECT_FALSE(lgp.solve(0));
  EXPECT_NE(lgp.message.find("position of hand is missed by 4"), std::string::npos) << lgp.message;
}

TEST(LgpTool, PlansThatFailedAreTriedAgainWhenThereIsNoFurtherOne) {
  struct Moody : Reaches {
    using Reaches::Reaches;
    void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& before,
                                const TaskAction& action) override {
      Reaches::add_action_constraints(komo, time, before, ++calls < 2 ? TaskAction{"reach", "50"} : action);
    }
    int calls = 0;
  };
  const LgpProblem problem("unblock");
  LgpTool lgp(problem.C, std::make_shared<Moody>(problem.C, std::vector{1.}));
  EXPECT_TRUE(lgp.solve(0)) << lgp.message;
  EXPECT_FALSE(lgp.solve(0));
}

TEST(LgpTool, WithoutAPlanInLogicItIsProvedImpossible) {
  const LgpProblem problem("unblock");
  LgpTool lgp(problem.C, std::make_shared<LgpAbstraction>(problem.C));
  EXPECT_EQ(lgp.status, LgpStatus::not_started);
  EXPECT_FALSE(lgp.solve(0));
  EXPECT_EQ(lgp.status, LgpStatus::infeasible);
  EXPECT_EQ(lgp.message, "no plan in logic");
  EXPECT_FALSE(lgp.hasPlan());
}

TEST(LgpTool, EffortEndsASearchAndItGoesOn) {
  const LgpProblem problem("unblock");
  LgpTool lgp(problem.C, problem.tamp);
  EXPECT_FALSE(lgp.solve(0, 1));
  EXPECT_EQ(lgp.status, LgpStatus::no_plan_found);
  EXPECT_TRUE(lgp.solve(0));
}

TEST(LgpTool, BetweenMayEndIt) {
  const LgpProblem problem("panda_unblock");
  for (const int threads : {1, 2}) {
    LgpOptions options;
    options.threads = threads;
    options.cancellation = [] { throw std::runtime_error("enough"); };
    LgpTool lgp(problem.C, problem.tamp, options);
    expectError<std::runtime_error>([&] { lgp.solve(0); }, {"enough"});
  }
}

TEST(LgpTool, LinesAreTold) {
  const LgpProblem problem("tower");
  std::vector<std::string> lines;
  LgpOptions options;
  options.print = [&](const std::string& line) { lines.push_back(line); };
  LgpTool lgp(problem.C, problem.tamp, options);
  ASSERT_TRUE(lgp.solve());
  lgp.solvePiecewiseMotions();
  lgp.solveFullMotion();
  ASSERT_EQ(lines.size(), 6u);
  EXPECT_EQ(lines[0], "-- feasible: " + planText(lgp.getSolvedPlan()));
  EXPECT_EQ(lines[1].rfind("-- " + planText({lgp.getSolvedPlan()[0]}) + ": ", 0), 0u) << lines[1];
  EXPECT_EQ(lines[5].rfind("-- full motion: ", 0), 0u);
}

TEST(LgpTool, MistakesAreTold) {
  const LgpProblem problem("unblock");
  expectError<ValueError>([&] { LgpTool(problem.C, problem.tamp, {.threads = 0}); }, {"threads is 0", "1 or more"});
  LgpTool lgp(problem.C, problem.tamp);
  expectError<ValueError>([&] { lgp.getSolvedPlan(); }, {"no plan was found yet; call solve"});
  expectError<ValueError>([&] { lgp.get_fullMotionProblem(); }, {"no plan was found yet"});
  ASSERT_TRUE(lgp.solve(0));
  expectError<ValueError>([&] { lgp.get_piecewiseMotionProblem(4); }, {"phase is 4", "4 actions"});
}

}  // namespace
}  // namespace kinegraph
