#include "kinegraph/logic/plan_search.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>
#include <set>
#include <stdexcept>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/landmark_cut.h"

namespace kinegraph {
namespace {

constexpr const char* kPickPlace = R"(
is_gripper is_object is_place on busy
DecisionRule pick { Obj, From, Hand,
  { (is_gripper Hand) (is_object Obj) (on From Obj) (is_place From) (busy Hand)! }
  { (on From Obj)! (on Hand Obj) (busy Hand) } }
DecisionRule place { Obj, Hand, To
  pre: { (is_gripper Hand), (is_object Obj), (on Hand Obj), (is_place To) }
  eff: { (busy Hand)! (on Hand Obj)! (on To Obj) } }
)";

/// k cubes on a table, each a place, to be stacked.
LogicProblem tower(int k) {
  LogicProblem problem;
  problem.domain = readFol(kPickPlace);
  std::string start = "(is_gripper hand) (is_place table) ", goal;
  for (int i = 0; i < k; ++i) start += cat("(is_object b", i, ") (is_place b", i, ") (on table b", i, ") ");
  for (int i = 0; i + 1 < k; ++i) goal += cat("(on b", i, " b", i + 1, ") ");
  problem.start = readLiterals(start);
  problem.goal = readLiterals(goal);
  return problem;
}

std::string words(const PlanSearch& search, const std::vector<int>& plan) {
  std::vector<std::string> actions;
  for (int action : plan) actions.push_back(join(search.problem().action(action), " "));
  return join(actions);
}

TEST(PlanSearch, PlansComeShortestFirstAndNoneTwice) {
  PlanSearch search(ground(tower(5)));
  std::set<std::vector<int>> seen;
  std::size_t length = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto plan = search.next();
    ASSERT_TRUE(plan) << i;
    EXPECT_TRUE(seen.insert(*plan).second) << words(search, *plan);
    EXPECT_GE(plan->size(), length);
    if (i == 0) EXPECT_EQ(plan->size(), 8u);
    if (i == 23) EXPECT_EQ(plan->size(), 8u);  // 4! orders of the four moves
    if (i == 24) EXPECT_EQ(plan->size(), 10u);
    length = plan->size();
    FactSet state = search.problem().start;
    for (int action : *plan) {
      ASSERT_TRUE(search.problem().isApplicable(search.problem().actions[std::size_t(action)], state));
      state = search.problem().apply(action, state);
    }
    EXPECT_TRUE(search.problem().isGoal(state));
  }
}

TEST(PlanSearch, AllPlansWithoutDetoursAreFoundAndThenItIsProvedThatThereAreNoMore) {
  LogicProblem problem = tower(2);
  problem.goal = readLiterals("(on b0 b1)");
  PlanSearch search(ground(problem));
  int plans = 0;
  while (search.next()) ++plans;
  EXPECT_EQ(search.status(), PlanSearch::Status::exhausted);
  // Enumerated by hand: b1 goes to b0 at once, or b0 visits b1 and comes back to the table first.
  EXPECT_EQ(plans, 2);
}

TEST(PlanSearch, ContradictoryGoalsAreProvedImpossible) {
  LogicProblem problem = tower(3);
  problem.goal = readLiterals("(on b0 b2) (on b1 b2)");
  PlanSearch search(ground(problem));
  EXPECT_FALSE(search.next());
  EXPECT_EQ(search.status(), PlanSearch::Status::exhausted);
  EXPECT_EQ(search.distance(), std::numeric_limits<double>::infinity());
}

TEST(PlanSearch, WhatIsForbiddenIsGoneAround) {
  PlanSearch search(ground(tower(3)));
  const auto first = search.next();
  ASSERT_TRUE(first);
  search.forbid(first->front(), {});
  EXPECT_FALSE(search.next());  // each pick from the table is needed
  EXPECT_EQ(search.status(), PlanSearch::Status::exhausted);
  // Nothing is put onto b1 once b1 is on b0: b2 has to go first.
  PlanSearch other(ground(tower(3)));
  int place_b2 = -1, on_b0_b1 = other.problem().factNumber(readLiterals("(on b0 b1)")[0]);
  for (int a = 0; a < int(other.problem().actions.size()); ++a) {
    if (words(other, {a}) == "place b2 hand b1") place_b2 = a;
  }
  ASSERT_GE(place_b2, 0);
  ASSERT_GE(on_b0_b1, 0);
  other.forbid(place_b2, {on_b0_b1});
  const auto plan = other.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(other, *plan), "pick b2 table hand, place b2 hand b1, pick b1 table hand, place b1 hand b0");
}

TEST(PlanSearch, ABeginningThatIsForbiddenIsNotTakenAgain) {
  PlanSearch search(ground(tower(3)));
  const auto first = search.next();
  search.forbidBeginning({first->begin(), first->begin() + 2});
  for (int i = 0; i < 20; ++i) {
    const auto plan = search.next();
    ASSERT_TRUE(plan);
    EXPECT_FALSE((*plan)[0] == (*first)[0] && (*plan)[1] == (*first)[1]);
  }
}

TEST(PlanSearch, EffortIsLimited) {
  PlanSearch search(ground(tower(6)), {.max_expansions = 5});
  EXPECT_FALSE(search.next());
  EXPECT_EQ(search.status(), PlanSearch::Status::limit);
}

TEST(PlanSearch, NoPlanIsLostWhenItsTokenCancelsOrThrows) {
  const auto plansOf = [](PlanSearch::Options options) {  // of 8 and 10 actions
    PlanSearch search(ground(tower(5)), std::move(options));
    std::set<std::string> plans;
    int stops = 0;
    for (std::size_t length = 0; length <= 10 && stops < 9;) {
      try {
        const auto plan = search.next();
        if (!plan) {
          EXPECT_EQ(search.status(), PlanSearch::Status::cancelled);
          ++stops;
          continue;
        }
        EXPECT_GE(plan->size(), length);
        length = plan->size();
        if (length <= 10) {
          EXPECT_TRUE(plans.insert(words(search, *plan)).second);
        }
      } catch (const std::runtime_error&) {
        ++stops;
      }
    }
    return plans;
  };
  int asked = 0;
  const auto disturbed = plansOf({.cancellation = [&asked] {
    ++asked;
    if (asked == 2) throw std::runtime_error("enough");
    return asked == 1 || asked == 4;
  }});
  EXPECT_GT(asked, 3);
  EXPECT_EQ(disturbed.size(), 840u);
  EXPECT_EQ(disturbed, plansOf({}));
}

TEST(PlanSearch, LandmarksAreExactWhereGoalsAreIndependent) {
  const GroundProblem problem = ground(tower(8));
  EXPECT_EQ(LandmarkCut(problem)(problem.start), 14);
  PlanSearch search(problem);
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->size(), 14u);
  EXPECT_LT(search.expansions(), 30);
}

TEST(PlanSearch, RulesFireByThemselves) {
  LogicProblem problem;
  problem.domain = readFol(R"(
    on moves hold free
    DecisionRule grasp { X { (free X) } { (moves X) } }
    Rule chain { A, B { (on A B) (moves A) } { (moves B) } }
  )");
  problem.start = readLiterals("(on a b) (on b c) (free a)");
  problem.goal = readLiterals("(moves c)");
  PlanSearch search(ground(problem));
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(search, *plan), "grasp a");
}

TEST(PlanSearch, AnyMatchesAllConstants) {
  LogicProblem problem;
  problem.domain = readFol(R"(
    on thing ANY
    DecisionRule clear { X { (thing X) (on ANY X) } { (on ANY X)! } }
    DecisionRule put { X Y { (thing X) (thing Y) (on ANY X)! } { (on Y X) } }
  )");
  problem.start = readLiterals("(thing a) (thing b) (thing c) (on b a)");
  problem.goal = readLiterals("(on c a)");
  PlanSearch some(ground(problem));  // some place of X: a disjunction
  EXPECT_EQ(words(some, *some.next()), "clear a, put a c");
  problem.domain = readFol(R"(
    on thing ANY
    DecisionRule clear { X Y { (thing X) (thing Y) (on Y X) } { (on ANY X)! } }
    DecisionRule put { X Y { (thing X) (thing Y) (on ANY X)! } { (on Y X) } }
  )");
  PlanSearch search(ground(problem));
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(search, *plan), "clear a b, put a c");
}

TEST(PlanSearch, NegatedGoalsAndGoalsThatHoldAtTheStart) {
  LogicProblem problem = tower(2);
  problem.goal = readLiterals("(on table b0)!");
  PlanSearch search(ground(problem));
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(search, *plan), "pick b0 table hand");
  problem.goal = readLiterals("(on table b0)");
  PlanSearch done(ground(problem));
  const auto none = done.next();
  ASSERT_TRUE(none);
  EXPECT_TRUE(none->empty());
}

TEST(Grounding, SaysWhatIsOddBeforeTheSearch) {
  LogicProblem problem = tower(2);
  problem.goal = readLiterals("(on tabel b0)");
  try {
    ground(problem);
    FAIL();
  } catch (const ParseError& error) {
    EXPECT_NE(std::string(error.what()).find("unknown symbol 'tabel' in the goal (on tabel b0); similar names: table"),
              std::string::npos)
        << error.what();
  }
  problem.goal = readLiterals("(on b0 table)");
  EXPECT_EQ(diagnostics(ground(problem)).back(), "nothing can make (on b0 table) of the goal true");
  problem.domain = readFol(
      std::string(kPickPlace) + "key\nDecisionRule unlock { X { (key X) (is_object X) } { (busy X) } }", "a.fol");
  problem.goal = readLiterals("(on b0 b1)");
  EXPECT_EQ(diagnostics(ground(problem)).front(),
            "a.fol:10:1: rule 'unlock' can never fire; no rule and no fact ever makes (key X) true");
  problem.start.push_back({"on", {"b0"}});
  EXPECT_EQ(diagnostics(ground(problem)).back(), "no rule has (on b0) with 1 arguments; rules have (on From Obj)");
  problem.goal = readLiterals("(on b0 b1 b2)");
  EXPECT_THROW(ground(problem), ParseError);
}

TEST(Grounding, CombinationsThatWouldNeverEndAreAnErrorThatNamesTheRule) {
  LogicProblem problem;
  std::string variables, pre;
  for (int i = 0; i < 9; ++i) variables += cat("X", i, ", "), pre += cat("(thing X", i, ") ");
  problem.domain =
      readFol(cat("thing busy done\nDecisionRule gather { ", variables, "{ ", pre, "} { (done) } }"), "a.fol");
  std::string start;
  for (int i = 0; i < 40; ++i) start += cat("(thing t", i, ") ");
  problem.start = readLiterals(start);
  const auto errorOfGrounding = [&](std::size_t most) -> std::string {
    try {
      ground(problem, most);
    } catch (const ValueError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(errorOfGrounding(1000).find("ground: a.fol:2:1: rule 'gather' is one too many: facts were held against"),
            std::string::npos);
  problem.domain =
      readFol("thing near\nDecisionRule meet { X, Y, Z, { (thing X) (thing Y) (thing Z) } { (near X Y Z) } }", "b.fol");
  EXPECT_NE(errorOfGrounding(1000).find("b.fol:2:1: rule 'meet' can make more than 1000 facts true"),
            std::string::npos);
  EXPECT_EQ(errorOfGrounding(100000), "");
  EXPECT_EQ(ground(problem, 100000).actions.size(), 40u * 39u * 38u);
}

TEST(Grounding, AConstantOfStartStateThatNothingElseNamesIsTold) {
  LogicProblem problem;
  problem.domain = readFol(
      "on table cup\nSTART_STATE { (on tabel cup) }\nDecisionRule a { X { (on X cup) } { (on X cup)! } }", "d.fol");
  problem.start = problem.domain.start;
  problem.goal = readLiterals("(on table cup)!");
  EXPECT_EQ(diagnostics(ground(problem)).back(),
            "d.fol:2:15: 'tabel' in (on tabel cup) of START_STATE is neither declared nor in another fact; similar "
            "names: table");
}

TEST(Grounding, FactsOfOneWordWithDifferentNumbersOfArgumentsAreDifferent) {
  LogicProblem problem;
  problem.domain = readFol(R"(on support thing
    DecisionRule bridge { Hand, Obj, A, B
      { (on Hand Obj) (thing Obj) (support A) (support B) } { (on Hand Obj)! (on A B Obj) } })");
  problem.start = readLiterals("(on h plank) (thing plank) (support left) (support right)");
  problem.goal = readLiterals("(on left right plank)");
  PlanSearch search(ground(problem));
  EXPECT_EQ(words(search, *search.next()), "bridge h plank left right");
  // PDDL has one number of arguments per predicate: the other one gets a name of its own.
  const LogicDomain again = readPddlDomain(writePddlDomain(problem.domain));
  PlanSearch second(ground(readPddlProblem(writePddlProblem(problem), again)));
  EXPECT_EQ(words(second, *second.next()), "bridge h plank left right");
}

TEST(FolReader, CommasWithinLiteralsAreSpaces) {
  EXPECT_EQ(readLiterals("(on, table, cup) , (busy left,)!"), readLiterals("(on table cup) (busy left)!"));
}

TEST(FolReader, ValuesAreFactsOfWhichAnEffectLeavesOne) {
  LogicProblem problem;
  problem.domain = readFol(
      "level tank\nDecisionRule fill { X, { (tank X) (level X)=0 } { (level X)=1.50 } }\n"
      "DecisionRule drain { X, { (tank X) (level X)=1.5 } { (level X)=0 } }");
  problem.start = readLiterals("(tank a) (level a)=0.");
  problem.goal = readLiterals("(level a)=1.5");
  PlanSearch search(ground(problem));
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(search, *plan), "fill a");
  const auto last = search.problem().literals(search.problem().apply(plan->front(), search.problem().start));
  EXPECT_EQ(str(last), "(tank a) (level a)=1.5");
  EXPECT_EQ(writeFol(readFol(writeFol(problem.domain))), writeFol(problem.domain));
  const LogicDomain again = readPddlDomain(writePddlDomain(problem.domain));
  PlanSearch second(ground(readPddlProblem(writePddlProblem(problem), again)));
  EXPECT_EQ(words(second, *second.next()), "fill a");
}

TEST(FolReader, IncludedFilesAreRelativeToTheFileThatIncludesThem) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() / "kinegraph_fol_include";
  std::filesystem::create_directories(folder / "words");
  const auto write = [&](const char* name, const char* text) { std::ofstream(folder / name) << text; };
  write("words/all.g", "Include = 'places.g'\ncart in");
  write("words/places.g", "bay");
  write("task.fol",
        "Include = 'words/all.g'\nDecisionRule move { C, A, B { (cart C) (bay A) (bay B) (in C A) } { (in C A)! "
        "(in C B) } }");
  write("loop.fol", "Include = 'loop.fol'");
  write("none.fol", "\nInclude = 'nowhere.g'");
  LogicProblem problem;
  problem.domain = readFolFile((folder / "task.fol").string());
  problem.start = readLiterals("(cart c) (bay a) (bay b) (in c a)");
  problem.goal = readLiterals("(in c b)");
  PlanSearch search(ground(problem));
  EXPECT_EQ(words(search, *search.next()), "move c a b");
  const auto error = [&](const char* name) -> std::string {
    try {
      readFolFile((folder / name).string());
    } catch (const ParseError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(error("loop.fol").find("loop.fol:1:1: 'loop.fol' includes itself"), std::string::npos);
  EXPECT_NE(error("none.fol").find("none.fol:2:11: Include: there is no file"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(FolReader, WhatIsWrittenReadsAsTheSame) {
  const LogicDomain domain = readFol(kPickPlace);
  const std::string text = writeFol(domain);
  EXPECT_EQ(writeFol(readFol(text)), text);
  EXPECT_EQ(readFol(text).rules[1].eff, domain.rules[1].eff);
}

TEST(Pddl, AProblemThatIsWrittenAndReadHasTheSamePlans) {
  const LogicProblem problem = tower(3);
  const LogicDomain domain = readPddlDomain(writePddlDomain(problem.domain));
  const LogicProblem again = readPddlProblem(writePddlProblem(problem), domain);
  PlanSearch a(ground(problem)), b(ground(again));
  std::set<std::string> of_a, of_b;
  for (int i = 0; i < 30; ++i) {
    of_a.insert(words(a, *a.next()));
    of_b.insert(words(b, *b.next()));
  }
  // Plans of one length may come in another order: compare those of the first two lengths, all of which are there.
  EXPECT_EQ(a.distance(), b.distance());
  EXPECT_EQ(a.problem().actions.size(), b.problem().actions.size());
  EXPECT_EQ(a.problem().facts.size(), b.problem().facts.size());
}

constexpr const char* kLogistics = R"((define (domain logistics)
  (:requirements :strips :typing :negative-preconditions)
  (:types truck parcel - thing place)
  (:predicates (at ?x - thing ?p - place) (in ?x - parcel ?t - truck) (closed ?p - place))
  (:action drive :parameters (?t - truck ?a ?b - place)
    :precondition (and (at ?t ?a) (not (closed ?b)) (not (= ?a ?b))) :effect (and (at ?t ?b) (not (at ?t ?a))))
  (:action load :parameters (?x - parcel ?t - truck ?p - place)
    :precondition (and (at ?x ?p) (at ?t ?p)) :effect (and (in ?x ?t) (not (at ?x ?p))))
  (:action unload :parameters (?x - parcel ?t - truck ?p - place)
    :precondition (and (in ?x ?t) (at ?t ?p)) :effect (and (at ?x ?p) (not (in ?x ?t)))))
)";
constexpr const char* kParcel = R"((define (problem p) (:domain logistics)
  (:objects t - truck x - parcel a b c - place)
  (:init (at t a) (at x b) (closed c))
  (:goal (and (at x a) (not (at t a)))))
)";

TEST(Pddl, TypesNegativePreconditionsAndGoalsMeanWhatTheySay) {
  const LogicProblem problem = readPddlProblem(kParcel, readPddlDomain(kLogistics));
  PlanSearch search(ground(problem));
  const auto plan = search.next();
  ASSERT_TRUE(plan);
  EXPECT_EQ(words(search, *plan), "drive t a b, load x t b, drive t b a, unload x t a, drive t a b");
  const LogicProblem again =
      readPddlProblem(writePddlProblem(problem), readPddlDomain(writePddlDomain(problem.domain)));
  PlanSearch second(ground(again));
  EXPECT_EQ(words(second, *second.next()), words(search, *plan));
}

TEST(Pddl, SaysWhatIsWrong) {
  const auto error = [](const std::string& text) {
    try {
      readPddlDomain(text, "d.pddl");
    } catch (const ParseError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(
      error(
          "(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :precondition (q ?x) :effect (p ?x)))"),
      "d.pddl:1:83: unknown predicate 'q'; expected one of p");
  EXPECT_EQ(error("(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :precondition (p ?x ?x) :effect "
                  "(p ?x)))"),
            "d.pddl:1:83: predicate 'p' has 1 arguments, got 2");
  EXPECT_NE(error("(define (domain d)"), "");
  EXPECT_NE(error(std::string(100000, '(')), "");
}

}  // namespace
}  // namespace kinegraph
