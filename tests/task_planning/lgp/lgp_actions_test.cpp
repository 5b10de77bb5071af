#include "kinegraph/task_planning/lgp/lgp_actions.h"

#include "kinegraph/common/text.h"
#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/support/expect_error.h"
#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {
namespace {

/// The plan that a recording of the reference has, and how many variables and residuals it had.
struct Recorded {
  const char* scene;
  std::vector<TaskAction> plan;
  Eigen::Index variables;
  std::size_t residuals;
};

std::shared_ptr<Komo> waypoints(const LgpProblem& problem, const std::vector<TaskAction>& plan) {
  const auto komo = problem.tamp->setup_sequence(problem.C, int(plan.size()));
  problem.tamp->add_all(komo, plan, false);
  return komo;
}

TEST(LgpActions, ProblemsHaveTheVariablesAndResidualsOfTheReference) {
  const std::vector<Recorded> all = {
      {"unblock",
       {{"pick_touch", "blue", "padA", "hand"},
        {"place_straightOn", "blue", "hand", "padB"},
        {"pick_touch", "red", "table", "hand"},
        {"place_straightOn", "red", "hand", "padA"}},
       32,
       46},
      {"pose_chain", {{"pick_touch", "carrier", "table", "hand"}, {"poseEq", "cup", "goal"}}, 13, 21},
      {"gantry", {{"pick_box", "bar", "table", "g_gripper"}, {"place_straightOn", "bar", "g_gripper", "pad"}}, 18, 33},
      {"gantry_placebox",
       {{"pick_box", "bar", "table", "g_gripper"}, {"place_box", "bar", "g_gripper", "pad"}},
       21,
       46},
      {"push",
       {{"gripper_push", "disc", "table", "g_gripper"}, {"end_push", "g_gripper", "disc", "table", "pad"}},
       18,
       46},
  };
  for (const Recorded& recorded : all) {
    const auto nlp = makeNlp(waypoints(LgpProblem(recorded.scene), recorded.plan));
    EXPECT_EQ(nlp->dimension(), recorded.variables) << recorded.scene;
    EXPECT_EQ(nlp->types().size(), recorded.residuals) << recorded.scene;
  }
}

TEST(LgpActions, AHandThatPicksABoxIsInsideOfIt) {
  const LgpProblem problem("gantry");
  const auto komo = waypoints(problem, {{"pick_box", "bar", "table", "g_gripper"}});
  ASSERT_TRUE(NlpSolver(makeNlp(komo), 0).solve().feasible);
  const Config picked = komo->configuration(0);
  const Pose X_BW = picked.getFrame("bar").getPose().inverse();
  const Vector3d inside = X_BW.p + X_BW.q * picked.getFrame("g_gripper").getPosition();
  EXPECT_NEAR(inside.y(), 0., 1e-3);
  EXPECT_LT(std::abs(inside.x()), .5 * picked.getFrame("bar").getSize()[0] - .02 + 1e-3);
  EXPECT_EQ(picked.getFrame("bar").getParent()->getName(), "pickPose_g_gripper_bar_1");
}

TEST(LgpActions, NamesOfEarlierYearsAskTheSame) {
  const LgpProblem problem("unblock");
  const auto names = [&](const char* pick, const char* place) {
    std::vector<std::string> all;
    const auto komo = waypoints(problem, {{pick, "red", "table", "hand"}, {place, "red", "hand", "padA"}});
    for (const Objective& o : komo->objectives()) all.push_back(cat(o.name(), " ", join(o.frames)));
    return all;
  };
  EXPECT_EQ(names("pick", "place"), names("pick_touch", "place_straightOn"));
}

TEST(LgpActions, MistakesAreTold) {
  const LgpProblem problem("push");
  const auto komo = problem.tamp->setup_sequence(problem.C, 2);
  const auto add = [&](const TaskAction& action) {
    return [&, action] { problem.tamp->add_action_constraints(komo, 1., {}, action); };
  };
  expectError<ValueError>(add({"dance", "disc"}), {"unknown action 'dance'; known are pick_touch, ", "a subclass"});
  expectError<ValueError>(add({}), {"unknown action ''"});
  expectError<ValueError>(add({"pick_touch", "disc"}), {"(pick_touch disc) has 2 words; expected 4"});
  expectError<ValueError>(add({"end_push", "g_gripper", "disc", "table", "pad"}), {"is the last action of a plan"});
  expectError<FrameNotFound>(add({"pick_touch", "dsc", "table", "g_gripper"}), {"dsc", "disc"});
}

}  // namespace
}  // namespace kinegraph
