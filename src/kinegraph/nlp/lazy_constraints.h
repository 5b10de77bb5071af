#pragma once

#include <vector>

#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// A problem that a solver works at, with empty rows: constraints that are to hold at all times of a motion and are not
/// known yet have room there.
class LazyConstraints {
 public:
  virtual ~LazyConstraints() = default;

  virtual bool hasRoom() const = 0;

  /// Whether it is asked after each step and not just at the end of rounds, so that steps do not leave the way that they
  /// follow.
  bool isAskedAtEachStep() const { return at_each_step_; }
  void askAtEachStep(bool yes) { at_each_step_ = yes; }

  /// Takes up constraints that x violates, or soon may. `phi` and `J`, which are those of x, are brought up to date;
  /// `rows` are those that were empty, of which multipliers say nothing. `is_solution`: nothing else is left to do at
  /// x, so all are looked for, and only where x violates some. Leaves the problem at x.
  virtual Refinement takeUp(const VectorXd& x, bool is_solution, VectorXd& phi, Jacobian& J,
                            std::vector<int>& rows) = 0;

 private:
  bool at_each_step_ = false;
};

}  // namespace kinegraph
