#pragma once

#include <optional>
#include <vector>

#include "kinegraph/nlp/parameter.h"
#include "kinegraph/solvers/sensitivity/polished_solution.h"

namespace kinegraph {

/// Limits that touch without pressing because others press that hold the same variables, as a limit does that was given
/// twice: as a bound and as an objective. They are no kink as long as both move alike.
class DoubledLimits {
 public:
  /// Those of a solution; they are weak no longer.
  explicit DoubledLimits(PolishedSolution& at);

  /// A number moves the residuals by dphi, and a bound, if it is one. Limits that then part from those that press are a
  /// kink after all: they are weak again.
  void move(PolishedSolution& at, const Nlp& nlp, const VectorXd& dphi,
            const std::optional<NlpParameter::Bound>& bound);

 private:
  double motionOf(const PolishedSolution& at, int variable, const VectorXd& dphi) const;

  std::vector<int> rows_, lower_, upper_;
  std::vector<char> is_held_;  ///< per variable: by a bound that presses
  std::vector<int> pin_;       ///< per variable: the row that presses and leaves it no choice, or -1
  int moved_ = -1;             ///< the variable whose bound moves by one
};

}  // namespace kinegraph
