#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/solvers/algebra/local_model.h"

namespace kinegraph::inline solvers_internal {

/// The terms of a LocalModel at a point: costs, constraints, and their curvature, with the vectors and matrices of an
/// `Algebra`: BandAlgebra or DenseAlgebra. local_function.cpp instantiates it for both; SemismoothModel minimizes it.
template <class Algebra>
class LocalFunction : public LocalModel {
 public:
  LocalFunction(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs, std::vector<int> constraints);
  LocalFunction(const LocalFunction&) = delete;

  void setJacobian(const Jacobian& J) override;
  bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature) override;
  void addCurvature(Nlp& nlp, const VectorXd& multipliers) override;
  void setNoCosts(double weight) override;
  double largestCurvature() const override;

 protected:
  using Vector = typename Algebra::Vector;

  static constexpr int kSmall = 16;  ///< problems up to this size are dense

  int size() const { return algebra_.size(); }
  void omitCurvature();
  double multiplier(int j, double value, const Problem& problem) const {
    const double t = problem.lambda[j] + problem.mu * value;
    return is_equality_[std::size_t(j)] ? t : std::max(0., t);
  }

  const int n_;                         ///< number of variables
  const std::vector<int> constraints_;  ///< residuals
  const bool has_f_;
  bool knows_f_ = false;  ///< whether the problem knows the Hessian of its f terms, which may be indefinite
  Algebra algebra_;
  std::vector<char> is_equality_;
  std::vector<int> equalities_, inequalities_;  ///< constraints; inequalities only if they depend on x here
  Vector g_;
  bool is_curved_ = false;  ///< whether H has the curvature of constraints
  bool is_new_ = true;      ///< whether the model has changed since its minimization

 private:
  /// Residuals with known curvature.
  struct Curved {
    int index;       ///< index in Nlp::curvedRows
    int constraint;  ///< constraint of the first residual
    int rows, column;
    MatrixXd H;  ///< lower triangle, for the variables from `column` on
  };

  static bool hasRowsOfTypeF(const Nlp& nlp) {
    return std::find(nlp.types().begin(), nlp.types().end(), ObjectiveType::f) != nlp.types().end();
  }

  std::vector<int> linear_costs_;  ///< residuals in H with a constant Jacobian
  std::vector<int> other_costs_;
  bool knows_linear_costs_ = false;
  std::vector<Curved> curved_;
};

}  // namespace kinegraph::inline solvers_internal
