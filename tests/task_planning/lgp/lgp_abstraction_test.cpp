#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/objective_list.h"
#include "tests/support/expect_error.h"
#include "tests/task_planning/lgp/lgp_scenes.h"

namespace kinegraph {
namespace {

TEST(LgpAbstraction, WithoutActionsItHasNoPlansAndProblemsOfTheRightSize) {
  Config C;
  C.addFile(LgpProblem::path("unblock.g"));
  LgpAbstraction tamp(C);
  EXPECT_FALSE(tamp.getNewActionSequence());
  EXPECT_TRUE(tamp.hasAllPlans());
  const auto waypoints = tamp.setup_sequence(C, 3), motion = tamp.setup_motion(C, 3);
  EXPECT_EQ(waypoints->slices(), 3);
  EXPECT_EQ(waypoints->order(), 1);
  EXPECT_EQ(motion->slices(), 3 * LgpAbstraction::kSteps);
  EXPECT_EQ(motion->order(), 2);
  expectError<ValueError>(
      [&] {
        tamp.add_all(waypoints, {{"dance", "red"}}, false);
      },
      {"action (dance red) has no constraints"});
}

TEST(LgpAbstraction, ItSeesWhatIsChangedInTheSceneLater) {
  Config C;
  C.addFile(LgpProblem::path("unblock.g"));
  const LgpAbstraction tamp(C);
  C.getFrame("red").setPosition({.1, .2, 2.});
  EXPECT_EQ(tamp.C.getFrame("red").getPosition(), Vector3d(.1, .2, 2.));
}

TEST(LgpAbstraction, ExplicitPairsAreKeptApartInAllSlices) {
  Config C;
  C.addFile(LgpProblem::path("unblock.g"));
  Reaches tamp(C, {});
  tamp.explicitCollisions = {"red", "blue"};
  const auto komo = tamp.setup_sequence(C, 2);
  const auto before = komo->objectives().size();
  tamp.add_all(komo, {{"reach", "1"}, {"reach", ".9"}}, false);
  ASSERT_EQ(komo->objectives().size(), before + 3);
  const Objective& last = komo->objectives()[before + 2];
  EXPECT_EQ(last.frames, (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(last.type, ObjectiveType::ineq);
  EXPECT_TRUE(last.times.empty());
  tamp.explicitCollisions = {"red"};
  expectError<ValueError>(
      [&] {
        tamp.add_all(tamp.setup_sequence(C, 1), {{"reach", "1"}}, false);
      },
      {"explicitCollisions has 1 names; expected pairs"});
}

}  // namespace
}  // namespace kinegraph
