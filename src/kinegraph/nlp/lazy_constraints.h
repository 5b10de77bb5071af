#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph::inline nlp_internal {

/// A problem that activates constraints while a solver runs (constraint generation). Inactive residuals reserve space
/// for them.
class LazyConstraints {
 public:
  virtual ~LazyConstraints() = default;

  /// Whether the problem has inactive residuals.
  virtual bool hasCapacity() const = 0;

  /// Whether a solver calls `activate` after each step and not only at the end of rounds, so that steps do not leave
  /// the basin of their initial guess.
  bool activatesAtEachStep() const { return at_each_step_; }
  void setActivationAtEachStep(bool at_each_step) { at_each_step_ = at_each_step; }

  /// Activates constraints that x violates or may violate soon, updates their entries of `phi` and `J`, which hold the
  /// values at x, and sets `activated` to the residuals that were inactive before; these have no multipliers yet. With
  /// `is_solution`, x fulfills all active constraints: the search is complete, and activates only violated constraints.
  /// Leaves the problem at x.
  virtual Refinement activate(const VectorXd& x, bool is_solution, VectorXd& phi, Jacobian& J,
                              std::vector<int>& activated) = 0;

 private:
  bool at_each_step_ = false;
};

}  // namespace kinegraph::inline nlp_internal
