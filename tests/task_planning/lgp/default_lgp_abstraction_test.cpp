#include "kinegraph/task_planning/lgp/lgp_abstraction.h"

#include "tests/support/expect_error.h"
#include "tests/task_planning/lgp/lgp_scenes.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TEST(DefaultLgpAbstraction, PlansComeFromItsFilesAndTheSceneShortestFirst) {
  const LgpProblem problem("unblock");
  EXPECT_EQ(problem.tamp->explicitCollisions, (std::vector<std::string>{"red", "blue"}));
  EXPECT_EQ(problem.tamp->domain().rules[0].name, "pick_touch");
  const auto plan = problem.tamp->getNewActionSequence();
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->size(), 2u);
  problem.tamp->forbidBeginning({plan->begin(), plan->begin() + 1});
  const auto next = problem.tamp->getNewActionSequence();
  ASSERT_TRUE(next);
  EXPECT_NE(next->front(), plan->front());
}

TEST(DefaultLgpAbstraction, MistakesInFilesAreToldWithTheirPlace) {
  Config C;
  C.addFile(LgpProblem::path("unblock.g"));
  const std::string fol = "fol: <" + LgpProblem::path("kitchen.fol") + ">\n";
  const auto problem = [&](const std::string& text) { DefaultLgpAbstraction(C, writtenFile("mistakes.lgp", text)); };
  expectError<FileError>([&] { DefaultLgpAbstraction(C, "nowhere.lgp"); }, {"cannot read 'nowhere.lgp'"});
  expectError<FileError>([&] { problem("fol: <gone.fol>\nterminal: \"(on padA red)\""); }, {"gone.fol"});
  expectError<ParseError>([&] { problem(fol); }, {"mistakes.lgp:1:1: missing `terminal:`"});
  expectError<ParseError>([&] { problem(fol + "terminal: 3"); }, {"mistakes.lgp:2:1: missing `terminal:`"});
  expectError<ParseError>([&] { problem(fol + "terminal: \"(on padA red) (on padC red)\""); },
                          {"mistakes.lgp:2:26: ", "unknown symbol 'padC' in the goal", "similar names: padA"});
  expectError<ParseError>([&] { problem(fol + "terminal: \"(on padA red)\n  (on padA\""); }, {"mistakes.lgp:3:"});
  expectError<ParseError>([&] { problem(fol + "terminal: \"(on hand padA)\""); },
                          {"the goal cannot be reached", "nothing can make (on hand padA)"});
  const std::string goal = fol + "terminal: \"(on padA red)\"\n";
  expectError<FrameNotFound>([&] { problem(goal + "coll: [redd blue]"); }, {"redd", "red"});
  expectError<ParseError>([&] { problem(goal + "coll: [red blue hand]"); }, {"mistakes.lgp:3:1: coll has 3 names"});
  expectError<ParseError>([&] { problem(goal + "coll: 4"); },
                          {"mistakes.lgp:3:1: coll is the number 4; expected pairs of frames"});
  EXPECT_NO_THROW(problem(goal + "coll: []"));
}

TEST(DefaultLgpAbstraction, WhatIsAskedWhileLogicIsSearchedMayEndIt) {
  const Config C = cubesOnATable(6);
  const std::string file = writtenFile(
      "tower.lgp", "fol: <" + LgpProblem::path("kitchen.fol") + ">\nterminal: \"(on b0 b1) (on b1 b2) (on b2 b3)\"");
  bool ends = true;
  DefaultLgpAbstraction tamp(C, file, [&] {
    if (ends) throw std::runtime_error("enough");
  });
  expectError<std::runtime_error>(
      [&] {
        while (tamp.getNewActionSequence()) continue;
      },
      {"enough"});
  ends = false;
  EXPECT_TRUE(tamp.getNewActionSequence());
}

TEST(DefaultLgpAbstraction, AnActionOfOnesOwnTakesSomethingAlong) {
  class Lifts : public DefaultLgpAbstraction {
   public:
    using DefaultLgpAbstraction::DefaultLgpAbstraction;
    void add_action_constraints(const std::shared_ptr<Komo>& komo, double time, const TaskAction& before,
                                const TaskAction& action) override {
      if (action[0] != "pick_touch") return DefaultLgpAbstraction::add_action_constraints(komo, time, before, action);
      ManipulationHelper m;
      m.komo = komo;
      m.add_stable_frame(JointType::free, action[3], "mine");
      switchTo(m, time, "mine", action[1]);
      slices = steps(*komo);
    }
    int slices = 0;
  };
  Config C;
  C.addFile(LgpProblem::path("unblock.g"));
  Lifts tamp(C, LgpProblem::path("unblock.lgp"));
  const TaskAction pick = {"pick_touch", "red", "table", "hand"}, place = {"place_straightOn", "red", "hand", "padA"};
  const auto komo = tamp.setup_sequence(C, 2);
  tamp.add_all(komo, {pick, place}, false);
  EXPECT_EQ(tamp.slices, 1);
  EXPECT_EQ(komo->configuration(0).getFrame("red").getParent()->getName(), "mine");
  EXPECT_EQ(komo->configuration(1).getFrame("red").getParent()->getName(), "placePose_padA_red_2");
  EXPECT_FALSE(tamp.is_last(1.));
  EXPECT_TRUE(tamp.is_last(2.));
  tamp.add_all(tamp.setup_motion(C, 2), {pick, place}, true);
  EXPECT_EQ(tamp.slices, LgpAbstraction::kSteps);
}

}  // namespace
}  // namespace kinegraph
