#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// By how much something is missed, in its own units.
struct Amount {
  double scaled = 0.;                                         ///< the largest entry, as the solver sees it
  double meters = std::numeric_limits<double>::quiet_NaN();   ///< nan: no part of it is a length; per s^time_order
  double radians = std::numeric_limits<double>::quiet_NaN();  ///< nan: no part of it is an angle; per s^time_order
  int time_order = 0;

  std::string str() const;  ///< "3.1 cm", "0.2 rad", "3.1 cm and 0.2 rad", "0.5 (scaled)"
};

/// One of the demands that cannot hold together: an objective, or a bound of a variable.
struct Conflict {
  std::string name;  ///< of the objective; of the variable if it is a bound
  bool is_bound = false;
  ObjectiveType type = ObjectiveType::ineq;
  std::vector<std::string> frames;
  std::vector<int> slices;  ///< where it is violated
  std::vector<int> rows;    ///< of phi that are violated; a bound has none
  int variable = -1;        ///< of a bound
  double bound = 0.;
  std::vector<std::string> details;  ///< "box and camera overlap by 3 mm"
  Amount violation;                  ///< at the point of least violation; a bound holds
  double pull = 0.;  ///< its multiplier there: how much the sum of squares would fall per unit that it gives way

  bool suffices = false;  ///< giving way alone, by `relaxation`, lets everything else hold
  Amount relaxation;      ///< how far it is missed then, at least nearby
  double remaining = 0.;  ///< the largest (scaled) violation of the others then
};

/// Why constraints do not hold at a point.
struct Explanation {
  enum class Verdict {
    holds,        ///< they do
    not_reached,  ///< a point where all hold is nearby: the problem is not solved yet
    conflict,     ///< near here they cannot hold together
  };
  Verdict verdict = Verdict::holds;
  double tolerance = 0.;
  double violation = 0.;            ///< the largest, scaled, at the point given
  double least_violation = 0.;      ///< the largest, scaled, where the sum of squares is least
  VectorXd x;                       ///< the point of least violation
  std::vector<Conflict> conflicts;  ///< what is violated, the worst first, then the bounds that press
  int best = -1;                    ///< the conflict whose relaxation helps most; -1 if none helps

  std::string str(int at_most = 10) const;
};

/// Finds which constraints contradict each other around `x`. From there it minimizes the violation alone; what is
/// violated at that point, with the bounds that hold it there, is the conflict. Each part of it is then given up in
/// turn, to see whether the others can hold and how far it has to give way. Leaves the problem at `x`. `cancellation`, where
/// given, is called at every evaluation, and may throw.
Explanation explain(Nlp& nlp, const VectorXd& x, double tolerance = 1e-3, const CancellationToken& cancellation = {});

}  // namespace kinegraph
