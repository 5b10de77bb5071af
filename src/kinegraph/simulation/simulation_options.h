#pragma once

#include "kinegraph/common/option_table.h"

namespace kinegraph {

/// The engine of a simulation. The numbers are those of the Python enum `ry.SimulationEngine`.
enum class SimulationEngine : int {
  physx = 1,      ///< rigid bodies with contacts: MuJoCo, under the name that scripts of the reference use
  bullet = 2,     ///< refused
  kinematic = 3,  ///< joints follow their references exactly; nothing else moves
};

/// The meaning of a step's control vector. The numbers are those of the Python enum `ry.ControlMode`.
enum class ControlMode : int {
  none = 0,              ///< no vector: motors keep their targets
  position = 1,          ///< q at the end of the step
  velocity = 2,          ///< dq/dt
  acceleration = 3,      ///< of the reference; its velocity persists between calls
  positionVelocity = 4,  ///< q and dq/dt at the end of the step, 2n numbers
  spline = 5,            ///< no vector: the spline of setSplineRef
  torque = 6,            ///< at the joints, N m (N), added to gravity compensation if the robot has it
};

/// Settings of a simulation. Grasped objects stay in the hand with the defaults.
struct SimulationOptions {
  double inner_step = .002;             ///< s; a step consists of equal inner steps of at most this duration
  double servo_frequency = 100.;        ///< rad/s: stiffness of joints; times inner_step at most .5
  double reference_acceleration = 20.;  ///< rad/s^2 or m/s^2: acceleration of references towards distant targets
  double friction = 1.;                 ///< of frames without the attribute `friction`
  double torsional_friction = .005;     ///< m: against spinning on the spot
  double rolling_friction = 1e-4;       ///< m
  double gravity = 9.81;                ///< m/s^2, along -z
  double armature = .1;                 ///< kg m^2 or kg: inertia of motors, added to actuated joints
  bool ground = true;                   ///< a plane at z = 0
  bool speculative = false;             ///< predicts contacts, which keeps fast objects from passing through thin walls
  bool sleep = true;                    ///< free bodies at rest are not computed until something moves them

  /// Throws ValueError with the name of the first invalid field.
  void validate() const;
  bool operator==(const SimulationOptions&) const = default;
};

/// Returns the table of these options: names, units, descriptions, ranges.
const OptionTable<SimulationOptions>& simulationOptionTable();

}  // namespace kinegraph
