#pragma once

#include <vector>

#include "kinegraph/solvers/algebra/local_function.h"

namespace kinegraph::inline solvers_internal {

/// A LocalModel that a semismooth Newton method minimizes, with the vectors and matrices of an `Algebra`: BandAlgebra
/// or DenseAlgebra. semismooth_model.cpp instantiates it for both.
/// Source: Qi & Sun, A nonsmooth version of Newton's method, 1993.
template <class Algebra>
class SemismoothModel final : public LocalFunction<Algebra> {
 public:
  using Problem = LocalModel::Problem;

  SemismoothModel(const Nlp& nlp, const Jacobian& pattern, const std::vector<int>& costs, std::vector<int> constraints);

  double estimateStep(const Problem& problem) override;
  const VectorXd& minimize(const Problem& problem) override;
  double decrease(const Problem& problem) const override;

 private:
  using Function = LocalFunction<Algebra>;
  using Vector = typename Algebra::Vector;
  using Flags = std::vector<char>;

  static constexpr double kAtBound = 1e-14;  ///< entries of the step this close to a bound move onto it
  static constexpr double kLongest = 4.;     ///< largest factor of a Newton step

  using Function::algebra_, Function::n_, Function::size, Function::kSmall, Function::multiplier;
  using Function::constraints_, Function::equalities_, Function::inequalities_, Function::is_equality_;
  using Function::g_, Function::is_curved_, Function::is_new_, Function::knows_f_, Function::omitCurvature;
  using Function::step_, Function::linear_, Function::factorizations_;

  double value(const Vector& d, const Vector& Hd, const VectorXd& linear, const Problem& problem) const;
  void linearize(const Vector& d, const Problem& problem, VectorXd& linear) const;
  void findWithinReach(const Problem& problem);
  void begin(const Problem& problem);
  bool isInside() const;
  double findGradient(const Problem& problem);
  int firstChange(const Problem& problem) const;
  bool factorize(const Problem& problem, int first);
  bool newtonStep(const Problem& problem);
  void addNegativeCurvature(const Problem& problem);
  void findChangesAlongStep(const Problem& problem);
  double lengthToBound(double most) const;
  /// Whether the model is one quadratic function in the whole box, and the Newton step exact.
  bool isQuadratic() const { return n_ <= kSmall && factored_as_is_ && within_reach_.size() == equalities_.size(); }
  double lengthAlong(const Problem& problem, double most) const;
  void move(double alpha);
  bool moveIntoBox(const Problem& problem, double& moved);
  void putOnBounds(Vector& d) const;
  bool keepsActiveSet(const Problem& problem) const;

  std::vector<int> within_reach_;  ///< constraints that may matter in the box
  std::vector<int> out_of_reach_;  ///< constraints that do not, but depend on d
  std::vector<int> active_list_;   ///< workspace
  Flags active_, factored_active_, fixed_, factored_fixed_;
  bool any_fixed_ = false;
  Vector low_, high_, d_, trial_, r_, s_, Hd_, Hs_, trial_Hd_;
  VectorXd trial_linear_, step_linear_;
  bool factored_ = false, factored_as_is_ = true;  ///< without additions to the diagonal beyond the damping
  double factored_mu_ = 0., factored_damping_ = 0.;
};

}  // namespace kinegraph::inline solvers_internal
