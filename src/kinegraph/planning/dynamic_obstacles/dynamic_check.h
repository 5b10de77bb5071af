#pragma once

#include <functional>
#include <optional>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"
#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph::inline planning_internal {

/// The first contact of a motion with a dynamic obstacle.
struct DynamicContact {
  double time = 0.;   ///< s: until then the motion is collision-free
  int a = 0, b = 0;   ///< frame ids of the scene
  double place = 0.;  ///< path parameter s of the curve
};

/// Checks continuously whether a timed motion of the robot keeps the margin to dynamic obstacles.
///
/// The time is divided at the waypoints of obstacles and at the phases of the time scaling. In between, a motion whose
/// second derivative is at most a deviates from its chord over a time h by at most h^2 / 8 a. EdgeChecker checks the
/// chord with a margin that includes the displacement of the robot by this deviation. If that fails, h is halved, until
/// the added margin is below kLeastSlack.
class DynamicCheck {
 public:
  static constexpr double kTolerance = 1e-5;   ///< m
  static constexpr double kLeastSlack = 1e-4;  ///< m

  /// `scene` must outlive the check. The margin is in m.
  DynamicCheck(const DynamicScene& scene, double margin);

  const DynamicScene& scene() const { return *scene_; }
  double margin() const { return margin_; }
  void setMargin(double margin) { margin_ = margin; }

  /// Whether the robot at q is collision-free at time t (s).
  bool isFree(const VectorXd& q, double t);

  /// Whether it is so from `begin` to `end`, between which no obstacle has a waypoint.
  bool staysFree(const VectorXd& q, double begin, double end);

  /// The least distance of a pair at q and time t (s), m; `most` if no pair is closer.
  double clearance(const VectorXd& q, double t, double most);

  /// Returns the first contact of a time scaling along a curve that begins at time `start` (s). The motion keeps the
  /// limits `acceleration`, (n,).
  std::optional<DynamicContact> contact(const PathCurve& curve, const TimeScaling& scaling,
                                        const VectorXd& acceleration, double start = 0.);

  /// The pair in collision of the last check that failed, frame ids of the scene.
  std::pair<int, int> lastPair() const;

  long evaluations = 0;  ///< edges and configurations that were checked

 private:
  struct Moment {
    double time;  ///< of the time scaling
    VectorXd q;
    double place, acceleration;  ///< s, s''
  };
  struct Piece {
    const PathCurve& curve;
    const ScalingPhase& phase;
    const VectorXd& acceleration;
    double start;
    VectorXd tangent = {};  ///< |dq/ds| of a line; empty on curved pieces
  };
  Moment momentOf(const Piece& piece, double time) const;
  double slackOf(const Piece& piece, const Moment& from, const Moment& to);
  std::optional<DynamicContact> contactIn(const Piece& piece, const Moment& from, const Moment& to);

  const DynamicScene* scene_;
  double margin_;
  State state_;
  EdgeChecker edges_;
};

}  // namespace kinegraph::inline planning_internal
