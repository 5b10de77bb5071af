#pragma once

#include <cstdint>

#include "kinegraph/simulation/scene_model.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph::inline simulation_internal {

/// Reference trajectories of all servos: position, velocity and acceleration, in the units of the model's motions.
/// A value type: copies of it are part of a simulation's state.
///
/// A commanded position within reach of one step, by a change of velocity that motors can follow, is approached on a
/// cubic. Its final velocity is extrapolated from the last two commanded positions, so a stream of positions is
/// followed without jerks. A position farther away is approached with limited velocity and acceleration.
class Reference {
 public:
  struct Dof {
    double position = 0.;
    double velocity = 0.;      ///< of the last inner step
    double acceleration = 0.;  ///< for the next inner step
    double goal = 0.;
    double rate = 0.;                       ///< velocity at this position of the smooth curve
    double slope = 0.;                      ///< mean velocity over the last command
    double rotation[4] = {1., 0., 0., 0.};  ///< commanded orientation of a ball joint, (w, x, y, z)
    bool operator==(const Dof&) const = default;
  };

  /// The kind of motion towards the goal.
  enum class Path : std::int64_t { still, limited, constant_velocity, constant_acceleration, cubic };
  struct Course {
    Path path = Path::still;
    double start = 0., start_velocity = 0., end_velocity = 0.;
  };
  struct Clock {
    ControlMode mode = ControlMode::none;
    int last = 0;                   ///< 1 in the last inner step of the present command
    double tau = 0., elapsed = 0.;  ///< of the present command, s
  };

  /// Everything but the spline. The structs have no padding, because they are compared and stored as bytes.
  struct Parts {
    std::vector<Dof> dofs;
    std::vector<Course> courses;
    std::vector<double> next;
    VectorXd torque;
    Clock clock;
  };

  Reference() = default;

  /// Starts a command that lasts `tau` s. `u` has the finite numbers of the control vector of `mode`. If `exact`,
  /// commanded positions are reached at its end, however far away, at a constant velocity: without motors nothing
  /// limits it.
  void command(const SceneModel& model, const VectorXd& u, double tau, ControlMode mode,
               const SimulationOptions& options, bool exact);

  /// Computes the references at `time` + h, the end of an inner step; `last` marks the final one of the command.
  /// acceleration() then moves a motor from the present reference to the next one.
  void prepare(const SceneModel& model, double time, double h, bool last, const SimulationOptions& options);

  /// Bounds the lead of velocity and acceleration references over their joints by the lag of motors at their limit (.05
  /// rad or m): a blocked joint does not jump when it is released.
  void stayNear(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel);

  /// Finishes the inner step.
  void shift(double h);

  /// Sets all references to the present positions, with the velocity of the motion up to here.
  void holdAt(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel);

  double next(std::size_t servo) const { return parts_.next[servo]; }  ///< position at the end of the inner step
  const std::vector<Dof>& dofs() const { return parts_.dofs; }
  void setDof(std::size_t servo, const Dof& dof) { parts_.dofs[servo] = dof; }
  ControlMode mode() const { return parts_.clock.mode; }
  const VectorXd& torque() const { return parts_.torque; }  ///< per servo, for ControlMode::torque

  Parts parts() const { return parts_; }
  void setParts(Parts parts) { parts_ = std::move(parts); }

  BSpline spline;  ///< of q, over the time since spline_start
  double spline_start = 0.;

 private:
  void courseOf(std::size_t i, const Servo& servo, double goal, double tau, const SimulationOptions& options);
  static double limitedStep(const Dof& dof, const Servo& servo, double h, const SimulationOptions& options);
  double nextPosition(std::size_t i, const Servo& servo, double h, const SimulationOptions& options);
  void nextOfSpline(const SceneModel& model, double time);

  Parts parts_;
};

/// Returns the size of the control vector of a mode; 0 if the mode takes none.
int controlSize(ControlMode mode, int dofs);
const char* controlModeName(ControlMode mode);

}  // namespace kinegraph::inline simulation_internal
