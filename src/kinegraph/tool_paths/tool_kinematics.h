#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/tool_paths/tool_curve.h"

namespace kinegraph::inline tool_paths_internal {

/// Error of a tool in the coordinates of the path's reference frame: tool minus target.
struct ToolMiss {
  Vector3d p, x, z;  ///< of the origin (m) and of the x and z axes
};

/// Rows of a tool's task that hold exactly.
enum class ToolRows {
  pose,      ///< position and rotation
  axis,      ///< position and the direction of the free axis
  position,  ///< position, while the axis stays in its cone
};

/// The kinematics of the tool of a path: errors, derivatives, and projections onto targets. One per thread.
class ToolKinematics {
 public:
  /// Throws FrameNotFound; ValueError if no joint moves the tool relative to the reference frame, and for joints with
  /// quaternions between them.
  ToolKinematics(const Config& config, const ToolPath& path);

  int dofs() const { return state_.dofs(); }
  int freeAxis() const { return free_axis_; }
  double cone() const { return cone_; }
  bool hasRange() const { return half_range_ > 0.; }                  ///< of the rotation about the free axis
  const std::optional<double>& preferred() const { return prefer_; }  ///< rotation about the free axis, rad
  const std::vector<char>& moving() const { return moving_; }         ///< per dof: moves the tool
  int movingDofs() const;
  const KinematicModel& model() const { return state_.model(); }
  const State& state() const { return state_; }

  /// The rows that follow from the freedom of the path.
  ToolRows rows() const { return free_axis_ < 0 ? ToolRows::pose : cone_ > 0. ? ToolRows::position : ToolRows::axis; }

  /// The pose of the tool in the reference frame.
  RigidTransform pose(const VectorXd& q);
  ToolMiss miss(const VectorXd& q, const ToolTarget& target);

  /// Speed of the tool in the reference frame, m per unit, for dq per unit.
  Vector3d velocity(const VectorXd& q, const VectorXd& dq);

  /// Angle between the free axis and its target, rad.
  double lean(const VectorXd& q, const ToolTarget& target);

  /// Rotation of the tool about its free axis from the target, after the least rotation that aligns the axes, rad.
  double twist(const RigidTransform& X, const ToolTarget& target) const;

  /// Distance of a twist from the middle of its range minus half of the range, rad: positive outside.
  double beyondRange(double twist) const;

  /// Bounds |d twist / ds| for dq/ds of at most `rates` (n,) and a target that rotates by at most `target_rate` (rad
  /// per s), if the axis leans by at most `lean` rad.
  double twistRate(const VectorXd& rates, double target_rate, double lean) const;

  /// The side of the tool's origin on which there is no work, along the free axis or z: 1, or -1 against the axis. Axes
  /// point into the work or out of it. It is the side of the tool's link, or, for a tool that no joint moves, the one
  /// away from the origin of the path's coordinates, the part, at the path's start.
  double side(const Pose& start) const;

  struct Projection {
    bool met = false;
    double error = 0.;  ///< largest row, m or rad
    int blocked = -1;   ///< a dof that is held at its limit, or -1
  };

  /// Moves q to the nearest configuration that meets the rows, by damped Newton steps (at most `steps`) with dofs
  /// without whole turns held at their limits. `pull` (n,) is a change of q that the free directions follow; empty for
  /// none. `share` of the cone is allowed.
  Projection project(VectorXd& q, const ToolTarget& target, ToolRows rows, int steps, const VectorXd& pull = {},
                     double share = .93);

  /// Dofs whose limits are at least a whole turn apart, or without limits: they count modulo their turns.
  bool isWide(int dof) const { return wide_[std::size_t(dof)] != 0; }
  bool hasLimits(int dof) const { return std::isfinite(model().lower[dof]) && std::isfinite(model().upper[dof]); }

  /// to - from, modulo turns of wide dofs.
  VectorXd difference(const VectorXd& from, const VectorXd& to) const;

  /// A part of a pull towards the preferred rotation about the free axis; zero without one.
  VectorXd preferring(const VectorXd& q, const ToolTarget& target, double gain);

  /// A part of a pull towards the middle of the limits that are no whole turn apart.
  VectorXd centering(const VectorXd& q, double gain) const;

  /// Bounds the Taylor coefficient 5 of the tool's position (m) and of its axes. The dofs have Taylor coefficients 1, 2
  /// and 3 of at most `coefficients` (n, 3) at all places, and |q| <= largest (n,).
  struct Remainder {
    double position, direction;
  };
  Remainder fifthCoefficient(const MatrixXd& coefficients, const VectorXd& largest) const;

 private:
  struct ChainStep {
    int dof;
    double scale, offset;  ///< of the dof; distance from the joint before, m
    bool rotates;
    bool of_reference;
  };
  void listChain(int link, int until, bool of_reference);

  State state_;
  int tool_, reference_;  ///< frames; reference -1: the world
  int free_axis_;
  double cone_;
  double middle_ = 0., half_range_ = 0.;  ///< of the rotation about the free axis; 0: the whole turn
  std::optional<double> prefer_;
  std::vector<char> moving_, wide_;
  std::vector<ChainStep> chain_;  ///< of the reference first, then of the tool from its base
  double tool_offset_ = 0.;
  Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor> J_, J_reference_;
};

}  // namespace kinegraph::inline tool_paths_internal
