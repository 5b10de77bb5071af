#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/plan_search.h"

namespace kinegraph {
namespace {

std::string errorOf(const std::string& text) {
  try {
    readFol(text, "d.fol");
  } catch (const ParseError& error) {
    return error.what();
  }
  return "";
}

TEST(FolReader, SaysWhereAMistakeIsWhatWasExpectedAndWhatIsNear) {
  EXPECT_EQ(errorOf("on\nDecisionRule a { X { (onn X) } { (on X) } }"),
            "d.fol:2:22: unknown predicate 'onn' in (onn X); declare it in a line of its own; similar names: on");
  EXPECT_EQ(errorOf("on\nDecisionRule a { X, Y { (on X) } { (on Y) } }"),
            "d.fol:2:1: rule 'a': no literal of the precondition that has to hold has the variable 'Y'; it could be "
            "anything");
  EXPECT_EQ(errorOf("on\nDecisionRule a { X { (on X } }"),
            "d.fol:2:28: expected ')' after the arguments of a literal, found '}'");
  EXPECT_EQ(errorOf("on\nDecisionRule a { X { (on Z) } { (on X) } }").substr(0, 49),
            "d.fol:2:22: unknown symbol or variable 'Z' in (on");
  EXPECT_EQ(errorOf("DecisoinRule a { }").substr(0, 42), "d.fol:1:1: unknown block 'DecisoinRule'; e");
  EXPECT_EQ(errorOf("on\nSTART_STAT { }").substr(0, 37), "d.fol:2:1: unknown block 'START_STAT'");
  const std::string beliefs = "several states with probabilities (beliefs) are not supported; expected one state";
  EXPECT_EQ(errorOf("on\nSTART_STATE { { (on a) }=.5 { (on b) }=.5 }"), "d.fol:2:15: " + beliefs);
  EXPECT_EQ(errorOf("on\nBELIEF_STATE { (on a) }"), "d.fol:2:1: " + beliefs);
  EXPECT_NE(errorOf("on\nDecisionRule a { X { (on X)=much } { (on X) } }"), "");
  EXPECT_NE(errorOf("on\nDecisionRule a { X { aggregate{ } } { (on X) } }"), "");
}

TEST(FolReader, AStartWithAMisspelledPredicateIsTold) {
  LogicProblem problem{.domain = readFol("hot cold\nDecisionRule heat { X { (cold X) } { (hot X) } }")};
  problem.start = readLiterals("(colt cup) (is_round cup)", "start");
  problem.goal = readLiterals("(hot cup)");
  const std::vector<std::string> told = diagnostics(ground(problem));
  EXPECT_NE(std::ranges::find(told, "start:1:1: no rule has the predicate of (colt cup); similar names: cold"),
            told.end())
      << join(told, "; ");
  problem.goal = readLiterals("(hot pan)", "goal");
  try {
    ground(problem);
    ADD_FAILURE();
  } catch (const ParseError& error) {
    EXPECT_STREQ(error.what(), "goal:1:1: unknown symbol 'pan' in the goal (hot pan); expected one of cup");
  }
}

}  // namespace
}  // namespace kinegraph
