#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/nlp/nlp.h"

namespace kinegraph {

/// The size of a violation or relaxation, with units.
struct Amount {
  double scaled = 0.;                                         ///< the largest scaled entry
  double meters = std::numeric_limits<double>::quiet_NaN();   ///< nan if no entry is a length; per s^time_order
  double radians = std::numeric_limits<double>::quiet_NaN();  ///< nan if no entry is an angle; per s^time_order
  int time_order = 0;

  std::string str() const;  ///< "3.1 cm", "0.2 rad", "3.1 cm and 0.2 rad", "0.5 (scaled)"
};

/// One of several requirements that contradict each other: an objective, or a bound of a variable.
struct Conflict {
  std::string name;  ///< of the objective, or of the variable of a bound
  bool is_bound = false;
  ObjectiveType type = ObjectiveType::ineq;
  std::vector<std::string> frames;
  std::vector<int> slices;  ///< slices with violations
  std::vector<int> rows;    ///< violated residuals; empty for a bound
  int variable = -1;        ///< variable of a bound; else -1
  double bound = 0.;
  std::vector<std::string> details;  ///< "box and camera overlap by 3 mm"
  Amount violation;                  ///< at the point of least violation; zero for a bound
  double pull = 0.;                  ///< its multiplier there: decrease of the sum of squares per unit of relaxation

  bool suffices = false;  ///< whether its relaxation alone lets all others hold
  Amount relaxation;      ///< the smallest one that was found nearby
  double remaining = 0.;  ///< the largest (scaled) violation of the others after it
};

/// The reason why constraints do not hold at a point.
struct Explanation {
  enum class Verdict {
    holds,        ///< all constraints hold
    not_reached,  ///< a feasible point is nearby: the problem is not solved yet
    conflict,     ///< the constraints contradict each other near this point
  };
  Verdict verdict = Verdict::holds;
  double tolerance = 0.;
  double violation = 0.;            ///< the largest (scaled) at the given point
  double least_violation = 0.;      ///< the largest (scaled) at the point of least sum of squares
  VectorXd x;                       ///< the point of least violation
  std::vector<Conflict> conflicts;  ///< violated objectives, the worst first, then active bounds
  std::string reason;               ///< why a query was refused before anything was solved; "" otherwise
  int best = -1;                    ///< the conflict whose relaxation helps most; -1 if none helps

  std::string str(int at_most = 10) const;
};

/// Finds the constraints that contradict each other around `x`. The function first minimizes the violation from `x`;
/// the constraints that are violated at that minimum, and the bounds that are active there, form the conflict. Then it
/// relaxes each of them in turn, to find whether the others can hold and how much relaxation that takes. Leaves the
/// problem at `x`. `cancellation` is asked at every evaluation; the function throws if it is cancelled.
Explanation explain(Nlp& nlp, const VectorXd& x, double tolerance = 1e-3, const CancellationToken& cancellation = {});

}  // namespace kinegraph
