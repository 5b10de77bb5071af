#include "kinegraph/logic/grounding.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/logic/domain.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

/// A lamp in one of two rooms, and a switch.
GroundProblem lamp() {
  LogicProblem problem;
  problem.domain = readFol(R"(
    lamp room in on
    DecisionRule carry { A, B, { (in A) (room B) } { (in A)! (in B) } }
    DecisionRule press { L, { (lamp L) (on L)! } { (on L) } }
    DecisionRule unpress { L, { (lamp L) (on L) } { (on L)! } })");
  problem.start = readLiterals("(in hall) (lamp bulb) (room hall) (room attic)");
  problem.goal = readLiterals("(in attic) (on bulb)");
  return ground(problem);
}

TEST(ActionWords, WordsAndNumbersAreTheSameActions) {
  const GroundProblem ground = lamp();
  for (int a = 0; a < int(ground.actions.size()); ++a) EXPECT_EQ(actionNumber(ground, ground.action(a)), a);
  const std::vector<int> all = {0, 1};
  EXPECT_EQ(actionNumbers(ground, actionWords(ground, all)), all);
  expectError<ValueError>(
      [&] {
        actionNumber(ground, {"press", "bulp"});
      },
      {"there is no action (press bulp)", "press bulb"});
}

TEST(ActionWords, StatesGoOnWithEachAction) {
  const GroundProblem ground = lamp();
  const auto numbers = actionNumbers(ground, {{"press", "bulb"}, {"carry", "hall", "attic"}});
  const auto states = statesAlong(ground, numbers);
  const auto holds = [](const std::vector<Literal>& state, const Literal& fact) {
    return std::ranges::find(state, fact) != state.end();
  };
  ASSERT_EQ(states.size(), 3u);
  EXPECT_TRUE(!holds(states[0], {"on", {"bulb"}}) && holds(states[1], {"on", {"bulb"}}));
  EXPECT_TRUE(holds(states[1], {"in", {"hall"}}) && !holds(states[2], {"in", {"hall"}}));
  expectError<ValueError>(
      [&] {
        statesAlong(ground, {numbers[0], numbers[0]});
      },
      {"(press bulb) is not possible as action 2"});
}

TEST(ActionWords, OnlyFactsThatChangeCanForbid) {
  const GroundProblem ground = lamp();
  EXPECT_EQ(changingFacts(ground, {{"on", {"bulb"}}}).size(), 1u);
  expectError<ValueError>([&] { changingFacts(ground, {{"lamp", {"bulb"}}}); }, {"(lamp bulb) never changes"});
}

}  // namespace
}  // namespace kinegraph
