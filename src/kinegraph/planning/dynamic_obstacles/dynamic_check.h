#pragma once

#include <functional>
#include <optional>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/planning/dynamic_obstacles/dynamic_scene.h"
#include "kinegraph/trajectories/scaling_grid.h"
#include "kinegraph/trajectories/time_scaling.h"

namespace kinegraph {

/// Where a motion meets an obstacle that moves.
struct DynamicContact {
  double time = 0.;   ///< s: until then the motion is free
  int a = 0, b = 0;   ///< frame ids of the scene
  double place = 0.;  ///< s of the curve
};

/// Keeps a motion of the robot that is timed the margin away from moving obstacles, at all times?
///
/// Times are divided where an obstacle changes its motion and where the law has another phase. In between, a motion whose
/// second derivative is at most a leaves the chord from time t to t + h by h^2 / 8 a at most: the chord is checked as
/// EdgeChecker does, with so much more room as points of the robot may move meanwhile. Where that is not free, h is
/// halved, until the room is less than kRoom.
class DynamicCheck {
 public:
  static constexpr double kTolerance = 1e-5;  ///< m
  static constexpr double kRoom = 1e-4;       ///< m

  /// `scene` must stay. The margin is in m.
  DynamicCheck(const DynamicScene& scene, double margin);

  const DynamicScene& scene() const { return *scene_; }
  double margin() const { return margin_; }
  void setMargin(double margin) { margin_ = margin; }

  /// Is the robot at q free at t s?
  bool isFree(const VectorXd& q, double t);

  /// And from `begin` to `end`, between which no obstacle changes its motion?
  bool staysFree(const VectorXd& q, double begin, double end);

  /// The least distance of a pair at q and t s, m, or `most`.
  double clearance(const VectorXd& q, double t, double most);

  /// What the motion of a law along a curve meets first, if it begins at `start` s. `acceleration`, (n,), is what it keeps.
  std::optional<DynamicContact> contact(const PathCurve& curve, const TimeScaling& scaling,
                                        const VectorXd& acceleration, double start = 0.);

  /// The pair of the last question that was answered no, ids of frames of the scene.
  std::pair<int, int> lastPair() const;

  long evaluations = 0;  ///< motions and postures that were looked at

 private:
  struct Moment {
    double time;  ///< of the law
    VectorXd q;
    double place, speedup;  ///< s, s''
  };
  struct Piece {
    const PathCurve& curve;
    const ScalingPhase& phase;
    const VectorXd& acceleration;
    double start;
    VectorXd tangent = {};  ///< dq/ds of a line; empty on what is curved
  };
  Moment momentOf(const Piece& piece, double time) const;
  double roomOf(const Piece& piece, const Moment& from, const Moment& to);
  std::optional<DynamicContact> contactIn(const Piece& piece, const Moment& from, const Moment& to);

  const DynamicScene* scene_;
  double margin_;
  State state_;
  EdgeChecker edges_;
};

}  // namespace kinegraph
