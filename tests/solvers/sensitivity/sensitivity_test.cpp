#include "kinegraph/solvers/sensitivity/sensitivity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/solvers/numbers.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;

constexpr double kStep = 1e-5;

using Residuals = std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)>;

std::shared_ptr<KnownNlp> problemOf(std::vector<ObjectiveType> types, VectorXd lower, VectorXd upper,
                                    Residuals residuals, std::function<MatrixXd(const VectorXd&)> hessian = {}) {
  return std::make_shared<KnownNlp>(KnownProblem{
      "", std::move(types), std::move(lower), std::move(upper), {}, {}, 0., std::move(residuals), std::move(hessian)});
}

/// Minimize (x - p)^2 subject to x >= 0, as a bound or a residual.
Sensitivity atZeroOrAbove(double p, bool as_bound, bool hold_weak = false) {
  const auto nlp =
      as_bound ? problemOf({sos}, vec({0.}), vec({kInf}),
                           [p](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                             phi << x[0] - p;
                             J << 1.;
                           })
               : problemOf({sos, ineq}, vec({-kInf}), vec({kInf}), [p](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                   phi << x[0] - p, -x[0];
                   J << 1., -1.;
                 });
  const VectorXd dual = as_bound ? vec({0.}) : vec({0., 2. * std::max(-p, 0.)});
  return {nlp, vec({std::max(p, 0.)}), dual, {residualTargets(*nlp, {0})}, {hold_weak}};
}

/// The same problem with other values for its residuals and bounds.
KnownProblem moved(KnownProblem problem, const VectorXd& targets, const VectorXd& lower, const VectorXd& upper) {
  const Residuals before = problem.residuals;
  problem.residuals = [before, targets](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    before(x, phi, J);
    phi -= targets;
  };
  problem.lower += lower;
  problem.upper += upper;
  return problem;
}

class OfKnownProblems : public ::testing::TestWithParam<KnownProblem> {};

std::vector<int> finite(const VectorXd& bounds) {
  std::vector<int> found;
  for (int i = 0; i < int(bounds.size()); ++i) {
    if (std::isfinite(bounds[i])) found.push_back(i);
  }
  return found;
}

}  // namespace

TEST_P(OfKnownProblems, IsThatOfDifferencesOfSolutions) {
  const KnownProblem& problem = GetParam();
  const auto nlp = std::make_shared<KnownNlp>(problem);
  SolverOptions options;
  options.verbose = 0;
  const SolverResult result = solveAugmentedLagrangian(*nlp, problem.start, options);
  std::vector<int> rows(problem.types.size());
  std::iota(rows.begin(), rows.end(), 0);
  const std::vector<int> lower = finite(problem.lower), upper = finite(problem.upper);
  Sensitivity sensitivity(nlp, result.x, result.dual,
                          {residualTargets(*nlp, rows), boundsOf(*nlp, lower, false), boundsOf(*nlp, upper, true)});
  EXPECT_TRUE(near(sensitivity.x(), problem.optimum, 1e-7)) << sensitivity.x().transpose();
  ASSERT_EQ(sensitivity.size(), int(rows.size() + lower.size() + upper.size()));
  EXPECT_EQ(sensitivity.message(), "");
  const Eigen::Index m = Eigen::Index(rows.size()), n = problem.start.size();
  MatrixXd differences(n, sensitivity.size());
  for (int k = 0; k < sensitivity.size(); ++k) {
    VectorXd solutions[2];
    for (const int side : {0, 1}) {
      VectorXd targets = VectorXd::Zero(m), low = VectorXd::Zero(n), high = VectorXd::Zero(n);
      const double by = side == 0 ? -kStep : kStep;
      const int bound = k - int(m);
      if (bound < 0)
        targets[k] = by;
      else if (bound < int(lower.size()))
        low[lower[std::size_t(bound)]] = by;
      else
        high[upper[std::size_t(bound) - lower.size()]] = by;
      const auto there = std::make_shared<KnownNlp>(moved(problem, targets, low, high));
      solutions[side] = Sensitivity(there, sensitivity.x(), sensitivity.dual(), {}).x();
    }
    differences.col(k) = (solutions[1] - solutions[0]) / (2. * kStep);
  }
  EXPECT_TRUE(near(sensitivity.jacobian(), differences, 1e-5 * std::max(1., differences.cwiseAbs().maxCoeff())))
      << sensitivity.jacobian() << "\n\n"
      << differences;
  Rng rng(1);
  VectorXd v(n);
  for (double& value : v) value = rng.normal();
  EXPECT_TRUE(near(sensitivity.gradient(v), VectorXd(sensitivity.jacobian().transpose() * v), 1e-8));
}

INSTANTIATE_TEST_SUITE_P(Sensitivity, OfKnownProblems, ::testing::ValuesIn(knownProblems()),
                         [](const auto& info) { return info.param.name; });

TEST(Sensitivity, IsOneWhereAConstraintIsNotTouchedAndZeroWhereItPresses) {
  for (const bool as_bound : {true, false}) {
    Sensitivity above = atZeroOrAbove(1., as_bound), below = atZeroOrAbove(-1., as_bound);
    EXPECT_NEAR(above.jacobian()(0, 0), 1., 1e-12);
    EXPECT_TRUE(above.isRegular()) << above.message();
    EXPECT_TRUE(above.active().empty());
    EXPECT_NEAR(below.jacobian()(0, 0), 0., 1e-12);
    EXPECT_TRUE(below.isRegular()) << below.message();
    EXPECT_EQ(below.active().size(), 1u);
    EXPECT_NEAR(below.gradient(vec({1.}))[0], 0., 1e-12);
  }
}

TEST(Sensitivity, ReportsANonSmoothSolutionWithBothOneSidedDerivatives) {
  for (const bool as_bound : {true, false}) {
    Sensitivity right = atZeroOrAbove(0., as_bound), left = atZeroOrAbove(0., as_bound, true);
    EXPECT_NEAR(right.jacobian()(0, 0), 1., 1e-12) << "without the constraint";
    EXPECT_NEAR(left.jacobian()(0, 0), 0., 1e-12);
    for (Sensitivity* side : {&right, &left}) {
      EXPECT_FALSE(side->isRegular());
      ASSERT_EQ(side->weak().size(), 1u);
      EXPECT_NE(side->message().find("not differentiable"), std::string::npos);
      EXPECT_NE(side->message().find(side->weak()[0]), std::string::npos);
    }
  }
}

TEST(Sensitivity, ALimitThatWasGivenTwiceIsNoKinkUnlessItMovesAway) {
  for (const double dual : {0., 2., 1.}) {  // the bound presses, the residual does, or both
    const auto nlp = problemOf({sos, sos, ineq}, vec({0., -kInf}), vec({kInf, kInf}),
                               [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                                 phi << x[0] + 1., x[1] - x[0], -2. * x[0];
                                 J << 1., 0., -1., 1., -2., 0.;
                               });
    const auto ofNumbers = [&](NlpParameters numbers) {
      return Sensitivity(nlp, vec({0., 0.}), vec({0., 0., .5 * dual}), std::move(numbers));
    };
    Sensitivity of_costs = ofNumbers({residualTargets(*nlp, {0, 1})});
    EXPECT_TRUE(of_costs.isRegular()) << of_costs.message();
    EXPECT_TRUE(near(of_costs.jacobian(), MatrixXd{{0., 0.}, {0., 1.}}, 1e-10));
    Sensitivity of_row = ofNumbers({residualTargets(*nlp, {2})}), of_bound = ofNumbers({boundsOf(*nlp, {0}, false)});
    for (Sensitivity* one : {&of_row, &of_bound}) {
      one->jacobian();
      EXPECT_FALSE(one->isRegular()) << dual;
    }
  }
}

TEST(Sensitivity, TakesConstraintsThatSayTheSame) {
  const auto nlp = problemOf({sos, sos, eq, eq}, vec({-kInf, -kInf}), vec({kInf, kInf}),
                             [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                               phi << x[0] - 3., x[1], x[0] + x[1] - 1., 2. * (x[0] + x[1] - 1.);
                               J << 1., 0., 0., 1., 1., 1., 2., 2.;
                             });
  Sensitivity of_cost(nlp, vec({2., -1.}), {}, {residualTargets(*nlp, {0})});
  EXPECT_TRUE(near(of_cost.x(), vec({2., -1.}), 1e-10));
  EXPECT_TRUE(near(VectorXd(of_cost.jacobian().col(0)), vec({.5, -.5}), 1e-10));
  EXPECT_EQ(of_cost.message(), "");
  Sensitivity of_one(nlp, vec({2., -1.}), {}, {residualTargets(*nlp, {2})});
  of_one.jacobian();
  EXPECT_NE(of_one.message().find("no solution nearby"), std::string::npos) << "they contradict each other then";
}

TEST(Sensitivity, IsTheShortestOneWhereDirectionsAreFree) {
  for (const ObjectiveType type : {sos, eq}) {
    const auto nlp = problemOf({type}, vec({-kInf, -kInf, -kInf}), vec({kInf, kInf, kInf}),
                               [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                                 phi << x[0] + 2. * x[1] + 2. * x[2] - 9.;
                                 J << 1., 2., 2.;
                               });
    Sensitivity sensitivity(nlp, vec({1., 2., 2.}), {}, {residualTargets(*nlp, {0})});
    EXPECT_TRUE(near(VectorXd(sensitivity.jacobian().col(0)), vec({1., 2., 2.}) / 9., 1e-8));
    EXPECT_EQ(sensitivity.freeDirections(), 2);
    EXPECT_NE(sensitivity.message().find("2 directions free"), std::string::npos) << sensitivity.message();
  }
}

TEST(Sensitivity, OfASaddleSaysSo) {
  const auto nlp = problemOf(
      {f, sos}, vec({-kInf, -kInf}), vec({kInf, kInf}),
      [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi << -x[0] * x[0], x[1] - x[0];
        J << -2. * x[0], 0., -1., 1.;
      },
      [](const VectorXd&) { return MatrixXd(Eigen::Vector2d(-2., 0.).asDiagonal()); });
  Sensitivity sensitivity(nlp, vec({0., 0.}), {}, {residualTargets(*nlp, {1})});
  EXPECT_TRUE(sensitivity.isSaddle());
  EXPECT_TRUE(near(VectorXd(sensitivity.jacobian().col(0)), vec({0., 1.}), 1e-10));
}

TEST(Sensitivity, FindsSecondDerivativesThatNobodyTells) {
  // minimize exp(x) - p x:  x = log p
  const auto nlp =
      problemOf({f, f}, vec({-kInf, -kInf}), vec({kInf, kInf}), [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
        phi << std::exp(x[0]) - 2. * x[0], std::cosh(x[1] - x[0]);
        J << std::exp(x[0]) - 2., 0., -std::sinh(x[1] - x[0]), std::sinh(x[1] - x[0]);
      });
  Sensitivity sensitivity(nlp, vec({.69, .7}), {}, {residualTargets(*nlp, {0})});
  EXPECT_TRUE(near(sensitivity.x(), vec({std::log(2.), std::log(2.)}), 1e-8));
}

TEST(Sensitivity, RefusesWhatIsNoSolution) {
  SolverResult result;
  EXPECT_THROW(Sensitivity(result, {}), ValueError);
  result.problem = problemOf({sos}, vec({0.}), vec({1.}), [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0];
    J << 1.;
  });
  result.x = vec({0.});
  result.feasible = false;
  EXPECT_THROW(Sensitivity(result, {}), ValueError);
  EXPECT_THROW(residualTargets(*result.problem, {1}), ValueError);
  EXPECT_THROW(boundsOf(*result.problem, {1}, true), ValueError);
}

}  // namespace kinegraph
