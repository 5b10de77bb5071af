#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A problem with a known optimum, in exact derivatives.
struct KnownProblem {
  std::string name;
  std::vector<ObjectiveType> types;
  VectorXd lower, upper, start;
  VectorXd optimum;  ///< x
  double cost;       ///< there
  std::function<void(const VectorXd& x, VectorXd& phi, MatrixXd& J)> residuals;
  std::function<MatrixXd(const VectorXd& x)> cost_hessian;  ///< of the sum of f rows; empty: zero
};

/// For the names of tests.
inline void PrintTo(const KnownProblem& problem, std::ostream* out) { *out << problem.name; }

/// Ten problems of W. Hock and K. Schittkowski, Test Examples for Nonlinear Programming Codes, 1981, by their numbers,
/// and Rosenbrock's function. Inequalities g(x) >= 0 of the book are residuals -g(x).
std::vector<KnownProblem> knownProblems();

/// The problem as a solver sees it.
class KnownNlp final : public Nlp {
 public:
  explicit KnownNlp(KnownProblem problem) : problem_(std::move(problem)) {
    types_ = problem_.types;
    lower_ = problem_.lower;
    upper_ = problem_.upper;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    MatrixXd dense = MatrixXd::Zero(Eigen::Index(types_.size()), dimension());
    phi.resize(dense.rows());
    problem_.residuals(x, phi, dense);
    ++evaluations;
    if (!J) return;
    for (Eigen::Index row = 0; row < dense.rows(); ++row) {
      for (Eigen::Index i = 0; i < dense.cols(); ++i) J->values[std::size_t(row * dense.cols() + i)] = dense(row, i);
    }
  }

  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    if (!problem_.cost_hessian) return false;
    H += problem_.cost_hessian(x);
    return true;
  }

  int evaluations = 0;

 private:
  KnownProblem problem_;
};

}  // namespace kinegraph
