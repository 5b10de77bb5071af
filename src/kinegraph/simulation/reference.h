#pragma once

#include <cstdint>

#include "kinegraph/simulation/scene_model.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

/// Where motors shall be: position, velocity and acceleration of every drive, in the units of the model's motions, and what
/// moves them on. A value: copies of it are part of a simulation's state.
///
/// A position that the reference can reach within the step by a change of velocity that motors can follow is approached on a
/// cubic, which has at its end the velocity that the last two positions tell, so that a stream of positions is followed without
/// jerks; one that is farther away is approached with limited velocity and acceleration.
class Reference {
 public:
  struct Dof {
    double position = 0.;
    double velocity = 0.;      ///< that brought it here, over the last inner step
    double acceleration = 0.;  ///< for the next one
    double goal = 0.;
    double rate = 0.;                   ///< velocity where it is, of the smooth curve that it follows
    double slope = 0.;                  ///< mean velocity over the last command
    double turn[4] = {1., 0., 0., 0.};  ///< of a ball: the orientation wanted
    bool operator==(const Dof&) const = default;
  };

  /// How a drive comes to where it shall be.
  enum class Path : std::int64_t { still, limited, given, accelerated, cubic };
  struct Course {
    Path path = Path::still;
    double start = 0., start_velocity = 0., end_velocity = 0.;
  };
  struct Clock {
    ControlMode mode = ControlMode::none;
    int last = 0;                   ///< 1 in the last inner step of the present command
    double tau = 0., elapsed = 0.;  ///< of the present command, s
  };

  /// All but the spline. Its structs have no padding: they are compared and stored as bytes.
  struct Parts {
    std::vector<Dof> dofs;
    std::vector<Course> courses;
    std::vector<double> next;
    VectorXd torque;
    Clock clock;
  };

  Reference() = default;

  /// A new command, for the time tau. `u` has the numbers that `mode` asks for; they are finite.
  void command(const SceneModel& model, const VectorXd& u, double tau, ControlMode mode,
               const SimulationOptions& options);

  /// Looks ahead from `time` by an inner step of length h, the `last` one of the command or not: acceleration() is then what
  /// brings a motor that is at the reference to the next one.
  void prepare(const SceneModel& model, double time, double h, bool last, const SimulationOptions& options);

  /// Where velocities or accelerations are told, the reference goes no farther ahead of its joint than motors at their limit
  /// need (.05 rad or m): what is blocked does not jump when it comes free.
  void stayNear(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel);

  /// The inner step is done.
  void shift(double h);

  /// Everything shall be where it is; its velocity is that of what brought it there.
  void hold(const SceneModel& model, const mjtNum* qpos, const mjtNum* qvel);

  double next(std::size_t servo) const { return parts_.next[servo]; }  ///< position at the end of the inner step
  const std::vector<Dof>& dofs() const { return parts_.dofs; }
  void setDof(std::size_t servo, const Dof& dof) { parts_.dofs[servo] = dof; }
  ControlMode mode() const { return parts_.clock.mode; }
  const VectorXd& torque() const { return parts_.torque; }  ///< per drive, of ControlMode::torque

  Parts parts() const { return parts_; }
  void setParts(Parts parts) { parts_ = std::move(parts); }

  BSpline spline;  ///< of q; in time from spline_start
  double spline_start = 0.;

 private:
  void courseOf(std::size_t i, const Servo& servo, double goal, double tau, const SimulationOptions& options);
  static double limitedStep(const Dof& dof, const Servo& servo, double h, const SimulationOptions& options);
  double nextPosition(std::size_t i, const Servo& servo, double h, const SimulationOptions& options);
  void nextOfSpline(const SceneModel& model, double time);

  Parts parts_;
};

/// Numbers that a control vector of a mode has: 0 where there is none.
int controlSize(ControlMode mode, int dofs);
const char* controlModeName(ControlMode mode);

}  // namespace kinegraph
