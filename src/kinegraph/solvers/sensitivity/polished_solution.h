#pragma once

#include <string>
#include <vector>

#include "kinegraph/nlp/nlp.h"
#include "kinegraph/solvers/sensitivity/kkt_system.h"
#include "kinegraph/solvers/sensitivity/lagrangian_curvature.h"

namespace kinegraph::inline solvers_internal {

/// A solution up to rounding errors: a primal-dual active set method refines the result of a solver by a few Newton
/// steps on the optimality conditions. The linearized conditions stay factorized.
/// Source: Hintermüller, Ito, Kunisch, The primal-dual active set strategy as a semismooth Newton method, 2003.
class PolishedSolution {
 public:
  /// Starts at x, with one multiplier per residual. `is_near` marks residuals that may be active if they are nearly
  /// zero. `holds_weak`: whether weakly active constraints count as active. Throws Error if the method does not
  /// converge.
  PolishedSolution(Nlp& nlp, const VectorXd& x, const VectorXd& dual, const std::vector<char>& is_near,
                   bool holds_weak);

  VectorXd x, phi;
  VectorXd dual;     ///< multiplier per residual
  VectorXd weights;  ///< per residual: weight of its gradient in that of the Lagrangian
  Jacobian J;

  std::vector<int> active;                  ///< active residuals
  std::vector<char> fixed;                  ///< per variable: whether it is fixed at a bound
  std::vector<int> weak_rows;               ///< weakly active inequalities
  std::vector<int> weak_lower, weak_upper;  ///< variables with a weakly active bound
  int evals = 0;

  KktSystem& system() { return system_; }
  const std::vector<int>& squared() const { return squared_; }  ///< residuals with squares in H

 private:
  bool converge();
  bool step();
  void evaluate();
  void weigh();
  void linearize();
  bool chooseActive(bool is_first);
  void solveTightly();
  void classify();

  Nlp& nlp_;
  std::vector<char> is_near_;
  bool holds_weak_;
  bool has_costs_, knows_costs_;
  KktSystem system_;
  LagrangianCurvature curvature_;
  std::vector<int> squared_;
  VectorXd gradient_;         ///< of the Lagrangian
  bool deactivated_ = false;  ///< of an active residual, since the last call of weigh
  VectorXd last_step_;
  double curvature_scale_ = 1.;
  double force_scale_ = 0.;           ///< largest weighted gradient of a residual
  double moved_ = 0.;                 ///< length of the last step
  bool multipliers_settled_ = false;  ///< whether the last step left the multipliers unchanged
  VectorXd bound_multipliers_;        ///< multipliers of the bounds, positive at upper ones
};

}  // namespace kinegraph::inline solvers_internal
