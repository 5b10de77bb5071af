#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace kinegraph::inline collision_internal {
class EdgeEngine;
class MotionChecker;
}

namespace kinegraph::inline kinematics_internal {
struct KinematicModel;
class State;
}

namespace kinegraph {

/// The first contact of an edge: a pair that comes too close, or a dof that leaves its limits.
struct MotionContact {
  double time = 0.;      ///< in [0, 1]: until then the edge is free
  int a = 0, b = 0;      ///< frame ids; for a limit, both are the joint's
  double distance = 0.;  ///< of the pair at `time`, m; for a limit: the distance to it, m or rad
  int dof = -1;          ///< for a limit: the entry of q; else -1
};

/// Tolerance of joint limits, rad or m. Files round: single precision by 1e-7, and 3.14159 for pi by 3e-6.
inline constexpr double kLimitTolerance = 1e-5;

/// A dof that leaves its limits along an edge.
struct LimitPassed {
  double time = 0.;    ///< in [0, 1]: when it leaves them; 0 if it begins outside
  int dof = 0;         ///< entry of q
  double beyond = 0.;  ///< excess at that time, rad or m; positive only at time 0
};

/// Whether all dofs are within their limits, to kLimitTolerance.
bool withinLimits(const KinematicModel& model, const double* q);

/// The first dof that exceeds its limits by more than kLimitTolerance along the edge between two q.
std::optional<LimitPassed> firstLimitPassed(const KinematicModel& model, const double* from, const double* to);

/// The frame of the joint of a dof; -1 if there is none.
int frameOfDof(const KinematicModel& model, int dof);

/// Checks configurations and edges of one scene for collisions. An edge is the straight motion q(s) = (1 - s) from + s
/// to, 0 <= s <= 1. It is free if all pairs that joints move apart (KinematicModel::movingPairs) keep the margin,
/// continuously and not only at samples. MotionChecker, which computes the *first* contact, agrees up to the tolerance.
/// Joint limits are not checked (see withinLimits).
///
/// Every thread has its own; a copy has the same settings and no history. Results do not depend on earlier checks,
/// except `lastHit`: the pair of the last collision is checked first.
class EdgeChecker {
 public:
  static constexpr int kLanes = 8;  ///< configurations that are checked side by side

  /// Takes any State of the scene. `isFree` of an edge may return false for a pair within margin + tolerance (m, > 0).
  explicit EdgeChecker(const State& scene, double margin = 0., double tolerance = 1e-5);
  EdgeChecker(const EdgeChecker& other);
  ~EdgeChecker();

  /// The distance that all pairs have to keep, m. If it is negative, pairs may penetrate by that much.
  double margin() const { return margin_; }
  void setMargin(double margin) { margin_ = margin; }
  void setTolerance(double tolerance);

  const State& scene() const { return *state_; }

  /// Whether all pairs are at least `margin` apart at q (dofs numbers).
  bool isFree(const double* q);

  /// Checks at most kLanes configurations at once, and writes one result each. Fastest for consecutive ones of a path.
  void areFree(std::span<const double* const> Q, bool* free);

  /// Whether all of them are free. Returns at the first pair that is too close in any of them.
  bool areAllFree(std::span<const double* const> Q);

  /// Whether an edge is free, continuously. Returns at the first pair that is too close at any time.
  bool isFree(const double* from, const double* to);

  /// A pair in collision of the last check that failed, with time and distance. The time of a configuration is 0.
  const std::optional<MotionContact>& lastHit() const;
  /// The same without its distance (NaN), which takes time to compute.
  const std::optional<MotionContact>& lastHitPair() const;

  /// Forgets the last collision.
  void forget();

  /// The first contact along an edge; see MotionChecker. None if it is free.
  std::optional<MotionContact> firstContact(const double* from, const double* to);

  /// The least distance of all pairs at q, m; `most` if no pair is closer.
  double clearance(const double* q, double most = std::numeric_limits<double>::infinity());

  /// A lower bound of the least distance of all pairs along an edge, m, within the tolerance; `most` if no pair is
  /// closer.
  double clearance(const double* from, const double* to, double most);

  /// The local minima of the distances of pairs along an edge that are below `most` (m), the ends excluded. They are
  /// found from samples (8 per .35 m of displacement) and refined; some may be missed.
  const std::vector<MotionContact>& approaches(const double* from, const double* to, double most);

 private:
  std::unique_ptr<const State> state_;
  double margin_, tolerance_;
  std::unique_ptr<EdgeEngine> engine_;
  std::unique_ptr<MotionChecker> motions_;  ///< constructed on first use
  std::vector<MotionContact> approaches_;
};

}  // namespace kinegraph
