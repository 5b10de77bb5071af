#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/tool_paths/tool_kinematics.h"

namespace kinegraph::inline tool_paths_internal {

/// Configurations along a tool curve, one per place, that follow each other without jumps: one branch of the inverse
/// kinematics. Wide joints count their turns.
struct Strand {
  std::vector<VectorXd> q;  ///< at the places first, first + 1, ... (or - 1), as far as it gets
  int first = 0, direction = 1;
  double reached = 0.;  ///< the farthest s that it gets to
  int blocked = -1;     ///< the dof whose limit ends it, or -1
  double cost = 0.;     ///< estimated duration, s
  int collides = -1;    ///< index of the first of q that is not free, or -1; see checkStrand
  bool is_checked = false;
};

/// Limits for estimates of durations.
struct StrandLimits {
  VectorXd velocity, acceleration;  ///< (n,)
  double speed = .1;                ///< of the tool, m/s
};

/// Places along a curve for a search. They are at most `spacing` m apart, and closer if the tool rotates by more than
/// .15 rad in between. All corners, changes of the speed and
/// both ends are places, with at least four intervals between them.
std::vector<double> searchPlaces(const ToolCurve& curve, double spacing);

/// Follows the curve from configurations at its start.
class StrandTracker {
 public:
  StrandTracker(ToolKinematics& tool, const ToolCurve& curve, std::vector<double> places, StrandLimits limits);

  const std::vector<double>& places() const { return places_; }

  /// Solutions of the inverse kinematics at places()[index], all different modulo turns, within limits, by Newton's
  /// method from `first` (may be empty) and then `starts` more points of a sequence given by the seed. If the axis has
  /// a cone, two thirds of the starts lean by a fixed tilt.
  struct Seed {
    VectorXd q;
    Vector3d tilt = Vector3d::Zero();  ///< of the axis, in the target's coordinates
  };
  std::vector<Seed> seeds(int index, const std::vector<VectorXd>& first, int starts, std::uint64_t seed);

  /// Follows the curve from a solution at a place as far as possible, to later (1) or earlier (-1) places.
  Strand follow(const Seed& seed, int first = 0, int direction = 1);

  /// Holds the preferred rotation about the free axis, or frees it again. Throws std::bad_optional_access without one.
  void holdPreferred(bool holds);

  /// The target at s, with the axis leaning by a tilt.
  ToolTarget targetAt(double s, const Vector3d& tilt) const;

 private:
  bool advance(VectorXd& q, VectorXd& slope, double from, double to, const Vector3d& tilt, int divisions,
               Strand& strand);
  bool withinTurns(const VectorXd& q, Strand& strand);
  void estimate(Strand& strand);

  ToolKinematics& tool_;
  const ToolCurve& curve_;
  std::vector<double> places_;
  StrandLimits limits_;
  ToolRows rows_;
  double held_ = 0.;       ///< rotation about the free axis, if rows_ is `pose`
  VectorXd least_, most_;  ///< of the present strand
};

/// Sets `collides` and `is_checked` of a strand.
void checkStrand(EdgeChecker& checker, Strand& strand);

/// Shifts wide joints by whole turns so that all configurations are within limits, and near `preferred` if possible.
/// False if none fits; `dof` is then the first one.
bool fitTurns(const ToolKinematics& tool, std::vector<VectorXd>& q, const VectorXd& preferred, int& dof);

/// The chain through nodes (per place, free configurations) with the least sum of squared steps, no joint moving by
/// more than `step` between places; wide joints count modulo turns, and the chain is unrolled. Empty if there is none;
/// `stuck` is then the first place that none reaches. `barred`: per place, pairs of nodes (before, here) that are not
/// connected. `chosen` receives the index of each node.
std::vector<VectorXd> cheapestChain(const ToolKinematics& tool, const std::vector<std::vector<VectorXd>>& nodes,
                                    const std::vector<std::vector<std::pair<int, int>>>& barred, double step,
                                    std::vector<int>& chosen, int& stuck);

/// Makes a chain smoother where the task leaves freedom: alternates between a smoothing spline and projections onto the
/// curve. Configurations that would collide stay.
void smoothChain(ToolKinematics& tool, const ToolCurve& curve, const std::vector<double>& places, EdgeChecker& checker,
                 std::vector<VectorXd>& q);

}  // namespace kinegraph::inline tool_paths_internal
