#include "kinegraph/solvers/algebra/local_model.h"

#include "tests/solvers/algebra/random_rows.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

/// A problem of n variables, the same for n and more: those beyond n have a cost of their own, x_i^2.
class WithIdleVariables final : public Nlp {
 public:
  WithIdleVariables(Nlp& nlp, int more) : nlp_(nlp) {
    const int n = nlp.dimension(), all = n + more;
    types_ = nlp.types();
    types_.insert(types_.begin(), std::size_t(more), sos);
    lower_ = VectorXd::Constant(all, -1.);
    upper_ = VectorXd::Constant(all, 1.);
    linear_.assign(types_.size(), true);
  }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    const int n = nlp_.dimension(), more = dimension() - n, rows = int(nlp_.types().size());
    Jacobian inner = nlp_.makeJacobian();
    VectorXd inner_phi(rows);
    nlp_.evaluate(x.head(n), inner_phi, &inner);
    phi.resize(more + rows);
    phi << x.tail(more), inner_phi;
    if (!J) return;
    MatrixXd dense = MatrixXd::Zero(more + rows, dimension());
    dense.topRightCorner(more, more).setIdentity();
    dense.bottomLeftCorner(rows, n) = inner.toDense();
    for (Eigen::Index row = 0; row < dense.rows(); ++row) {
      for (Eigen::Index i = 0; i < dense.cols(); ++i) J->values[std::size_t(row * dense.cols() + i)] = dense(row, i);
    }
  }

 private:
  Nlp& nlp_;
};

struct Minimum {
  VectorXd step, linearized;
  double decrease;
};

Minimum minimize(Nlp& nlp, int first_constraint, const VectorXd& x, const VectorXd& lambda, double mu, double damping) {
  Jacobian J = nlp.makeJacobian();
  VectorXd phi(Eigen::Index(nlp.types().size()));
  nlp.evaluate(x, phi, &J);
  std::vector<int> costs, constraints;
  for (int row = 0; row < int(nlp.types().size()); ++row) (row < first_constraint ? costs : constraints).push_back(row);
  const auto model = makeLocalModel(nlp, J, costs, constraints);
  model->setJacobian(J);
  model->setCosts(nlp, x, phi);
  const VectorXd c = phi.tail(lambda.size()), low = nlp.lower() - x, high = nlp.upper() - x;
  const LocalModel::Problem problem{c, lambda, mu, damping, low, high, 50};
  Minimum minimum;
  minimum.step = model->minimize(problem);
  minimum.linearized = model->linearized();
  minimum.decrease = model->decrease(problem);
  return minimum;
}

}  // namespace

TEST(LocalModel, FewVariablesAndManyHaveTheSameMinimum) {
  constexpr double kExact = 1e-9;
  Rng rng(0);
  for (int sample = 0; sample < 60; ++sample) {
    const int n = randomInt(2, 8, rng), costs = 2 * n, constraints = randomInt(1, n, rng), more = 12;
    std::vector<ObjectiveType> types(std::size_t(costs), sos);
    for (int j = 0; j < constraints; ++j) types.push_back(j == 0 ? eq : ineq);
    RandomRows few(n, types, rng);
    WithIdleVariables many(few, more);
    const VectorXd x = .3 * randomVector(n, rng).cwiseMin(1.).cwiseMax(-1.);
    VectorXd x_of_many = VectorXd::Zero(n + more), lambda = randomVector(constraints, rng).cwiseAbs();
    x_of_many.head(n) = x;
    const double mu = rng.uniform(.5, 5.), damping = rng.uniform(.01, 1.);
    const Minimum a = minimize(few, costs, x, lambda, mu, damping),
                  b = minimize(many, more + costs, x_of_many, lambda, mu, damping);
    EXPECT_TRUE(near(b.step.head(n), a.step, kExact)) << "sample " << sample;
    EXPECT_TRUE(near(b.step.tail(more), VectorXd::Zero(more), kExact));
    EXPECT_TRUE(near(b.linearized, a.linearized, kExact));
    EXPECT_NEAR(b.decrease, a.decrease, kExact);
  }
}

TEST(LocalModel, MoreDampingGivesAShorterStep) {
  Rng rng(1);
  for (int sample = 0; sample < 40; ++sample) {
    const int n = randomInt(2, 12, rng);
    RandomRows nlp(n, std::vector<ObjectiveType>(std::size_t(3 * n), sos), rng);
    double last = std::numeric_limits<double>::infinity();
    for (const double damping : {.01, .1, 1., 10.}) {
      const double size = minimize(nlp, 3 * n, VectorXd::Zero(n), {}, 1., damping).step.norm();
      EXPECT_LE(size, last * (1. + 1e-9));
      last = size;
    }
  }
}
