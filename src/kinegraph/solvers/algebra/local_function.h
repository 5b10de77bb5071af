#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/solvers/algebra/local_model.h"

namespace kinegraph {

/// What a LocalModel consists of, taken from a problem around a point: costs, constraints, and their curvature. Vectors
/// and matrices are those of an `Algebra`: BandAlgebra or DenseAlgebra. It is defined in local_function.cpp, for these
/// two; SemismoothModel minimizes it.
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

  static constexpr int kSmall = 16;  ///< problems up to this size are taken as dense

  int size() const { return algebra_.size(); }
  void leaveOutCurvature();
  double multiplier(int j, double value, const Problem& problem) const {
    const double t = problem.lambda[j] + problem.mu * value;
    return is_equality_[std::size_t(j)] ? t : std::max(0., t);
  }

  const int n_;                         ///< variables
  const std::vector<int> constraints_;  ///< rows
  const bool has_f_;
  bool knows_f_ = false;  ///< does the problem tell the Hessian of its f terms? It may be indefinite.
  Algebra algebra_;
  std::vector<char> is_equality_;
  std::vector<int> equalities_, inequalities_;  ///< constraints; of the latter those that depend on x here
  Vector g_;
  bool is_curved_ = false;  ///< does H have the curvature of constraints?
  bool is_new_ = true;      ///< something has changed since it was minimized

 private:
  /// Rows whose curvature the problem tells.
  struct Curved {
    int index;       ///< among Nlp::curvedRows
    int constraint;  ///< that of the first row
    int rows, column;
    MatrixXd H;  ///< room for the lower triangle, among the variables from `column` on
  };

  static bool hasRowsOfTypeF(const Nlp& nlp) {
    return std::find(nlp.types().begin(), nlp.types().end(), ObjectiveType::f) != nlp.types().end();
  }

  std::vector<int> linear_costs_;  ///< rows whose squares are in H, of which J is the same everywhere
  std::vector<int> other_costs_;
  bool knows_linear_costs_ = false;
  std::vector<Curved> curved_;
};

}  // namespace kinegraph
