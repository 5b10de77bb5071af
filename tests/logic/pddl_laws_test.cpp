// Laws of PDDL on small random problems: plans are valid and cheapest, and written problems are read as the same.
#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <utility>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/grounding.h"
#include "kinegraph/logic/landmark_cut.h"
#include "kinegraph/logic/plan_search.h"
#include "tests/logic/pddl_oracle.h"

namespace kinegraph {
namespace {

/// Writes random problems with two types, nested conditions, conditional effects and costs. With `derives`, they have
/// two derived predicates: d0 is recursive, and d1 may negate d0.
class RandomPddl {
 public:
  explicit RandomPddl(int seed, bool derives = false) : rng_(std::uint64_t(seed)), derives_(derives) {
    const std::vector<int> counts = {1 + below(2), 1 + below(2)};
    for (int type = 0; type < 2; ++type) {
      for (int i = 0; i < counts[std::size_t(type)]; ++i) objects_.push_back({cat(kTypes[type], i), type});
    }
  }

  std::string domain() {
    std::string text =
        "(define (domain d) (:types ta tb)\n(:predicates (p0) (p1 ?a - ta) (p2 ?b - tb) (p3 ?a - ta ?b - tb) (fixed ?a "
        "- ta ?b - tb) (d0 ?a - ta) (d1 ?b - tb))\n(:functions (total-cost) - number (toll ?a - ta) - number)\n";
    if (derives_) text += derived();
    for (int i = 0; i < 3 + below(3); ++i) text += action(i);
    return text + ")";
  }

  std::string problem() {
    std::string text = "(define (problem p) (:domain d) (:objects", init, tolls;
    for (const Name& object : objects_) text += cat(" ", object.name, " - ", kTypes[object.type]);
    const int derived = std::exchange(derived_, 0);  // not in :init
    for (int i = below(5); i > 0; --i) init += literal(objects_, false) + " ";
    derived_ = derived;
    for (const Name& object : objects_) {
      if (object.type == 0) tolls += cat("(= (toll ", object.name, ") ", below(5), ")");
    }
    text += cat(")\n(:init ", init, "(= (total-cost) 0)", tolls, ")\n(:goal (and");
    for (int i = 1 + below(2); i > 0; --i) text += " " + condition(objects_, 2);
    return text + "))\n(:metric minimize (total-cost)))";
  }

 private:
  struct Name {
    std::string name;
    int type;
  };
  using Scope = std::vector<Name>;
  static constexpr const char* kTypes[] = {"ta", "tb"};

  int below(int count) { return int(rng_.bits() % std::uint64_t(count)); }

  std::string literal(const Scope& scope, bool is_effect) {
    static const std::vector<std::pair<std::string, std::vector<int>>> predicates = {
        {"p0", {}}, {"p1", {0}}, {"p2", {1}}, {"p3", {0, 1}}, {"fixed", {0, 1}}, {"d0", {0}}, {"d1", {1}}};
    for (int attempt = 0; attempt < 20; ++attempt) {
      const auto& [name, types] = predicates[std::size_t(below(is_effect ? 4 : 5 + derived_))];
      std::string text = "(" + name;
      bool fits = true;
      for (int type : types) {
        Scope of_type;
        for (const Name& one : scope) {
          if (one.type == type) of_type.push_back(one);
        }
        if (of_type.empty()) fits = false;
        if (fits) text += " " + of_type[std::size_t(below(int(of_type.size())))].name;
      }
      if (fits) return text + ")";
    }
    return "(p0)";
  }

  std::string signedLiteral(const Scope& scope, bool is_effect) {
    const std::string text = literal(scope, is_effect);
    return below(5) < 3 ? text : "(not " + text + ")";
  }

  Scope with(const Scope& scope, std::string& variable) {
    Scope inner = scope;
    const int type = below(2);
    inner.push_back({cat("?q", ++quantified_), type});
    variable = cat("(", inner.back().name, " - ", kTypes[type], ")");
    return inner;
  }

  std::string condition(const Scope& scope, int depth) {
    const int kind = depth == 0 ? 0 : below(10);
    if (kind < 4) return signedLiteral(scope, false);
    std::string text;
    if (kind < 8) {
      for (int i = 1 + below(2); i > 0; --i) text += " " + condition(scope, depth - 1);
      if (kind == 4) return cat("(imply ", condition(scope, depth - 1), " ", condition(scope, depth - 1), ")");
      return cat(kind < 6 ? "(and" : "(or", text, ")");
    }
    if (kind == 8) return cat("(not ", condition(scope, depth - 1), ")");
    std::string variable;
    const Scope inner = with(scope, variable);
    return cat(below(2) ? "(forall " : "(exists ", variable, " ", condition(inner, depth - 1), ")");
  }

  std::string effect(const Scope& scope, int depth) {
    const int kind = depth == 0 ? 0 : below(10);
    if (kind < 6) return signedLiteral(scope, true);
    if (kind < 8) return cat("(when ", condition(scope, 1), " ", effect(scope, depth - 1), ")");
    std::string variable;
    const Scope inner = with(scope, variable);
    return cat("(forall ", variable, " ", effect(inner, depth - 1), ")");
  }

  std::string derived() {
    const Scope a = {{"?a", 0}}, both = {{"?a", 0}, {"?x", 0}}, b = {{"?b", 1}};
    std::string text = cat("(:derived (d0 ?a - ta) (or ", condition(a, 2), " (exists (?x - ta) (and (d0 ?x) ",
                           signedLiteral(both, false), "))))\n");
    derived_ = 1;
    for (int i = 1 + below(2); i > 0; --i) text += cat("(:derived (d1 ?b - tb) ", condition(b, 2), ")\n");
    derived_ = 2;
    return text;
  }

  std::string action(int number) {
    Scope scope;
    std::string text = cat("(:action a", number, " :parameters ("), cost = cat(below(4));
    for (int i = below(3); i > 0; --i) {
      scope.push_back({cat("?v", i), below(2)});
      text += cat(scope.back().name, " - ", kTypes[scope.back().type], " ");
      if (scope.back().type == 0 && below(2)) cost = cat("(toll ", scope.back().name, ")");
    }
    text += ") :precondition (and";
    if (below(2)) text += " " + condition(scope, 2);
    text += ") :effect (and";
    for (int i = 1 + below(4); i > 0; --i) text += " " + effect(scope, 2);
    return cat(text, " (increase (total-cost) ", cost, ")))\n");
  }

  Rng rng_;
  Scope objects_;
  int quantified_ = 0, derived_ = 0;  ///< derived_: the derived predicates that conditions may have
  bool derives_ = false;
};

struct RandomProblem {
  explicit RandomProblem(int seed, bool derives = false) {
    RandomPddl random(seed, derives);
    domain = random.domain();
    problem = random.problem();
  }
  LogicProblem read() const { return readPddlProblem(problem, readPddlDomain(domain)); }
  std::string domain, problem;
};

class PlansOfRandomProblems : public testing::TestWithParam<bool> {};

TEST_P(PlansOfRandomProblems, AreValidAndOfTheCostThatBruteForceFinds) {
  int solved = 0, unsolvable = 0;
  for (int seed = 0; seed < 150; ++seed) {
    const RandomProblem random(seed, GetParam());
    const LogicProblem problem = random.read();
    PlanSearch search(ground(problem));
    const auto plan = search.next();
    const double least = oracle::leastCost(problem);
    if (!plan) {
      EXPECT_EQ(search.status(), PlanSearch::Status::exhausted);
      EXPECT_EQ(least, std::numeric_limits<double>::infinity()) << seed << "\n" << random.domain << random.problem;
      ++unsolvable;
      continue;
    }
    const auto cost = oracle::validate(problem, actionWords(search.problem(), *plan));
    ASSERT_TRUE(cost) << seed << "\n" << random.domain << random.problem;
    EXPECT_EQ(*cost, least) << seed << "\n" << random.domain << random.problem;
    EXPECT_EQ(search.problem().cost(*plan), least);
    EXPECT_EQ(search.distance(), least);
    solved += !plan->empty();
  }
  EXPECT_GT(solved, 15);
  EXPECT_GT(unsolvable, 15);
}

INSTANTIATE_TEST_SUITE_P(PddlLaws, PlansOfRandomProblems, testing::Bool());

TEST(PddlLaws, FurtherPlansAreValidDifferentAndNeverCheaper) {
  int plans = 0;
  for (int seed = 0; seed < 60; ++seed) {
    const LogicProblem problem = RandomProblem(seed).read();
    PlanSearch search(ground(problem));
    std::set<std::vector<int>> seen;
    double last = 0;
    for (int i = 0; i < 20; ++i) {
      const auto plan = search.next();
      if (!plan) break;
      EXPECT_TRUE(seen.insert(*plan).second);
      const auto cost = oracle::validate(problem, actionWords(search.problem(), *plan));
      ASSERT_TRUE(cost) << seed;
      EXPECT_GE(*cost, last) << seed;
      last = *cost;
      ++plans;
    }
  }
  EXPECT_GT(plans, 50);
}

/// All cheapest plans of a problem, in order.
std::vector<std::vector<int>> cheapestPlans(const LogicProblem& problem, PlanSearch::Options options) {
  PlanSearch search(ground(problem), options);
  std::vector<std::vector<int>> plans;
  while (const auto plan = search.next()) {
    if (search.problem().cost(*plan) > search.distance() || plans.size() > 200) break;
    plans.push_back(*plan);
  }
  return plans;
}

/// Six blocks that a hand stacks in another random order.
LogicProblem randomPiles(int seed) {
  Rng rng(std::uint64_t(seed) + 1);
  const auto piles = [&](std::vector<std::string> blocks) {
    std::string text;
    for (std::size_t i = blocks.size(); i > 0; --i) {
      std::swap(blocks[i - 1], blocks[rng.bits() % i]);
      const bool is_low = i == blocks.size() || rng.bits() % 3 == 0;
      text += is_low ? cat("(on ", blocks[i - 1], " floor)") : cat("(on ", blocks[i - 1], " ", blocks[i], ")");
    }
    return text;
  };
  const std::vector<std::string> blocks = {"a", "b", "c", "d", "e", "f"};
  const std::string start = piles(blocks), goal = piles(blocks);
  std::string clear;
  for (const std::string& block : blocks) {
    if (start.find(" " + block + ")") == std::string::npos) clear += cat("(clear ", block, ")");
  }
  return readPddlProblem(
      cat("(define (problem p) (:domain piles) (:objects a b c d e f) (:init (clear floor) ", start, clear,
          ") (:goal (and ", goal, ")))"),
      readPddlDomain(
          "(define (domain piles) (:constants floor hand) (:predicates (on ?a ?b) (clear ?a)) (:action take "
          ":parameters (?a ?b) :precondition (and (clear ?a) (on ?a ?b) (not (= ?b hand)) (forall (?c) (not "
          "(on ?c hand)))) :effect (and (clear ?b) (on ?a hand) (not (clear ?a)) (not (on ?a ?b)))) (:action "
          "put :parameters (?a ?b) :precondition (and (clear ?b) (on ?a hand)) :effect (and (on ?a ?b) "
          "(clear ?a) (when (not (= ?b floor)) (not (clear ?b))) (not (on ?a hand)))))"));
}

TEST(PddlLaws, TheCheapestPlansAreTheSameIfTheirOrderIsGivenUp) {
  const auto sorted = [](std::vector<std::vector<int>> plans) {
    std::ranges::sort(plans);
    return plans;
  };
  for (int seed = 0; seed < 100; ++seed) {
    const LogicProblem problem = RandomProblem(seed, seed >= 50).read();
    const auto ordered = cheapestPlans(problem, {});
    if (ordered.size() > 200) continue;
    EXPECT_EQ(sorted(cheapestPlans(problem, {.order_expansions = 0})), sorted(ordered)) << seed;
  }
  long saved = 0;
  for (int seed = 0; seed < 10; ++seed) {
    const LogicProblem piles = randomPiles(seed);
    const auto ordered = cheapestPlans(piles, {});
    if (ordered.size() > 200) continue;
    EXPECT_EQ(ordered, sorted(ordered));
    EXPECT_EQ(sorted(cheapestPlans(piles, {.order_expansions = 0})), ordered);
    PlanSearch with(ground(piles), {}), without(ground(piles), {.order_expansions = 0});
    EXPECT_EQ(with.next()->size(), without.next()->size());
    saved += with.expansions() - without.expansions();
  }
  EXPECT_GT(saved, 0);
}

TEST(PddlLaws, LandmarksNeverExceedTheLeastCost) {
  for (int seed = 300; seed < 380; ++seed) {
    const LogicProblem problem = RandomProblem(seed, seed >= 340).read();
    const GroundProblem made = ground(problem);
    std::vector<LandmarkCut::Cost> costs;
    for (const GroundRule& action : made.actions) costs.push_back(action.cost);
    const LandmarkCut::Cost bound = LandmarkCut(made, costs)(made.start);
    const double least = oracle::leastCost(problem);
    if (bound < LandmarkCut::kNever) {
      EXPECT_LE(double(bound), least) << seed;
    } else {
      EXPECT_EQ(least, std::numeric_limits<double>::infinity()) << seed;
    }
  }
}

TEST(PddlLaws, ProblemsThatAreWrittenAndReadAreTheSame) {
  for (int seed = 0; seed < 100; ++seed) {
    const LogicProblem problem = RandomProblem(seed, seed >= 60).read();
    const std::string domain = writePddlDomain(problem.domain), text = writePddlProblem(problem);
    const LogicProblem again = readPddlProblem(text, readPddlDomain(domain));
    EXPECT_EQ(writePddlDomain(again.domain), domain) << seed;
    EXPECT_EQ(writePddlProblem(again), text) << seed;
    ASSERT_EQ(again.domain.rules.size(), problem.domain.rules.size());
    for (std::size_t r = 0; r < problem.domain.rules.size(); ++r) {
      const LogicRule &a = problem.domain.rules[r], &b = again.domain.rules[r];
      EXPECT_EQ(a.pre, b.pre);
      EXPECT_EQ(a.eff, b.eff);
      EXPECT_EQ(a.conditions, b.conditions) << domain;
      EXPECT_EQ(a.conditional, b.conditional) << domain;
      EXPECT_EQ(a.cost, b.cost);
      EXPECT_EQ(a.cost_functions, b.cost_functions);
    }
    EXPECT_EQ(again.goal_conditions, problem.goal_conditions);
    EXPECT_EQ(ground(problem).actions.size(), ground(again).actions.size());
  }
}

}  // namespace
}  // namespace kinegraph
