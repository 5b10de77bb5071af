#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/cancellation.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/planning/motion_plan.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/tool_paths/tool_path.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline trajectories_internal {
struct ScalingState;
}

namespace kinegraph {

/// A curve y(s) of cubic pieces. Smooth sections follow each other; between two sections the direction may jump, at a
/// *corner*.
struct CubicPieces {
  std::vector<double> begin;          ///< (m,): s at the start of each piece, ascending
  std::vector<MatrixXd> coefficient;  ///< per piece (d, 4): of 1, (s - begin), (s - begin)^2, (s - begin)^3
  std::vector<char> is_corner;        ///< per piece: a corner is at its start
  double length = 0.;                 ///< s at the end

  int pieces() const { return int(begin.size()); }
  double end(int piece) const { return piece + 1 < pieces() ? begin[std::size_t(piece) + 1] : length; }

  /// The piece at s; at a knot, the later one.
  int pieceAt(double s) const;

  /// y, or a derivative of it, at s by the polynomial of a piece.
  VectorXd eval(int piece, double s, int order = 0) const;
  VectorXd eval(double s, int order = 0) const { return eval(pieceAt(s), s, order); }

  /// The least and the largest value of each row of y on a piece.
  struct Range {
    VectorXd least, largest;  ///< (d,)
  };
  Range range(int piece) const;

  /// Appends a smooth section: the cubic spline with continuous second derivatives and not-a-knot ends through the
  /// columns of y (d, K) at s (K,). Three columns give a parabola, two a line. `corner`: one is at its start.
  void addSpline(const std::vector<double>& s, const MatrixXd& y, bool corner);

  /// Appends Hermite pieces, with derivatives (d, K).
  void addHermite(const std::vector<double>& s, const MatrixXd& y, const MatrixXd& slope, bool corner);

 private:
  void addPiece(double from, double to, const MatrixXd& coefficients, bool is_corner);
};

/// Where transfers end with the speed of what follows, and not at rest, if that takes less time.
enum class TransferFlow {
  none,      ///< nowhere: all approaches and paths start at rest
  approach,  ///< at approaches; a path without one starts at rest
  path,      ///< also at paths without an approach
};

/// Returns the value of "none", "approach" or "path"; throws ValueError for another name.
TransferFlow transferFlowOfName(const std::string& name);

/// Settings of planToolPath.
struct ToolPathOptions {
  double speed = .1;                 ///< of the tool where the path has no speed of its own, m/s
  double tool_acceleration = 2.;     ///< along the path, m/s^2
  double tool_jerk = 40.;            ///< along the path, m/s^3; counts if `jerk` is given
  double approach = 0.;              ///< length of a straight approach along the tool's axis before each path, m,
                                     ///< on the side of the tool's own link, or away from the origin of the
                                     ///< part if no joint moves the tool
  double retract = 0.;               ///< length of a straight retract after each path, m
  double tolerance = 2e-5;           ///< largest distance of the tool from the curve, m, >= 1e-6
  double rotation_tolerance = 8e-5;  ///< largest rotation of the tool or its axis, rad, >= 4e-6
  double margin = 0.;                ///< distance that all pairs keep, m
  bool free_order = false;           ///< paths may be done in any order and from either end
  TransferFlow flow = TransferFlow::approach;  ///< where transfers end with the speed of what follows
  VectorXd velocity = {};                      ///< limits of |dq/dt|, per dof or one for all; empty: the model's
  VectorXd acceleration = {};                  ///< limits of |d2q/dt2|; empty: full speed within a quarter of a second
  VectorXd jerk = {};                          ///< limits of |d3q/dt3|; empty: none
  std::vector<std::string> touching = {};      ///< frames that the tool's link may touch
  std::optional<VectorXd> start = {};          ///< configuration at the start of the first path; none: the best one
  std::optional<VectorXd> transfer_from = {};  ///< where the robot is; adds a transfer from there; none: no transfer
  double time_limit = std::numeric_limits<double>::infinity();  ///< s, of the search
  std::uint64_t seed = 0;

  void validate(int dofs) const;  ///< throws ValueError that names the first invalid field
};
/// How planToolPath ended, and why there is no motion.
enum class ToolPathStatus {
  solved,
  out_of_reach,  ///< no configuration reaches a place of a path
  in_collision,  ///< configurations reach it, but pairs closer than the margin end every motion
  no_branch,     ///< no configuration continues the motion: joint limits or a singularity end it
  too_fast,      ///< there is no timing
  no_transfer,   ///< no motion leads to a path
  out_of_time,   ///< the time limit ended the search
};

std::string toolPathStatusName(ToolPathStatus status);

/// A part of the motion.
struct ToolSegment {
  enum class Kind { transfer, approach, path, retract };
  Kind kind = Kind::path;
  int path = 0;               ///< index of the path; of a transfer: the path that it leads to
  bool reversed = false;      ///< the path is done from its end to its start
  double from = 0., to = 0.;  ///< times, s
};

std::string toolSegmentName(ToolSegment::Kind kind);

/// A stretch on which the tool is slower than asked.
struct SlowStretch {
  int path = 0;
  double from = 0., to = 0.;  ///< places, m from the start of the path in the direction of motion
  double speed = 0.;          ///< the least, m/s
  std::string cause;          ///< "velocity of 'wrist_2'", "acceleration of the tool", ...
};

/// A place on a path, m from its start in the direction of motion; negative on the approach.
struct ToolPlace {
  int path = -1;
  double place = 0.;
};

/// The motion that planToolPath found, or the reason why there is none. Without a motion, eval throws ValueError.
class ToolPathPlan final : public Trajectory {
 public:
  ToolPathStatus status = ToolPathStatus::out_of_time;
  std::string message;                ///< "" if solved, else path, place, and cause
  std::vector<std::string> warnings;  ///< such as blends that were made smaller
  ToolPlace where;                    ///< of the failure; path -1 if solved
  std::vector<std::string> frames;    ///< the pair in collision at the failure, or none
  std::string joint;                  ///< the joint whose limit ends the motion, or ""
  MatrixXd reached;                   ///< (K, n): without a motion, configurations up to the place of the failure
  std::vector<ToolSegment> segments;  ///< in the order of time
  std::vector<SlowStretch> slow;
  double position_deviation = 0.;  ///< proven at all times, m
  double rotation_deviation = 0.;  ///< proven at all times, rad; beyond the cone if there is one

  bool feasible() const { return status == ToolPathStatus::solved; }
  int dimension() const override { return dofs_; }
  double duration() const override { return duration_; }
  void evalTo(double t, double* q, double* velocity, double* acceleration) const override;

  /// The path that is being done at time t (s), and the place on it; path -1 on a transfer.
  ToolPlace way(double t) const;

  /// Speed of the tool relative to its path at time t (s), m/s; 0 on a transfer.
  double speed(double t) const;

  /// Shows the paths on the page of `config` (C.viewer()): the asked curves, the way of the tool colored by its
  /// speed, axes, cones, and the place of a failure with its cause; then plays the motion, or the configurations up to
  /// the failure. `paths` are those of the call. Waits for a key with `pause`. Returns the key, or 0.
  int view(const Config& config, const std::vector<ToolPath>& paths, bool pause = false) const;

  std::string str() const;  ///< "solved: 3 paths in 12.3 s", or the status and the message

  /// A timed part: a path with approach and retract, or a transfer.
  struct Part {
    double begin = 0.;  ///< time of its start, s
    int path = 0;
    double offset = 0.;  ///< s of the curve at which the path proper starts
    bool is_transfer = false;
    TimedPath timed;  ///< with one more dof, the tool's way, unless it is a transfer
  };

  /// Builds a plan from its parts; times of segments and the duration follow from them.
  void setParts(std::vector<Part> parts, int dofs);
  const std::vector<Part>& parts() const { return parts_; }

 private:
  const Part& partAt(double t) const;

  std::vector<Part> parts_;
  int dofs_ = 0;
  double duration_ = 0.;
};

/// Plans the motion of a robot whose tool follows paths.
///
///     ToolPath seam = ToolPath::along("pen", points, normals).tilt(.2);
///     ToolPathPlan plan = planToolPath(C, {seam}, {.speed = .05});
///     if (plan.feasible()) bot.follow(plan);
///
/// The branch of the inverse kinematics, and the angles that a path leaves free, come from a search: all solutions at
/// the start of a path are followed along it, and a graph of their configurations is searched if none gets to the end
/// without collision. The deviation of the tool from its curve is proven for all times (jointCurveAlong), and so is
/// freedom of collisions with the margin. The tool moves at `speed` where the limits of the joints allow it, and as
/// fast as they allow elsewhere; `slow` lists where. Paths are connected by planMotion, and transfers flow into
/// approaches (options.flow).
///
/// The Config is not changed. Equal arguments give equal bits, unless the time limit ends the search. `progress` counts
/// each path twice, when it has been searched and when it has been timed. Throws ValueError for invalid arguments, and
/// FrameNotFound.
ToolPathPlan planToolPath(const Config& config, const std::vector<ToolPath>& paths, const ToolPathOptions& options = {},
                          const CancellationToken& cancellation = {}, const ProgressCallback& progress = {});

/// A place at which a curve is not collision-free.
struct CurveContact {
  double place = 0.;  ///< s, to within the part of a piece that was checked
  MotionContact contact;
};

/// Finds the first place at which a curve of configurations is not provably free: all pairs keep the checker's margin
/// continuously along chords, by as much more as the curve may deviate from them. Parts that are not free are divided,
/// up to `max_divisions` times. None if the whole curve is free.
std::optional<CurveContact> firstContactAlong(EdgeChecker& checker, const CubicPieces& curve, int max_divisions = 6);

/// The first contact of a motion.
struct MotionTouch {
  double t = 0.;         ///< s
  std::string a, b;      ///< frames
  double distance = 0.;  ///< m; negative: they overlap
};

/// Finds the first time at which a timed path is not provably free: all pairs keep `margin` (m) at all times, not only
/// at samples. None if the whole motion is free. Throws ValueError if there is no motion, for another number of dofs,
/// and for a margin below 0.
std::optional<MotionTouch> firstContact(const Config& config, const TimedPath& motion, double margin = 0.);

/// The same for all parts of a plan. Frames of its `touching` touch here, too, unless the scene excludes the pairs.
std::optional<MotionTouch> firstContact(const Config& config, const ToolPathPlan& plan, double margin = 0.);

/// The limit that is the nearest one at a time of a motion.
struct NearestLimit {
  enum class Kind { velocity, acceleration, jerk };
  double share = 0.;  ///< of the limit; 1: it is reached
  Kind kind = Kind::acceleration;
  int dof = -1;  ///< -1: nothing moves
};

std::string nearestLimitName(NearestLimit::Kind kind);  ///< "velocity", "acceleration" or "jerk"

/// Returns the limit of which a motion uses the largest share at a state of its time scaling, or at time t (s, clamped
/// to the duration): the reason why it is not faster there. Throws ValueError if there is no motion, for limits of
/// another size, and if t is NaN.
NearestLimit nearestLimit(const PathCurve& curve, int piece, const ScalingState& state, const MotionLimits& limits);
NearestLimit nearestLimit(const TimedPath& motion, double t, const MotionLimits& limits);

}  // namespace kinegraph
