#pragma once

#include <algorithm>
#include <vector>

#include "kinegraph/solvers/algebra/local_model.h"

namespace kinegraph {

/// A LocalModel whose vectors and matrices are those of an `Algebra`: BandAlgebra or DenseAlgebra. It is defined in
/// semismooth_model.cpp, for these two.
/// Source: Qi & Sun, A nonsmooth version of Newton's method, 1993.
template <class Algebra>
class SemismoothModel final : public LocalModel {
 public:
  SemismoothModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs, std::vector<int> constraints);
  SemismoothModel(const SemismoothModel&) = delete;

  void setJacobian(const Jacobian& J) override;
  bool setCosts(Nlp& nlp, const VectorXd& x, const VectorXd& phi, const MatrixXd* curvature) override;
  void addCurvature(Nlp& nlp, const VectorXd& multipliers) override;
  void setNoCosts(double weight) override;
  double largestCurvature() const override;
  double estimateStep(const Problem& problem) override;
  const VectorXd& minimize(const Problem& problem) override;
  double decrease(const Problem& problem) const override;

 private:
  using Vector = typename Algebra::Vector;
  using Flags = std::vector<char>;

  static constexpr int kSmall = 16;          ///< problems up to this size are taken as dense
  static constexpr double kAtBound = 1e-14;  ///< an entry of the step this near to a bound is put on it
  static constexpr double kLongest = 4.;     ///< most that a Newton step is lengthened

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
  int size() const { return algebra_.size(); }
  double multiplier(int j, double value, const Problem& problem) const;
  double value(const Vector& d, const Vector& Hd, const VectorXd& linear, const Problem& problem) const;
  void linearize(const Vector& d, const Problem& problem, VectorXd& linear) const;
  void findWithinReach(const Problem& problem);
  void begin(const Problem& problem);
  void leaveOutCurvature();
  bool isInside() const;
  double findGradient(const Problem& problem);
  int firstChange(const Problem& problem) const;
  bool factorize(const Problem& problem, int first);
  bool newtonStep(const Problem& problem);
  void addNegativeCurvature(const Problem& problem);
  void findChangesAlongStep(const Problem& problem);
  double roomAlong(double most) const;
  /// Is the model the same quadratic function all over the box, and the Newton step exact?
  bool isQuadratic() const { return n_ <= kSmall && factored_as_is_ && within_reach_.size() == equalities_.size(); }
  double lengthAlong(const Problem& problem, double most) const;
  void move(double alpha);
  bool moveIntoBox(const Problem& problem, double& moved);
  void putOnBounds(Vector& d) const;
  bool keepsActiveSet(const Problem& problem) const;

  const int n_;                    ///< variables
  std::vector<int> linear_costs_;  ///< rows whose squares are in H, of which J is the same everywhere
  std::vector<int> other_costs_;
  const std::vector<int> constraints_;  ///< rows
  bool has_f_ = false, knows_linear_costs_ = false;
  bool knows_f_ = false;  ///< does the problem tell the Hessian of its f terms? It may be indefinite.
  Algebra algebra_;
  std::vector<Curved> curved_;
  bool is_curved_ = false;                      ///< does H have the curvature of constraints?
  std::vector<int> equalities_, inequalities_;  ///< constraints; of the latter those that depend on x here
  std::vector<int> within_reach_;               ///< constraints that can matter in the box
  std::vector<int> out_of_reach_;               ///< those that cannot, and change with d all the same
  std::vector<int> active_list_;                ///< workspace
  Flags is_equality_, active_, factored_active_, fixed_, factored_fixed_;
  bool any_fixed_ = false;
  Vector low_, high_, g_, d_, trial_, r_, s_, Hd_, Hs_, trial_Hd_;
  VectorXd trial_linear_, step_linear_;
  bool is_new_ = true, factored_ = false, factored_as_is_ = true;  ///< without more on the diagonal than the damping
  double factored_mu_ = 0., factored_damping_ = 0.;
};

}  // namespace kinegraph
