#include "kinegraph/logic/landmark_cut.h"

#include <gtest/gtest.h>

#include <string>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/plan_search.h"

using namespace kinegraph;

TEST(LandmarkCut, LandmarksAreThoseOfTheRarestPreconditions) {
  const std::string domain = R"((define (domain blocks)
    (:predicates (on ?x ?y) (ontable ?x) (clear ?x) (free) (full) (holding ?x))
    (:action pick :parameters (?x) :precondition (and (clear ?x) (ontable ?x) (free))
      :effect (and (not (ontable ?x)) (not (clear ?x)) (not (free)) (full) (holding ?x)))
    (:action put :parameters (?x) :precondition (and (holding ?x) (full))
      :effect (and (not (holding ?x)) (clear ?x) (free) (not (full)) (ontable ?x)))
    (:action stack :parameters (?x ?y) :precondition (and (holding ?x) (clear ?y) (full))
      :effect (and (not (holding ?x)) (not (clear ?y)) (clear ?x) (free) (not (full)) (on ?x ?y)))))";
  std::string objects, start = "(free)";
  for (int i = 0; i < 9; ++i) {
    const std::string block = cat("b", i);
    objects += " " + block;
    start += cat(" (clear ", block, ") (ontable ", block, ")");
  }
  const std::string text = cat("(define (problem p) (:domain blocks) (:objects", objects, ") (:init ", start,
                               ") (:goal (and (on b0 b1) (on b1 b2) (on b2 b3))))");
  const GroundProblem problem = ground(readPddlProblem(text, readPddlDomain(domain, "domain"), "problem"));
  EXPECT_EQ(LandmarkCut(problem)(problem.start), 6);  // not 4, of actions that any block makes possible
  EXPECT_EQ(PlanSearch(problem).distance(), 6.);
}
