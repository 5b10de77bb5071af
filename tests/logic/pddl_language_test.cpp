// The parts of PDDL in public files: each case with the answer of Fast Downward 26.6 (A* with LM-cut or blind search).
#include <gtest/gtest.h>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/grounding.h"
#include "kinegraph/logic/plan_search.h"
#include "tests/logic/pddl_oracle.h"

namespace kinegraph {
namespace {

/// The first plan of a domain and a problem, "(go x y) (home)"; how the search ends without one, or the error.
std::string firstPlan(const std::string& domain, const std::string& problem) {
  try {
    const LogicProblem read = readPddlProblem(problem, readPddlDomain(domain, "d"), "p");
    PlanSearch search(ground(read));
    const auto plan = search.next();
    if (!plan) return search.status() == PlanSearch::Status::exhausted ? "exhausted" : "limit";
    const auto words = actionWords(search.problem(), *plan);
    EXPECT_TRUE(oracle::validate(read, words));
    std::vector<std::string> actions;
    for (const auto& action : words) actions.push_back("(" + join(action, " ") + ")");
    // The written text is read, with the same plan.
    const std::string written = writePddlDomain(read.domain), text = writePddlProblem(read);
    const LogicProblem again = readPddlProblem(text, readPddlDomain(written));
    EXPECT_EQ(writePddlDomain(again.domain), written);
    EXPECT_EQ(writePddlProblem(again), text);
    PlanSearch second(ground(again));
    const auto other = second.next();
    EXPECT_TRUE(other && actionWords(second.problem(), *other) == words) << written << text;
    return join(actions, " ");
  } catch (const Error& error) {
    return error.what();
  }
}

std::string depotDomain(const std::string& requirements) {
  return cat("(define (domain depot) (:requirements ", requirements,
             ") (:types cart bay) (:predicates (in ?c - cart ?b - bay) (is-tool ?c - cart)) (:action move :parameters "
             "(?c - cart ?a ?b - bay) :precondition (in ?c ?a) :effect (and (in ?c ?b) (not (in ?c ?a)))))");
}
constexpr const char* kSwap =
    "(define (problem swap) (:domain depot) (:objects c - cart b1 b2 - bay) (:init (in c b1) (is-tool c)) (:goal (in c "
    "b2)))";

TEST(PddlLanguage, ATypeAndAPredicateOfOneNameAreTwoThings) {
  const std::string domain =
      "(define (domain seals) (:types box) (:predicates (box ?b - box)) (:action seal :parameters (?b - box) "
      ":precondition (not (box ?b)) :effect (box ?b)))";
  EXPECT_EQ(firstPlan(domain, "(define (problem p) (:domain seals) (:objects k - box) (:init) (:goal (box k)))"),
            "(seal k)");
  const std::string pairs =
      "(define (domain seals) (:types box) (:predicates (box ?a ?b - box)) (:action tie :parameters (?a ?b - box) "
      ":precondition (not (= ?a ?b)) :effect (box ?a ?b)))";
  EXPECT_EQ(firstPlan(pairs, "(define (problem p) (:domain seals) (:objects k l - box) (:init) (:goal (box k l)))"),
            "(tie k l)");
}

TEST(PddlLanguage, ATypeMayHaveSeveralSupertypes) {
  const std::string domain =
      "(define (domain trays) (:types tray - item tray - place hand item place - object) (:predicates (above ?h - hand "
      "?p - place) (held ?i - item)) (:action go :parameters (?h - hand ?a ?b - place) :precondition (above ?h ?a) "
      ":effect (and (above ?h ?b) (not (above ?h ?a)))) (:action take :parameters (?i - item) :effect (held ?i)))";
  EXPECT_EQ(firstPlan(domain,
                      "(define (problem p) (:domain trays) (:objects h - hand t1 t2 - tray) (:init (above h t1)) "
                      "(:goal (and (above h t2) (held t1))))"),
            "(go h t1 t2) (take t1)");
}

TEST(PddlLanguage, EitherIsAnyOfSomeTypes) {
  const std::string domain =
      "(define (domain d) (:types a b c) (:predicates (done ?x)) (:action do :parameters (?x - (either a b)) :effect "
      "(done ?x)))";
  const auto problem = [](const char* goal) {
    return cat("(define (problem p) (:domain d) (:objects x - a y - b z - c) (:init) (:goal ", goal, "))");
  };
  EXPECT_EQ(firstPlan(domain, problem("(and (done x) (done y))")), "(do x) (do y)");
  EXPECT_EQ(firstPlan(domain, problem("(done z)")), "exhausted");
  // A type that the goal alone introduces holds for the objects before it.
  EXPECT_EQ(firstPlan(domain, problem("(forall (?x - (either b a)) (done ?x))")), "(do x) (do y)");
}

TEST(PddlLanguage, LettersHaveOneCaseAndNamesKeepTheirFirstSpelling) {
  const std::string domain =
      "(DEFINE (Domain Depot) (:requirements :STRIPS) (:Types Cart bay) (:predicates (In ?c - cart ?b - Bay)) (:action "
      "move :parameters (?C - cart ?a ?b - bay) :Precondition (in ?c ?a) :effect (AND (in ?c ?b) (NOT (in ?c ?a)))))";
  EXPECT_EQ(firstPlan(domain,
                      "(define (Problem swap) (:domain depot) (:objects C1 - CART b1 b2 - bay) (:INIT (IN c1 B1)) "
                      "(:goal (in c1 b2)))"),
            "(move C1 b1 b2)");
}

TEST(PddlLanguage, UntypedConstantsAndParametersThatNothingBindsAreObjects) {
  EXPECT_EQ(firstPlan("(define (domain homes) (:constants hub) (:predicates (at ?p)) (:action home :parameters (?a) "
                      ":precondition (at ?a) :effect (and (at hub) (not (at ?a)))))",
                      "(define (problem one) (:domain homes) (:objects far) (:init (at far)) (:goal (at hub)))"),
            "(home far)");
  EXPECT_EQ(firstPlan("(define (domain tours) (:predicates (at ?p - object) (seen ?p)) (:action go :parameters (?a ?b "
                      "- object) :precondition (at ?a) :effect (and (at ?b) (seen ?b) (not (at ?a)))))",
                      "(define (problem one) (:domain tours) (:objects x y) (:init (at x)) (:goal (seen y)))"),
            "(go x y)");
}

TEST(PddlLanguage, RequirementsThatNothingUsesAreNoObstacle) {
  for (const char* requirement : {":adl", ":fluents", ":derived-predicates :durative-actions", ":no-such-thing"})
    EXPECT_EQ(firstPlan(depotDomain(requirement), kSwap), "(move c b1 b2)") << requirement;
}

TEST(PddlLanguage, DomainAndProblemMayShareAFile) {
  const std::string both = depotDomain(":strips") + "\n" + kSwap;
  EXPECT_EQ(firstPlan(both, both), "(move c b1 b2)");
}

TEST(PddlLanguage, NotInInitAndNestedConjunctionsAreRead) {
  const std::string problem =
      "(define (problem p) (:domain depot) (:objects c - cart b1 b2 - bay) (:init (in c b1) (not (in c b2))) (:goal "
      "(and (and (in c b2)) (and))))";
  EXPECT_EQ(firstPlan(depotDomain(":strips"), problem), "(move c b1 b2)");
  EXPECT_EQ(firstPlan(depotDomain(":strips"),
                      "(define (problem p) (:domain depot) (:objects c - cart b1 - bay) (:init (in c b1) (not (in c "
                      "b1))) (:goal (in c b1)))"),
            "p:1:83: (in c b1) holds and does not hold in :init");
}

TEST(PddlLanguage, TheCheapestPlanComesFirstAndOfEqualCostTheShortest) {
  const std::string domain =
      "(define (domain roads) (:types place) (:predicates (at ?p - place) (road ?a ?b - place)) (:functions "
      "(total-cost) - number (length ?a ?b - place) - number) (:action drive :parameters (?a ?b - place) :precondition "
      "(and (at ?a) (road ?a ?b)) :effect (and (at ?b) (not (at ?a)) (increase (total-cost) (length ?a ?b)))))";
  const auto problem = [](const char* direct, const char* metric) {
    return cat(
        "(define (problem p) (:domain roads) (:objects a b c - place) (:init (at a) (road a b) (road b c) (road "
        "a c) (= (total-cost) 0) (= (length a b) 1) (= (length b c) 1.5) (= (length a c) ",
        direct, ")) (:goal (at c))", metric, ")");
  };
  const char* metric = "(:metric minimize (total-cost))";
  EXPECT_EQ(firstPlan(domain, problem("3", metric)), "(drive a b) (drive b c)");
  EXPECT_EQ(firstPlan(domain, problem("2.5", metric)), "(drive a c)");
  EXPECT_EQ(firstPlan(domain, problem("3", "")), "(drive a c)");  // without a metric each action counts 1
  PlanSearch search(ground(readPddlProblem(problem("3", metric), readPddlDomain(domain))));
  EXPECT_EQ(search.distance(), 2.5);
  EXPECT_EQ(search.problem().cost(*search.next()), 2.5);
  EXPECT_EQ(search.problem().cost(*search.next()), 3);
  EXPECT_FALSE(search.next());
}

TEST(PddlLanguage, ActionsWithoutCostDoNotWander) {
  const std::string domain =
      "(define (domain d) (:constants a) (:predicates (lamp ?x) (open)) (:functions (total-cost)) (:action on "
      ":parameters (?x) "
      ":effect "
      "(lamp ?x)) (:action go :parameters () :precondition (lamp a) :effect (and (open) (increase (total-cost) 3))))";
  EXPECT_EQ(firstPlan(domain,
                      "(define (problem p) (:domain d) (:objects b c d) (:init) (:goal (open)) (:metric minimize "
                      "(total-cost)))"),
            "(on a) (go)");
}

TEST(PddlLanguage, EffectsUnderConditionsSeeTheStateBeforeTheAction) {
  const std::string carts =
      "(define (domain depot) (:types cart bay thing) (:predicates (in ?c - cart ?b - bay) (on ?t - thing ?c - cart) "
      "(at "
      "?t - thing ?b - bay)) (:action move :parameters (?c - cart ?a ?b - bay) :precondition (in ?c ?a) :effect (and "
      "(in "
      "?c ?b) (not (in ?c ?a)) (forall (?t - thing) (when (on ?t ?c) (and (at ?t ?b) (not (at ?t ?a))))))))";
  EXPECT_EQ(
      firstPlan(carts,
                "(define (problem p) (:domain depot) (:objects c - cart b1 b2 - bay k l - thing) (:init (in c b1) "
                "(on k c) (on l c) (at k b1) (at l b1)) (:goal (and (at k b2) (at l b2))))"),
      "(move c b1 b2)");
  const std::string swap =
      "(define (domain d) (:predicates (a) (b)) (:action swap :parameters () :effect (and (when (a) (and (b) (not "
      "(a)))) "
      "(when (b) (and (a) (not (b)))))))";
  EXPECT_EQ(firstPlan(swap, "(define (problem p) (:domain d) (:init (a)) (:goal (and (b) (not (a)))))"), "(swap)");
  // With both, each effect adds what the other deletes: an added fact is not deleted.
  EXPECT_EQ(firstPlan(swap, "(define (problem p) (:domain d) (:init (a) (b)) (:goal (not (a))))"), "exhausted");
}

TEST(PddlLanguage, ConditionsHaveOrImplyForallAndExists) {
  const std::string domain =
      "(define (domain d) (:predicates (key ?x) (lit ?x) (out)) (:action light :parameters (?x) :precondition (imply "
      "(exists (?y) (and (lit ?y) (not (= ?x ?y)))) (key ?x)) :effect (lit ?x)) (:action leave :parameters () "
      ":precondition (or (forall (?x) (lit ?x)) (not (exists (?x) (or (key ?x) (lit ?x))))) :effect (out)))";
  EXPECT_EQ(firstPlan(domain, "(define (problem p) (:domain d) (:objects a b) (:init (key b)) (:goal (out)))"),
            "(light a) (light b) (leave)");
  EXPECT_EQ(firstPlan(domain, "(define (problem p) (:domain d) (:objects a b) (:init) (:goal (out)))"), "(leave)");
  EXPECT_EQ(
      firstPlan(domain,
                "(define (problem p) (:domain d) (:objects a b) (:init) (:goal (exists (?x ?y) (and (lit ?x) (lit "
                "?y) (not (= ?x ?y))))))"),
      "exhausted");
}

TEST(PddlLanguage, AVariableOfAQuantifierHidesThatOfTheAction) {
  const std::string domain =
      "(define (domain d) (:predicates (p ?x) (q ?x)) (:action a :parameters (?x) :precondition (and (p ?x) (not "
      "(forall "
      "(?x) (p ?x)))) :effect (forall (?x) (q ?x))))";
  EXPECT_EQ(
      firstPlan(domain, "(define (problem p) (:domain d) (:objects u v) (:init (p u)) (:goal (and (q u) (q v))))"),
      "(a u)");
}

TEST(PddlLanguage, DerivedPredicatesHoldExactlyWhileTheirRulesHold) {
  // Only clear blocks can be lifted, and `above` is transitive.
  const std::string domain =
      "(define (domain piles) (:types block) (:predicates (on ?a ?b - block) (loose ?a - block) (above ?a ?b - block) "
      "(clear ?a - block) (tidy)) (:derived (above ?a ?b - block) (or (on ?a ?b) (exists (?c - block) (and (on ?a ?c) "
      "(above ?c ?b))))) (:derived (clear ?a - block) (not (exists (?b - block) (above ?b ?a)))) (:derived (tidy) "
      "(forall (?a - block) (clear ?a))) (:action lift :parameters (?a ?b - block) :precondition (and (clear ?a) (on "
      "?a "
      "?b)) :effect (and (loose ?a) (not (on ?a ?b)))) (:action stack :parameters (?a ?b - block) :precondition (and "
      "(loose ?a) (clear ?b) (not (above ?b ?a)) (not (= ?a ?b))) :effect (and (on ?a ?b) (not (loose ?a)))))";
  const auto plan = [&](const char* goal) {
    return firstPlan(domain, cat("(define (problem p) (:domain piles) (:objects a b c - block) (:init (on a b) (on b "
                                 "c)) (:goal ",
                                 goal, "))"));
  };
  EXPECT_EQ(plan("(tidy)"), "(lift a b) (lift b c)");
  EXPECT_EQ(plan("(above b a)"), "(lift a b) (lift b c) (stack b a)");
  EXPECT_EQ(plan("(above c a)"), "exhausted");
  EXPECT_EQ(plan("(and (above a c) (not (above a b)))"), "(lift a b) (lift b c) (stack a c)");
  EXPECT_EQ(plan("(and (above a b) (above b a))"), "exhausted");
}

TEST(PddlLanguage, MistakesWithDerivedPredicatesHaveTheirPlace) {
  const auto error = [](const std::string& rest) {
    return firstPlan("(define (domain depot) (:predicates (p) (q) (r ?x)) " + rest + ")",
                     "(define (problem x) (:domain depot) (:init (p)) (:goal (q)))");
  };
  EXPECT_EQ(error("(:derived (q))"), "d:1:53: expected (:derived (above ?a ?b) (on ?a ?b)), found a list");
  EXPECT_EQ(error("(:derived (r) (q))"), "d:1:63: predicate 'r' has 1 arguments, got 0");
  EXPECT_EQ(error("(:derived (s) (q))"), "d:1:63: unknown predicate 's'; expected one of p, q, r");
  EXPECT_EQ(error("(:derived (r c) (q))"), "d:1:66: parameter 'c' does not begin with '?'");
  EXPECT_EQ(error("(:derived (q) (p)) (:action a :parameters () :effect (not (q)))"),
            "d:1:111: 'q' is derived and cannot be an effect");
  EXPECT_EQ(error("(:derived (p) (q))"), "p:1:44: 'p' is derived and cannot be in :init");
  EXPECT_EQ(error("(:derived (q) (not (r p)))").substr(0, 26), "d:1:75: unknown object 'p'");
  EXPECT_EQ(error("(:derived (q) (not (q)))"),
            "ground: d:1:53: (q) is derived from its own negation; expected rules in which no predicate depends on "
            "that");
}

TEST(PddlLanguage, MistakesHaveTheirPlace) {
  const auto error = [](const std::string& rest) { return firstPlan("(define (domain depot) " + rest + ")", kSwap); };
  EXPECT_EQ(error("(:predicates (p ?x)) (:action a :parameters (?x ?y ?X) :effect (p ?x))"),
            "d:1:75: variable '?x' occurs twice");
  EXPECT_EQ(error("(:predicates (p)) (:action a :parameters () :precondition (> (f) 1) :effect (p))").substr(0, 42),
            "d:1:82: '>' compares numbers, which is not");
  EXPECT_EQ(error("(:predicates (p)) (:action a :parameters () :effect (increase (fuel) 1))").substr(0, 40),
            "d:1:76: 'fuel' increases; only (increase");
  EXPECT_EQ(
      error("(:predicates (p)) (:action a :parameters () :effect (increase (total-cost) (* 2 (w))))").substr(0, 34),
      "d:1:99: '*' in a cost is not suppo");
  EXPECT_EQ(firstPlan(depotDomain(":strips"),
                      "(define (problem p) (:domain depot) (:objects c - cart) (:init) (:goal (is-tool)))"),
            "p:1:72: predicate 'is-tool' has 1 arguments, got 0");
  EXPECT_EQ(firstPlan("(define (domain d) (:predicates (p)) (:action a :parameters () :effect (and (p) (increase "
                      "(total-cost) (c)))) (:functions (c)))",
                      "(define (problem p) (:domain d) (:init) (:goal (p)) (:metric minimize (total-cost)))"),
            "d:1:104: the cost (c) of action 'a' has no value");
}

TEST(PddlLanguage, MistakesOfProblemsNameWhatIsKnown) {
  const std::string domain = depotDomain(":typing"), things = "(:objects c - cart b - bay) ", goal = "(:goal (in c b))";
  const auto error = [&](const std::string& rest) { return firstPlan(domain, "(define (problem p) " + rest + ")"); };
  const auto expect = [](const std::string& message, const std::string& part) {
    EXPECT_NE(message.find(part), std::string::npos) << message;
  };
  expect(error("(:domain depto) " + things + goal), "p:1:21: the problem is of the domain 'depto'; expected 'depot'");
  expect(error(things + "(:init)"), "p:1:1: problem 'p' has no (:goal ...)");
  expect(error(things + "(:init (in c zz))" + goal), ": unknown object 'zz'; expected one of b, c");
  expect(error("(:objects c - lorry)" + goal), ": unknown type 'lorry'; expected one of cart, bay");
  expect(error(things + "(:init (at 5 (in c b)))" + goal), ": facts at a later time are not supported");
  expect(firstPlan(domain + domain, kSwap), ": a second domain in one file; the first is at d:1:1");
}

TEST(PddlLanguage, ArgumentsOfAnotherTypeAreTold) {
  const LogicProblem problem =
      readPddlProblem("(define (problem p) (:objects c - cart b - bay) (:init (in c b)) (:goal (in b c)))",
                      readPddlDomain(depotDomain(":typing"), "d"), "p");
  const std::string told = join(diagnostics(ground(problem)), "; ");
  EXPECT_NE(told.find("p:1:73: 'b' in (in b c) is not of the type 'cart'; p:1:73: 'c' in (in b c) is not of the type"),
            std::string::npos)
      << told;
}

TEST(PddlLanguage, PredicatesThatNoActionHasAreWrittenAndReadAgain) {
  const LogicDomain domain = readPddlDomain(depotDomain(":strips"));
  EXPECT_NE(writePddlDomain(domain).find("(is-tool ?c - cart)"), std::string::npos);
  EXPECT_EQ(firstPlan(depotDomain(":strips"), kSwap), "(move c b1 b2)");  // has (is-tool c)
}

TEST(PddlLanguage, TypedGridsAreGroundedAsFastAsUntypedOnes) {
  // A crate on 9 x 9 cells: 4 (n - 1)^2 n ... moves and pushes; each triple of cells was tried once.
  const int n = 9;
  std::string cells, facts;
  const auto cell = [](int x, int y) { return cat("c", x, "-", y); };
  const int steps[4][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}};
  for (int x = 0; x < n; ++x) {
    for (int y = 0; y < n; ++y) {
      cells += " " + cell(x, y);
      if (x + y > 0 && !(x == 1 && y == 1)) facts += "(free " + cell(x, y) + ")";
      for (int s = 0; s < 4; ++s) {
        const int i = x + steps[s][0], k = y + steps[s][1];
        if (i >= 0 && i < n && k >= 0 && k < n) facts += cat("(next ", cell(x, y), " ", cell(i, k), " s", s, ")");
      }
    }
  }
  const std::string domain =
      "(define (domain pushing) (:types robot crate cell side) (:predicates (at ?r - robot ?c - cell) (stands ?b - "
      "crate "
      "?c - cell) (free ?c - cell) (next ?a ?b - cell ?s - side)) (:action go :parameters (?r - robot ?a ?b - cell ?s "
      "- "
      "side) :precondition (and (at ?r ?a) (free ?b) (next ?a ?b ?s)) :effect (and (at ?r ?b) (free ?a) (not (at ?r "
      "?a)) "
      "(not (free ?b)))) (:action push :parameters (?r - robot ?k - crate ?a ?b ?c - cell ?s - side) :precondition "
      "(and "
      "(at ?r ?a) (stands ?k ?b) (free ?c) (next ?a ?b ?s) (next ?b ?c ?s)) :effect (and (at ?r ?b) (stands ?k ?c) "
      "(free "
      "?a) (not (at ?r ?a)) (not (stands ?k ?b)) (not (free ?c)))))";
  const LogicProblem problem =
      readPddlProblem(cat("(define (problem grid) (:domain pushing) (:objects r - robot k - crate s0 s1 s2 s3 - side",
                          cells, " - cell) (:init (at r c0-0) (stands k c1-1) ", facts, ") (:goal (stands k c1-2)))"),
                      readPddlDomain(domain));
  const GroundProblem made = ground(problem, 20000);  // at most 4 million matches of facts; 81^3 * 4 are 2 million
  EXPECT_EQ(made.actions.size(), std::size_t(4 * n * (n - 1) + 4 * n * (n - 2)));  // moves; pushes along a line
}

}  // namespace
}  // namespace kinegraph
