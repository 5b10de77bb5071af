#include "kinegraph/solvers/local_model.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/callback_nlp.h"
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
  double value(const VectorXd& d, double mu, double shift) const {
    const VectorXd phi = b + A * d;
    double sum = phi.head(4).squaredNorm() + phi[4] + .5 * shift * d.squaredNorm();
    for (int j = 0; j < 4; ++j) {
      double t = lambda[j] + mu * phi[5 + j];
      if (j > 0) t = std::max(0., t);
      sum += t * t / (2. * mu);
    }
    return sum;
  }
};

}  // namespace

TEST(LocalModel, TheStepThatItFindsIsTheLeastInTheBox) {
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
    LocalModel model(nlp, J, {0, 1, 2, 3, 4}, {5, 6, 7, 8});
    model.setJacobian(J);
    model.setCosts(nlp, x, phi);
    const double mu = 3., shift = .1;
    const VectorXd constraints = phi.tail(4);
    const LocalModel::Problem problem{constraints, c.lambda, mu, shift, c.low, c.high, 12};
    const VectorXd d = model.minimize(problem);
    EXPECT_TRUE((d.array() >= c.low.array()).all() && (d.array() <= c.high.array()).all());
    EXPECT_TRUE(near(model.linearized(), (c.b + c.A * d).tail(4), 1e-12));
    const double least = c.value(d, mu, shift);
    for (int i = 0; i < Case::kVariables; ++i) {  // enough in a box, as the model is convex and smooth
      for (double step : {1e-3, -1e-3}) {
        VectorXd other = d;
        other[i] = std::clamp(d[i] + step, c.low[i], c.high[i]);
        EXPECT_GE(c.value(other, mu, shift), least - 1e-12) << "seed " << seed << ", variable " << i;
      }
    }
    const VectorXd at_zero = VectorXd::Zero(Case::kVariables);
    EXPECT_NEAR(model.decrease(problem), c.value(at_zero, mu, 0.) - c.value(d, mu, 0.), 1e-12);
    EXPECT_LT(least, c.value(at_zero, mu, shift));
  }
}

TEST(LocalModel, GoesDownAlsoWhereTheCurvatureIsNegative) {
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
  LocalModel model(nlp, J, {0}, {});
  model.setJacobian(J);
  model.setCosts(nlp, x, phi);
  const VectorXd none;
  const LocalModel::Problem problem{none, none, 1., 0., low, high, 12};
  const VectorXd d = model.minimize(problem);
  EXPECT_EQ(d, high);
  EXPECT_NEAR(model.decrease(problem), 1.5 - .5 * .25 * .25 - .5 * .5, 1e-12);
}

TEST(LocalModel, FactorizesOnlyWhereTheActiveRowsChange) {
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
  LocalModel model(nlp, J, {0, 1, 2, 3, 4, 5, 6, 7, 8}, {});
  model.setJacobian(J);
  model.setCosts(nlp, x, phi);
  const VectorXd none;
  const VectorXd d = model.minimize({none, none, 1., 0., -far, far, 12});
  EXPECT_TRUE(near(d, c.A.colPivHouseholderQr().solve(-c.b), 1e-10));
  EXPECT_EQ(model.factorizations(), 1);
}
