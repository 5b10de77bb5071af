#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/solvers/nlp_solver.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

/// A known problem with its rows in another order, or more than once, all of them times a factor where the optimum
/// stays.
class Rearranged final : public Nlp {
 public:
  Rearranged(KnownProblem problem, std::vector<int> rows, double factor)
      : inner_(std::move(problem)), rows_(std::move(rows)), factor_(factor) {
    for (int row : rows_) types_.push_back(inner_.types()[row]);
    lower_ = inner_.lower();
    upper_ = inner_.upper();
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    VectorXd inner_phi;
    Jacobian inner_J = inner_.makeJacobian();
    inner_.evaluate(x, inner_phi, &inner_J);
    phi = factor_ * inner_phi(rows_);
    if (!J) return;
    const Eigen::Index n = x.size();
    for (std::size_t i = 0; i < rows_.size(); ++i) {
      for (Eigen::Index k = 0; k < n; ++k)
        J->values[i * std::size_t(n) + std::size_t(k)] = factor_ * inner_J.values[std::size_t(rows_[i] * n + k)];
    }
  }

  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    MatrixXd inner = MatrixXd::Zero(x.size(), x.size());
    const bool has_one = inner_.addCostHessian(x, inner);
    H += factor_ * inner;
    return has_one;
  }

 private:
  KnownNlp inner_;
  std::vector<int> rows_;
  double factor_;
};

std::vector<int> allRows(const KnownProblem& problem) {
  std::vector<int> rows;
  for (int row = 0; row < int(problem.types.size()); ++row) rows.push_back(row);
  return rows;
}

SolverOptions precise(double tolerance = 1e-7) {
  SolverOptions options;
  options.verbose = 0;
  options.stopTolerance = options.stopGTolerance = tolerance;
  return options;
}

}  // namespace

class SolverLaw : public ::testing::TestWithParam<KnownProblem> {};

TEST_P(SolverLaw, TheOrderOfRowsDoesNotMoveTheSolution) {
  const KnownProblem& problem = GetParam();
  std::vector<int> rows = allRows(problem);
  std::reverse(rows.begin(), rows.end());
  Rearranged nlp(problem, rows, 1.);
  const SolverResult result = solve(nlp, problem.start, precise());
  EXPECT_TRUE(near(result.x, problem.optimum, 1e-4)) << result.message;
}

TEST_P(SolverLaw, ConstraintsThatAreThereTwiceDoNotMoveTheSolution) {
  const KnownProblem& problem = GetParam();
  std::vector<int> rows = allRows(problem);
  for (int row : allRows(problem)) {
    const ObjectiveType type = problem.types[std::size_t(row)];
    if (type == ObjectiveType::eq || type == ObjectiveType::ineq) rows.push_back(row);
  }
  Rearranged nlp(problem, rows, 1.);
  const SolverResult result = solve(nlp, problem.start, precise());
  EXPECT_TRUE(near(result.x, problem.optimum, 1e-4)) << result.message;
}

TEST_P(SolverLaw, RowsTwiceAsLargeHaveTheSameSolution) {
  const KnownProblem& problem = GetParam();
  Rearranged nlp(problem, allRows(problem), 2.);
  const SolverResult result = solve(nlp, problem.start, precise());
  EXPECT_TRUE(near(result.x, problem.optimum, 1e-4)) << result.message;
}

TEST_P(SolverLaw, MoreAccuracyDoesNotCostMore) {
  const KnownProblem& problem = GetParam();
  KnownNlp nlp(problem);
  const SolverResult loose = solve(nlp, problem.start, precise(1e-3)), tight = solve(nlp, problem.start, precise(1e-6));
  const double cost = loose.f + loose.sos;
  double bought = 0.;  // by violation
  for (int row = 0; row < tight.dual.size(); ++row) bought += std::abs(tight.dual[row]) * 1e-3;
  EXPECT_LE(tight.f + tight.sos, cost + .01 * std::abs(cost) + 2. * bought + 1e-6) << tight.message;
}

INSTANTIATE_TEST_SUITE_P(KnownProblems, SolverLaw, ::testing::ValuesIn(knownProblems()),
                         [](const auto& info) { return info.param.name; });
