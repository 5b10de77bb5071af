#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kinegraph/common/text.h"
#include "kinegraph/nlp/problems.h"
#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/solvers/numbers.h"
#include "tests/support/near.h"

using namespace kinegraph;
using enum ObjectiveType;

namespace {

/// A convex quadratic program made around its solution: the gradient of the cost there is a combination of that of
/// active constraints and bounds, whose multipliers are drawn first. The cost is one f row with its Hessian, or a sum
/// of squares.
class KnownModel final : public Nlp {
 public:
  VectorXd solution, multipliers;  ///< of the rows

  KnownModel(Rng& rng, bool sum_of_squares, bool degenerate) : squares_(sum_of_squares) {
    const auto upTo = [&](int count) { return int(rng.uniform(0., count + 1.)); };
    const int n = 1 + upTo(9), equalities = upTo(std::max(0, n - 2)),
              active = upTo(n - 1 - std::min(n - 1, equalities)), inactive = upTo(4);
    const int m = equalities + active + inactive;
    solution = randomMatrix(n, 1, rng);
    root_ = randomMatrix(n + 2, n, rng);
    root_.topRows(n) += 2. * MatrixXd::Identity(n, n);  // well conditioned
    C_ = randomMatrix(m, n, rng);
    if (degenerate && equalities > 1) C_.row(equalities - 1) = -2. * C_.row(0);  // twice the same
    c_ = C_ * solution;
    VectorXd pull = VectorXd::Zero(m);
    for (int j = 0; j < m; ++j) {
      if (j < equalities)
        pull[j] = rng.normal();
      else if (j < equalities + active)
        pull[j] = degenerate && rng.uniform() < .5 ? 0. : rng.uniform(.1, 2.);
      else
        c_[j] += rng.uniform(.1, 1.);
    }
    VectorXd gradient = -C_.transpose() * pull;  // of the cost, at the solution
    lower_ = VectorXd::Constant(n, -kInf);
    upper_ = VectorXd::Constant(n, kInf);
    for (int i = 0; i < n; ++i) {
      const double kind = rng.uniform();
      if (kind < .2) lower_[i] = solution[i] - rng.uniform(.1, 1.);
      if (kind > .9 && m == 0) {  // one that holds it
        upper_[i] = solution[i];
        gradient[i] -= rng.uniform(.1, 2.);
      }
    }
    if (squares_) {
      offset_ = root_ * solution - root_ * (root_.transpose() * root_).inverse() * gradient / 2.;
      types_.assign(std::size_t(n + 2), sos);
    } else {
      P_ = root_.transpose() * root_;
      q_ = gradient - P_ * solution;
      types_ = {f};
    }
    multipliers = VectorXd::Zero(Eigen::Index(types_.size()) + m);
    multipliers.tail(m) = pull;
    types_.insert(types_.end(), std::size_t(equalities), eq);
    types_.insert(types_.end(), std::size_t(active + inactive), ineq);
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    MatrixXd dense(Eigen::Index(types_.size()), x.size());
    phi.resize(dense.rows());
    if (squares_) {
      phi << root_ * x - offset_, C_ * x - c_;
      dense << root_, C_;
    } else {
      phi << .5 * x.dot(P_ * x) + q_.dot(x), C_ * x - c_;
      dense << (P_ * x + q_).transpose(), C_;
    }
    if (!J) return;
    for (int row = 0; row < dense.rows(); ++row) {
      for (int i = 0; i < dense.cols(); ++i) J->values[std::size_t(row * dense.cols() + i)] = dense(row, i);
    }
  }

  bool addCostHessian(const VectorXd&, MatrixXd& H) override {
    if (squares_) return false;
    H += P_;
    return true;
  }

  /// The sum of the rows times their multipliers, by variable.
  VectorXd pull(const VectorXd& duals) const { return C_.transpose() * duals.tail(C_.rows()); }

  std::string text() const {
    return cat(dimension(), " variables, ", squares_ ? "squares" : "f", ", ", C_.rows(), " constraints");
  }

 private:
  bool squares_;
  MatrixXd root_, P_, C_;
  VectorXd q_, offset_, c_;
};

SolverOptions precise() {
  SolverOptions options;
  options.verbose = 0;
  options.stopTolerance = options.stopGTolerance = 1e-10;
  return options;
}

}  // namespace

TEST(QuadraticPrograms, AreSolvedToEightDigits) {
  Rng rng(7);
  for (int i = 0; i < 400; ++i) {
    KnownModel model(rng, i % 2 == 0, false);
    const SolverResult result = solveAugmentedLagrangian(model, VectorXd::Zero(model.dimension()), precise());
    EXPECT_EQ(result.status, SolverStatus::converged) << i << ", " << model.text() << ": " << result.message;
    EXPECT_TRUE(near(result.x, model.solution, 1e-8)) << i << ", " << model.text();
    EXPECT_LT(model.pull(result.dual - model.multipliers).norm(), 1e-8) << i << ", " << model.text();
    EXPECT_EQ(result.evals, 2) << "the start, and the solution: " << i << ", " << model.text();
  }
}

TEST(QuadraticPrograms, WithRowsThatRepeatEachOtherAndConstraintsThatBarelyTouchHaveTheSameSolution) {
  Rng rng(17);
  for (int i = 0; i < 200; ++i) {
    KnownModel model(rng, i % 2 == 0, true);
    const SolverResult result = solveAugmentedLagrangian(model, VectorXd::Zero(model.dimension()), precise());
    EXPECT_TRUE(near(result.x, model.solution, 1e-8)) << i << ", " << model.text() << ": " << result.message;
    EXPECT_LT(model.pull(result.dual - model.multipliers).norm(), 1e-8) << i << ", " << model.text();
    EXPECT_EQ(result.evals, 2) << i << ", " << model.text();
  }
}

TEST(QuadraticPrograms, WithoutConstraintsTakeOneStepOfAnyLength) {
  Rng rng(8);
  for (const int n : {1, 2, 5, 40, 300}) {
    const MatrixXd A = randomMatrix(n + 2, n, rng) + 20. * MatrixXd::Identity(n + 2, n);
    const VectorXd b = 100. * randomMatrix(n + 2, 1, rng);
    CallbackNlp nlp(n, std::vector<ObjectiveType>(std::size_t(n) + 2, sos), {}, {},
                    [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                      phi = A * x - b;
                      J = A;
                    });
    SolverOptions options;
    options.verbose = 0;
    const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(n), options);
    EXPECT_EQ(result.status, SolverStatus::converged);
    EXPECT_TRUE(near(result.x, (A.transpose() * A).ldlt().solve(A.transpose() * b), 1e-9));
    EXPECT_EQ(result.evals, 2) << "the start, and the solution";
  }
}

TEST(QuadraticPrograms, WhoseCostsLeaveVariablesOpenStayNearTheStartInThem) {
  // min (x0 + x1 - 2)^2 subject to x2 >= 1, from (3, 0, 0, 5)
  CallbackNlp nlp(4, {sos, ineq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] + x[1] - 2., 1. - x[2];
    J << 1., 1., 0., 0., 0., 0., -1., 0.;
  });
  const SolverResult result = solveAugmentedLagrangian(nlp, Eigen::Vector4d(3., 0., 0., 5.), precise());
  EXPECT_EQ(result.evals, 2);
  EXPECT_TRUE(near(result.x, Eigen::Vector4d(2.5, -.5, 1., 5.), 1e-8));
}

TEST(QuadraticPrograms, ThatAreNotQuadraticCostOneEvaluationMore) {
  const auto curved = [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] * x[0] - 2.;
    J << 2. * x[0];
  };
  CallbackNlp nlp(1, {eq}, {}, {}, curved);
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Ones(1), precise());
  EXPECT_EQ(result.status, SolverStatus::converged);
  EXPECT_NEAR(result.x[0], std::sqrt(2.), 1e-10);
}
