#pragma once

#include <Eigen/Core>
#include <vector>

namespace kinegraph::inline solvers_internal {

enum class QuadraticStatus {
  solved,
  infeasible,  ///< the constraints contradict each other
  notConvex,   ///< the Hessian is not positive definite
  stalled,     ///< rounding keeps the method from ending
};

/// Solves small, dense, strictly convex quadratic programs exactly, by the dual active-set method:
///
///     minimize  x' H x / 2 + g' x   subject to   a_i' x = b_i  (equalities),   a_i' x >= b_i  (inequalities)
///
/// The method starts at the unconstrained minimum and activates the equalities. Then it activates the most violated
/// inequality until none is violated. Normals that depend on active ones are handled, also those of equalities.
/// Constraints are compared in units of a_i' x, so that scaling a_i changes the order of activation, not the answer.
///
/// One object solves many programs. `resize` allocates if the number of variables changes or if there are more
/// constraints than ever before; nothing else allocates.
///
///     DualActiveSet program;
///     program.resize(2, 1);
///     program.hessian().setIdentity(), program.gradient() << 1., 2.;
///     program.addInequality(Eigen::Vector2d(0., 1.), 3.);
///     if (program.solve() == QuadraticStatus::solved) use(program.x());  // (-1, 3)
///
/// Source: Goldfarb & Idnani, A numerically stable dual method for solving strictly convex quadratic programs, 1983.
class DualActiveSet {
 public:
  /// A constraint depends on the active ones if the share of its squared normal, in the metric of H^-1, that they do
  /// not span is at most `dependence`. Such a constraint can only replace active ones.
  explicit DualActiveSet(double dependence = 1e-20) : dependence_(dependence) {}

  /// Prepares a program of `variables` variables and up to `constraints` constraints; it has none yet.
  void resize(int variables, int constraints);

  /// Removes all constraints.
  void clear() { constraints_ = equalities_ = 0; }

  Eigen::Ref<Eigen::MatrixXd> hessian() { return hessian_; }  ///< the lower triangle is read
  Eigen::Ref<Eigen::VectorXd> gradient() { return gradient_; }

  /// Adds a' x = b and returns the index of the constraint. Equalities come before all inequalities.
  template <class Derived>
  int addEquality(const Eigen::MatrixBase<Derived>& a, double b) {
    ++equalities_;
    return addInequality(a, b);
  }

  /// Adds a' x >= b and returns the index of the constraint.
  template <class Derived>
  int addInequality(const Eigen::MatrixBase<Derived>& a, double b) {
    normals_.col(constraints_) = a;
    bounds_[constraints_] = b;
    return constraints_++;
  }

  int constraints() const { return constraints_; }

  QuadraticStatus solve();

  const Eigen::VectorXd& x() const { return x_; }

  /// The constraints that hold with equality at x, as indices, and their multipliers: H x + g = sum_k multiplier(k)
  /// a_active(k). Multipliers of inequalities are not negative.
  int activeCount() const { return active_count_; }
  int active(int k) const { return active_[std::size_t(k)]; }
  double multiplier(int k) const { return multipliers_[k]; }

 private:
  bool factorize();
  int mostViolated() const;
  void project(int constraint);
  bool isDependent(double slope) const { return slope <= dependence_ * projection_.squaredNorm(); }
  QuadraticStatus activateEquality(int constraint);
  QuadraticStatus activateInequality(int constraint);
  void append(int constraint);
  void remove(int removed);

  double dependence_;
  int size_ = 0, constraints_ = 0, equalities_ = 0, active_count_ = 0;
  int equalities_active_ = 0;         ///< the first active constraints; they stay active
  Eigen::MatrixXd hessian_, factor_;  ///< H = L L'
  Eigen::MatrixXd basis_, triangle_;  ///< L^-T Q, and R, of the factors L^-1 N = Q R of the active normals N
  Eigen::MatrixXd normals_;           ///< one column per constraint
  Eigen::VectorXd gradient_, bounds_, x_, multipliers_;
  Eigen::VectorXd projection_, step_, decrease_;  ///< of a normal, and changes of x and the multipliers (see project)
  std::vector<int> active_;
  std::vector<char> is_active_;
};

}  // namespace kinegraph::inline solvers_internal
