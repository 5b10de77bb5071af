#include "kinegraph/solvers/lagrange_gradients.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

/// (x - 3)^2 + y^2 + y with x <= 1, y = 1 and x >= -5.
CallbackNlp plane() {
  return CallbackNlp(2, {sos, sos, f, ineq, eq, ineq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] - 3., x[1], x[1], x[0] - 1., x[1] - 1., -5. - x[0];
    J << 1., 0., 0., 1., 0., 1., 1., 0., 0., 1., -1., 0.;
  });
}

}  // namespace

TEST(LagrangeGradients, AddUpByNameAndAreSortedByTheirPull) {
  CallbackNlp nlp = plane();
  const VectorXd x = Eigen::Vector2d(1.5, 1.25), dual = (VectorXd(6) << 0., 0., 0., 4., -3., 0.).finished();
  const auto list = lagrangeGradients(nlp, x, dual, {"near", "near", "lean", "wall", "line", "far"});
  ASSERT_EQ(list.size(), 4u) << "what is not violated is left out";
  EXPECT_EQ(list[0].name, "wall");
  EXPECT_EQ(list[0].type, ineq);
  EXPECT_EQ(list[0].error, .5);
  EXPECT_EQ(list[0].gradient, 4.);
  EXPECT_EQ(list[1].name, "near");
  EXPECT_EQ(list[1].error, 2.25 + 1.5625);
  EXPECT_NEAR(list[1].gradient, std::hypot(3., 2.5), 1e-12);
  EXPECT_EQ(list[2].name, "line");
  EXPECT_EQ(list[3].name, "lean");
  EXPECT_EQ(list[3].error, 1.25);
  EXPECT_EQ(lagrangeGradients(nlp, x, dual).front().name, "row 3");
}

TEST(LagrangeGradients, ListActiveConstraintsWithoutAnError) {
  CallbackNlp nlp = plane();
  const VectorXd x = Eigen::Vector2d(1., 1.), dual = (VectorXd(6) << 0., 0., 0., 4., -3., 0.).finished();
  const auto list = lagrangeGradients(nlp, x, dual, {"near", "near", "lean", "wall", "line", "far"});
  std::vector<std::string> names;
  for (const auto& entry : list) names.push_back(entry.name);
  EXPECT_EQ(names, (std::vector<std::string>{"near", "wall", "line", "lean"})) << "far has neither";
  EXPECT_EQ(list[1].error, 0.);
  EXPECT_EQ(list[1].gradient, 4.);
}

TEST(LagrangeGradients, CancelOutAtASolution) {
  CallbackNlp nlp = plane();
  SolverOptions options;
  options.stopTolerance = options.stopGTolerance = 1e-9;
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(2), options);
  const auto list = lagrangeGradients(nlp, result.x, result.dual, {"cost", "cost", "cost", "all", "all", "all"});
  EXPECT_NEAR(result.dual[3], 4., 1e-5);
  EXPECT_NEAR(result.dual[4], -3., 1e-5);
  double squares = 0.;
  for (const auto& entry : list) squares = entry.type == sos ? entry.gradient : squares;
  EXPECT_NEAR(squares, std::hypot(4., 2.), 1e-5);
}

TEST(LagrangeGradients, SizesThatDoNotFitAreNamed) {
  CallbackNlp nlp = plane();
  expectError<ValueError>([&] { lagrangeGradients(nlp, VectorXd::Zero(3), {}); }, {"3 entries", "2 variables"});
  expectError<ValueError>([&] { lagrangeGradients(nlp, VectorXd::Zero(2), VectorXd::Zero(1)); },
                          {"1 multipliers", "6 residuals"});
  expectError<ValueError>([&] { lagrangeGradients(nlp, VectorXd::Zero(2), {}, {"one"}); }, {"1 names", "6 residuals"});
}
