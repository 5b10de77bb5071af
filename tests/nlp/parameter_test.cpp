#include "kinegraph/nlp/parameter.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/nlp/problems.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;

/// phi = (sin(a x), a^2 x y), with a to be moved.
class Waves final : public FiniteDifferenceParameter {
 public:
  Waves() : FiniteDifferenceParameter("a", {"a"}) {}
  double a = 2.;

 private:
  void move(Nlp&, int, double by) override { a = 2. + by; }
};

}  // namespace

TEST(Parameter, NumbersThatMoveHaveTheDerivativesOfTheFormula) {
  Waves waves;
  CallbackNlp nlp(2, {sos, eq}, {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << std::sin(waves.a * x[0]), waves.a * waves.a * x[0] * x[1];
    J << waves.a * std::cos(waves.a * x[0]), 0., waves.a * waves.a * x[1], waves.a * waves.a * x[0];
  });
  const VectorXd x = Eigen::Vector2d(.3, .7), weights = Eigen::Vector2d(1.5, -2.);
  VectorXd phi(2), moved = VectorXd::Zero(2), gradient = VectorXd::Zero(2);
  Jacobian J = nlp.makeJacobian();
  nlp.evaluate(x, phi, &J);
  waves.differentiate({nlp, x, phi, J, weights, {}}, 0, moved, gradient);
  const double a = 2., c = std::cos(a * x[0]), s = std::sin(a * x[0]);
  EXPECT_TRUE(near(moved, Eigen::Vector2d(x[0] * c, 2. * a * x[0] * x[1]), 1e-8));
  EXPECT_TRUE(
      near(gradient, Eigen::Vector2d(1.5 * (c - a * x[0] * s) - 4. * a * 2. * x[1] / 2., -4. * a * x[0]), 1e-8));
  EXPECT_EQ(waves.a, 2.) << "it is back";
}

TEST(Parameter, TargetsAreSubtractedFromTheirResidualsAlone) {
  CallbackNlp nlp(1, {sos, eq, ineq}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd&) {});
  const auto targets = residualTargets(nlp, {2, 0});
  ASSERT_EQ(targets->size(), 2);
  const VectorXd x = VectorXd::Zero(1), weights = VectorXd::Ones(3);
  VectorXd phi = VectorXd::Zero(3), gradient = VectorXd::Zero(1);
  targets->differentiate({nlp, x, phi, nlp.makeJacobian(), weights, {}}, 0, phi, gradient);
  EXPECT_TRUE(near(phi, Eigen::Vector3d(0., 0., -1.), 0.));
  EXPECT_EQ(gradient[0], 0.);
  EXPECT_THROW(residualTargets(nlp, {3}), ValueError);
}

TEST(Parameter, BoundsAreOfVariablesThatHaveThem) {
  CallbackNlp nlp(2, {sos}, Eigen::Vector2d(-1., -std::numeric_limits<double>::infinity()),
                  VectorXd::Constant(2, std::numeric_limits<double>::infinity()),
                  [](const VectorXd&, VectorXd&, MatrixXd&) {});
  const auto lower = boundsOf(nlp, {0}, false);
  ASSERT_TRUE(lower->bound(0).has_value());
  EXPECT_EQ(lower->bound(0)->variable, 0);
  EXPECT_FALSE(lower->bound(0)->is_upper);
  EXPECT_THROW(boundsOf(nlp, {1}, false), ValueError);
  EXPECT_THROW(boundsOf(nlp, {0}, true), ValueError);
  EXPECT_THROW(boundsOf(nlp, {2}, false), ValueError);
}

}  // namespace kinegraph
