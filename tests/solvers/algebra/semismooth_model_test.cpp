#include "kinegraph/solvers/algebra/semismooth_model.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/algebra/band_algebra.h"
#include "kinegraph/solvers/algebra/dense_algebra.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

/// A random problem around x = 0, and its model in a box.
struct Case {
  static constexpr int kVariables = 5, kRows = 9;
  std::vector<ObjectiveType> types = {sos, sos, sos, sos, f, eq, ineq, ineq, ineq};
  MatrixXd A = MatrixXd(kRows, kVariables);
  VectorXd b = VectorXd(kRows), lambda = VectorXd(4), low = VectorXd(kVariables), high = VectorXd(kVariables);

  /// With `at_bounds`, every second variable starts at one of its bounds, and all are strongly coupled.
  explicit Case(int seed, bool at_bounds = false) {
    Rng rng{std::uint64_t(seed)};
    for (double& x : A.reshaped()) x = rng.normal();
    for (double& x : b) x = rng.normal();
    for (double& x : lambda) x = rng.uniform(0., 2.);
    for (double& x : low) x = -rng.uniform(.1, .5);
    for (double& x : high) x = rng.uniform(.1, .5);
    if (at_bounds) A.colwise() += 3. * A.rowwise().sum().eval();
    for (int i = 0; at_bounds && i < kVariables; i += 2) (i % 4 == 0 ? low : high)[i] = 0.;
  }

  /// The model by its definition.
  double value(const VectorXd& d, double mu, double damping) const {
    const VectorXd phi = b + A * d;
    double sum = phi.head(4).squaredNorm() + phi[4] + .5 * damping * d.squaredNorm();
    for (int j = 0; j < 4; ++j) {
      double t = lambda[j] + mu * phi[5 + j];
      if (j > 0) t = std::max(0., t);
      sum += t * t / (2. * mu);
    }
    return sum;
  }
};

template <class Algebra>
class SemismoothModelOf : public ::testing::Test {
 public:
  using Model = SemismoothModel<Algebra>;
};
using Algebras = testing::Types<DenseAlgebra<8>, BandAlgebra>;
TYPED_TEST_SUITE(SemismoothModelOf, Algebras);

}  // namespace

TYPED_TEST(SemismoothModelOf, TheStepThatItFindsIsTheLeastInTheBox) {
  for (int seed = 0; seed < 60; ++seed) {
    const Case c(seed, seed % 2 == 1);
    CallbackNlp nlp(Case::kVariables, c.types, {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
      phi = c.b + c.A * x;
      J = c.A;
    });
    Jacobian J = nlp.makeJacobian();
    VectorXd phi;
    const VectorXd x = VectorXd::Zero(Case::kVariables);
    nlp.evaluate(x, phi, &J);
    typename TestFixture::Model model(nlp, J, {0, 1, 2, 3, 4}, {5, 6, 7, 8});
    model.setJacobian(J);
    model.setCosts(nlp, x, phi, nullptr);
    const double mu = 3., damping = .1;
    const VectorXd constraints = phi.tail(4);
    const LocalModel::Problem problem{constraints, c.lambda, mu, damping, c.low, c.high, 12};
    const VectorXd d = model.minimize(problem);
    EXPECT_TRUE((d.array() >= c.low.array()).all() && (d.array() <= c.high.array()).all());
    EXPECT_TRUE(near(model.linearized(), (c.b + c.A * d).tail(4), 1e-12));
    const double least = c.value(d, mu, damping);
    for (int i = 0; i < Case::kVariables; ++i) {  // enough in a box, as the model is convex and smooth
      for (double step : {1e-3, -1e-3}) {
        VectorXd other = d;
        other[i] = std::clamp(d[i] + step, c.low[i], c.high[i]);
        EXPECT_GE(c.value(other, mu, damping), least - 1e-12) << "seed " << seed << ", variable " << i;
      }
    }
    const VectorXd at_zero = VectorXd::Zero(Case::kVariables);
    EXPECT_NEAR(model.decrease(problem), c.value(at_zero, mu, 0.) - c.value(d, mu, 0.), 1e-12);
    EXPECT_LT(least, c.value(at_zero, mu, damping));
  }
}

TYPED_TEST(SemismoothModelOf, GoesDownAlsoWhereTheCurvatureIsNegative) {
  class Hilltop final : public Nlp {
   public:
    Hilltop() {
      lower_ = VectorXd::Constant(2, -1.);
      upper_ = VectorXd::Constant(2, 1.);
      types_ = {f};
    }
    void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
      phi.setConstant(1, -.5 * x[0] * x[0] - x[1] * x[1]);
      if (J) J->values = {-x[0], -2. * x[1]};
    }
    bool addCostHessian(const VectorXd&, MatrixXd& H) override {
      H += Eigen::Vector2d(-1., -2.).asDiagonal();
      return true;
    }
  } nlp;
  Jacobian J = nlp.makeJacobian();
  VectorXd phi;
  const VectorXd x = Eigen::Vector2d(.25, .5), low = nlp.lower() - x, high = nlp.upper() - x;
  nlp.evaluate(x, phi, &J);
  typename TestFixture::Model model(nlp, J, {0}, {});
  model.setJacobian(J);
  model.setCosts(nlp, x, phi, nullptr);
  const VectorXd none;
  const LocalModel::Problem problem{none, none, 1., 0., low, high, 12};
  const VectorXd d = model.minimize(problem);
  EXPECT_EQ(d, high);
  EXPECT_NEAR(model.decrease(problem), 1.5 - .5 * .25 * .25 - .5 * .5, 1e-12);
}

TYPED_TEST(SemismoothModelOf, FactorizesOnlyWhereTheActiveRowsChange) {
  const Case c(1);
  CallbackNlp nlp(Case::kVariables, std::vector<ObjectiveType>(Case::kRows, sos), {}, {},
                  [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                    phi = c.b + c.A * x;
                    J = c.A;
                  });
  Jacobian J = nlp.makeJacobian();
  VectorXd phi;
  const VectorXd x = VectorXd::Zero(Case::kVariables), far = VectorXd::Constant(Case::kVariables, 1e3);
  nlp.evaluate(x, phi, &J);
  typename TestFixture::Model model(nlp, J, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {});
  model.setJacobian(J);
  model.setCosts(nlp, x, phi, nullptr);
  const VectorXd none;
  const VectorXd d = model.minimize({none, none, 1., 0., -far, far, 12});
  EXPECT_TRUE(near(d, c.A.colPivHouseholderQr().solve(-c.b), 1e-10));
  EXPECT_EQ(model.factorizations(), 1);
}

namespace {

/// Half of |x - (1, 2)|^2 subject to one curved constraint whose second derivatives it tells: strength (x0^2 - x1^2) /
/// 2 = 0.
class Saddle final : public Nlp {
 public:
  explicit Saddle(double strength) : strength_(strength) {
    lower_ = VectorXd::Constant(2, -10.);
    upper_ = VectorXd::Constant(2, 10.);
    types_ = {sos, sos, eq};
    linear_ = {true, true, false};
  }
  Jacobian makeJacobian() const override {
    Jacobian J = Jacobian::dense(3, 2);
    J.values = {1., 0., 0., 1., 0., 0.};
    return J;
  }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    phi = Eigen::Vector3d(x[0] - 1., x[1] - 2., .5 * strength_ * (x[0] * x[0] - x[1] * x[1]));
    if (J) J->values = {1., 0., 0., 1., strength_ * x[0], -strength_ * x[1]};
  }
  std::span<const CurvedRows> curvedRows() const override { return curved_; }
  void addCurvature(int, std::span<const double> weights, Eigen::Ref<MatrixXd> H) override {
    H(0, 0) += weights[0] * strength_;
    H(1, 1) -= weights[0] * strength_;
  }

 private:
  double strength_;
  std::vector<CurvedRows> curved_ = {{2, 1, 0, 2}};
};

}  // namespace

TYPED_TEST(SemismoothModelOf, HasTheCurvatureOfConstraintsUnlessItIsNotConvexThen) {
  const VectorXd x = Eigen::Vector2d(.5, .25), far = VectorXd::Constant(2, 100.), lambda = VectorXd::Constant(1, .8);
  for (const double strength : {1., 20.}) {
    Saddle nlp(strength);
    Jacobian J = nlp.makeJacobian();
    VectorXd phi;
    nlp.evaluate(x, phi, &J);
    typename TestFixture::Model model(nlp, J, {0, 1}, {2});
    model.setJacobian(J);
    model.setCosts(nlp, x, phi, nullptr);
    model.addCurvature(nlp, lambda);
    const VectorXd c = phi.tail(1);
    const double mu = 3.;
    const VectorXd d = model.minimize({c, lambda, mu, 0., -far, far, 12});
    const Eigen::RowVector2d row(strength * x[0], -strength * x[1]);
    Eigen::Matrix2d H = 2. * Eigen::Matrix2d::Identity() + mu * row.transpose() * row;
    if (strength == 1.) H += lambda[0] * strength * Eigen::Vector2d(1., -1.).asDiagonal();
    const Eigen::Vector2d gradient = 2. * phi.head(2) + (lambda[0] + mu * c[0]) * row.transpose();
    EXPECT_TRUE(near(d, -H.inverse() * gradient, 1e-12)) << "strength " << strength;
    EXPECT_NEAR(model.decrease({c, lambda, mu, 0., -far, far, 12}), .5 * gradient.dot(H.inverse() * gradient), 1e-11);
  }
}
