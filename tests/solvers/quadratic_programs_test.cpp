#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>

#include "kinegraph/nlp/callback_nlp.h"
#include "kinegraph/solvers/augmented_lagrangian.h"
#include "tests/support/near.h"

using namespace kinegraph;
using enum ObjectiveType;

namespace {

/// min 1/2 x^T P x + q^T x  subject to  A x = b,  G x <= h, as one f row.
struct QuadraticProgram {
  MatrixXd P, A, G;
  VectorXd q, b, h;
};

MatrixXd randomMatrix(int rows, int columns, Rng& rng) {
  MatrixXd M(rows, columns);
  for (double& value : M.reshaped()) value = rng.normal();
  return M;
}

class QpNlp final : public Nlp {
 public:
  explicit QpNlp(const QuadraticProgram& qp) : qp_(qp) {
    types_ = {f};
    types_.insert(types_.end(), qp.b.size(), eq);
    types_.insert(types_.end(), qp.h.size(), ineq);
    lower_ = VectorXd::Constant(qp.q.size(), -std::numeric_limits<double>::infinity());
    upper_ = -lower_;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    phi.resize(Eigen::Index(types_.size()));
    phi << .5 * x.dot(qp_.P * x) + qp_.q.dot(x), qp_.A * x - qp_.b, qp_.G * x - qp_.h;
    if (!J) return;
    MatrixXd dense(phi.size(), x.size());
    dense << (qp_.P * x + qp_.q).transpose(), qp_.A, qp_.G;
    for (int row = 0; row < dense.rows(); ++row) {
      for (int i = 0; i < dense.cols(); ++i) J->values[std::size_t(row * dense.cols() + i)] = dense(row, i);
    }
  }

  bool addCostHessian(const VectorXd&, MatrixXd& H) override {
    H += qp_.P;
    return true;
  }

 private:
  QuadraticProgram qp_;
};

/// The optimum by trying every set of active inequalities: the one whose point satisfies all first-order conditions.
VectorXd reference(const QuadraticProgram& qp) {
  const int n = int(qp.q.size()), me = int(qp.b.size()), mi = int(qp.h.size());
  for (int set = 0; set < 1 << mi; ++set) {
    std::vector<int> active;
    for (int i = 0; i < mi; ++i) {
      if (set >> i & 1) active.push_back(i);
    }
    const int m = me + int(active.size());
    if (m > n) continue;
    MatrixXd C(m, n);
    VectorXd d(m);
    C.topRows(me) = qp.A;
    d.head(me) = qp.b;
    for (std::size_t i = 0; i < active.size(); ++i) {
      C.row(me + int(i)) = qp.G.row(active[i]);
      d[me + int(i)] = qp.h[active[i]];
    }
    MatrixXd K = MatrixXd::Zero(n + m, n + m);
    K.topLeftCorner(n, n) = qp.P;
    K.topRightCorner(n, m) = C.transpose();
    K.bottomLeftCorner(m, n) = C;
    VectorXd right(n + m);
    right << -qp.q, d;
    const VectorXd solution = K.fullPivLu().solve(right), x = solution.head(n);
    const bool inside = mi == 0 || (qp.G * x - qp.h).maxCoeff() <= 1e-10;
    const bool pushes = active.empty() || solution.tail(Eigen::Index(active.size())).minCoeff() >= -1e-10;
    if (inside && pushes) return x;
  }
  throw std::runtime_error("no active set is optimal");
}

QuadraticProgram randomProgram(Rng& rng) {
  const int n = 2 + int(rng.uniform(0., 5.)), me = int(rng.uniform(0., double(n))), mi = int(rng.uniform(0., 6.));
  const MatrixXd R = randomMatrix(n, n, rng);
  const VectorXd inside = randomMatrix(n, 1, rng);
  QuadraticProgram qp;
  qp.P = R * R.transpose() + .1 * MatrixXd::Identity(n, n);
  qp.q = randomMatrix(n, 1, rng);
  qp.A = randomMatrix(me, n, rng);
  qp.G = randomMatrix(mi, n, rng);
  qp.b = qp.A * inside;
  qp.h = qp.G * inside + VectorXd(randomMatrix(mi, 1, rng)).cwiseAbs();
  return qp;
}

}  // namespace

TEST(QuadraticPrograms, AreSolvedToEightDigits) {
  Rng rng(7);
  for (int i = 0; i < 100; ++i) {
    const QuadraticProgram qp = randomProgram(rng);
    QpNlp nlp(qp);
    SolverOptions options;
    options.verbose = 0;
    options.stopTolerance = options.stopGTolerance = 1e-10;
    options.stepMax = 100.;
    const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(qp.q.size()), options);
    EXPECT_EQ(result.status, SolverStatus::converged) << i << ": " << result.message;
    EXPECT_TRUE(near(result.x, reference(qp), 1e-8)) << "program " << i << " of seed 7: " << qp.q.size() << " variables, " << qp.b.size()
                                                     << " equalities, " << qp.h.size() << " inequalities";
  }
}

TEST(QuadraticPrograms, WithoutConstraintsTakeOneStepWithoutDamping) {
  Rng rng(8);
  for (int i = 0; i < 20; ++i) {
    const int n = 1 + i % 7;
    const MatrixXd A = randomMatrix(n + 2, n, rng);
    const VectorXd b = randomMatrix(n + 2, 1, rng);
    CallbackNlp nlp(n, std::vector<ObjectiveType>(n + 2, sos), {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
      phi = A * x - b;
      J = A;
    });
    SolverOptions options;
    options.damping = 0.;
    options.stepMax = 1e3;
    options.stopTolerance = 1e-3;
    const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(n), options);
    EXPECT_EQ(result.status, SolverStatus::converged);
    EXPECT_TRUE(near(result.x, (A.transpose() * A).ldlt().solve(A.transpose() * b), 1e-6));
    EXPECT_EQ(result.evals, 2) << "the start, and the solution";
  }
}
