#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Where a frame is to be, in world coordinates. Several targets may name the same frame.
struct IkTarget {
  enum class Kind {
    pose,       ///< position and rotation
    position,   ///< of the origin, m
    rotation,   ///< the position is free
    direction,  ///< an axis of the frame points along a direction; rotation about it is free
  };
  std::string frame;
  Kind kind = Kind::pose;
  Pose pose;                          ///< of pose, position, rotation
  Vector3d axis = Vector3d::UnitZ();  ///< of direction: in the frame's coordinates
  Vector3d direction = Vector3d::UnitZ();

  static IkTarget toPose(std::string frame, const Pose& X_WF) { return {std::move(frame), Kind::pose, X_WF}; }
  static IkTarget toPosition(std::string frame, const Vector3d& p_WF) {
    return {std::move(frame), Kind::position, Pose(p_WF, Quaterniond::Identity())};
  }
  static IkTarget toRotation(std::string frame, const Quaterniond& R_WF) {
    return {std::move(frame), Kind::rotation, Pose(Vector3d::Zero(), R_WF)};
  }
  static IkTarget toDirection(std::string frame, const Vector3d& axis, const Vector3d& direction) {
    return {std::move(frame), Kind::direction, Pose(), axis, direction};
  }
};

struct IkOptions {
  double position_tolerance = 1e-6;  ///< m, of every target
  double rotation_tolerance = 1e-6;  ///< rad, of every target
  int attempts = 100;                ///< at most; the first starts at the Config's q, the others within the limits
  int steps = 25;                    ///< of an attempt towards its targets, and again out of collisions
  bool best = false;         ///< all attempts are made and the nearest answer is given, instead of the first one
  bool collisions = true;    ///< keeps the Config's collidable pairs apart
  double margin = 0.;        ///< least distance of these pairs, m
  double start_weight = 0.;  ///< of |q - start|^2 in what "nearest" means; 1 where `best` and both are 0
  double home_weight = 0.;   ///< of |q - home|^2
  std::uint64_t seed = 0;    ///< shifts the sequence of starting points

  void validate() const;  ///< throws ValueError
};

enum class IkStatus {
  solved,     ///< all targets within tolerance, no pair nearer than the margin
  unreached,  ///< in no attempt; the nearest one misses a target
  colliding,  ///< in no attempt; the nearest one meets its targets with pairs nearer than the margin
  cancelled,  ///< before there was an answer
};

std::string ikStatusName(IkStatus status);

struct IkResult {
  VectorXd q;  ///< (n,), within the limits: the answer, or the attempt that missed least
  IkStatus status = IkStatus::cancelled;
  double position_error = 0.;  ///< of the worst target, m
  double rotation_error = 0.;  ///< of the worst target, rad
  double penetration = 0.;     ///< by which the worst pair is nearer than the margin, m
  int attempts = 0;            ///< starting points used
  int evals = 0;               ///< forward kinematics with Jacobian
  std::string message;         ///< "" if solved, else what misses what by how much, and what is in the way

  bool feasible() const { return status == IkStatus::solved; }
  std::string str() const;  ///< "solved in 2 attempts, within 1e-8 m and 3e-9 rad", or the status and the message
};

/// Called now and then by the calling thread, with the number of problems that are done; true ends the search, which
/// then gives the best answers so far. It may throw.
using IkWatch = std::function<bool(int done)>;

/// Joint values within their limits that bring frames to their targets, without collisions.
///
/// Damped Gauss-Newton steps on positions and rotation vectors from many starting points: the Config's q, then an
/// additive (Kronecker) low-discrepancy sequence. An attempt that reaches its targets in collision goes on with the
/// distances as further rows. Joints that move none of the target frames stay where they are. The pairs that count
/// are those that joints move apart; where one that only such joints move is too near, no answer is `solved`. The Config is not changed; the same arguments give the same bits. Throws
/// FrameNotFound, and ValueError for targets that no active joint moves. Source: Buss, Introduction to inverse
/// kinematics with Jacobian transpose, pseudoinverse and damped least squares, 2004.
IkResult solveIk(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {},
                 const IkWatch& watch = {});

/// One problem per entry of `problems`. All have the frames and kinds of the first one's targets; else ValueError.
/// Every result is the one that `solveIk` would give, whatever the number of threads.
std::vector<IkResult> solveIkBatch(const Config& config, const std::vector<std::vector<IkTarget>>& problems,
                                   const IkOptions& options = {}, int threads = 1, const IkWatch& watch = {});

struct IkProblem;

/// The same in two parts: what can be computed before the targets' numbers are known, and the search. It keeps what it
/// needs of the Config as it was, so that `solve` may run while the Config changes.
class IkSolver {
 public:
  /// Of the targets, the frames, kinds and axes matter here.
  IkSolver(const Config& config, const std::vector<IkTarget>& targets, const IkOptions& options = {});

  std::vector<IkResult> solve(const std::vector<std::vector<IkTarget>>& problems, int threads = 1,
                              const IkWatch& watch = {}) const;

 private:
  std::shared_ptr<const IkProblem> problem_;
};

}  // namespace kinegraph
