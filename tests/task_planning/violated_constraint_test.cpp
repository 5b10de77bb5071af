#include "kinegraph/task_planning/violated_constraint.h"

#include <gtest/gtest.h>

#include "kinegraph/solvers/nlp_solver.h"
#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

TEST(ViolatedConstraint, IsToldInMetersAndNothingIsWhereAllHold) {
  const Config C = cubesOnATable(1);
  const auto komo = std::make_shared<Komo>(C, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::jointLimits, {}, ObjectiveType::ineq, 1.);
  komo->addObjective({}, FeatureSymbol::position, {"hand"}, ObjectiveType::eq, 10., {0., 0., 2.});
  EXPECT_NE(violatedConstraint(komo).find("position of hand is missed by 0.4"), std::string::npos)
      << violatedConstraint(komo);
  const auto holds = std::make_shared<Komo>(C, 1., 1, 0);
  EXPECT_EQ(violatedConstraint(holds), "");
}

TEST(ViolatedConstraint, ShapesThatOverlapAreNamed) {
  Config C = cubesOnATable(1);
  C.getFrame("hand").setShape(ShapeType::ssBox, {.04, .04, .04, .004}).setContact(1);
  const auto komo = std::make_shared<Komo>(C, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::positionDiff, {"hand", "b0"}, ObjectiveType::eq, 100.);
  komo->addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, 1.);
  ASSERT_FALSE(NlpSolver(makeNlp(komo), 0).solve().feasible);
  const std::string said = violatedConstraint(komo);
  EXPECT_NE(said.find("hand"), std::string::npos) << said;
  EXPECT_NE(said.find("b0"), std::string::npos) << said;
}

}  // namespace
}  // namespace kinegraph
