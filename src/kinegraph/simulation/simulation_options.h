#pragma once

#include "kinegraph/common/option_table.h"

namespace kinegraph {

/// What steps a simulation. The numbers are those of the Python enum `ry.SimulationEngine`.
enum class SimulationEngine : int {
  physx = 1,      ///< rigid bodies with contacts: our dynamic engine, MuJoCo, under the name that scripts know
  bullet = 2,     ///< refused
  kinematic = 3,  ///< joints follow their references exactly, nothing else moves
};

/// How the control vector of a step is meant. The numbers are those of the Python enum `ry.ControlMode`.
enum class ControlMode : int {
  none = 0,              ///< no vector: the motors keep their present targets
  position = 1,          ///< q at the end of the step
  velocity = 2,          ///< dq/dt
  acceleration = 3,      ///< of the reference, whose velocity is kept between the calls
  positionVelocity = 4,  ///< q and dq/dt at the end of the step, 2n numbers
  spline = 5,            ///< no vector: the spline that setSplineRef gave
  torque = 6,            ///< N m (N) at the joints, beside the compensation of gravity where a robot has it
};

/// Settings of a simulation. The defaults hold what is grasped.
struct SimulationOptions {
  double inner_step = .002;             ///< s; a step is made of equal ones that are not longer
  double servo_frequency = 100.;        ///< rad/s: how stiff joints follow; times inner_step at most .5
  double reference_acceleration = 20.;  ///< rad/s^2 or m/s^2: how fast references of far targets move
  double friction = 1.;                 ///< of frames without the attribute `friction`
  double torsional_friction = .005;     ///< m: against spinning on the spot
  double rolling_friction = 1e-4;       ///< m
  double gravity = 9.81;                ///< m/s^2, along -z
  double armature = .1;                 ///< kg m^2 or kg: inertia of motors, added to that of driven joints
  bool ground = true;                   ///< a plane at z = 0
  bool speculative = false;             ///< contacts before they happen: stops what would fly through thin walls
  bool sleep = false;                   ///< what rests costs nothing; states then replay in the same object only

  /// Throws ValueError, which names the first field that makes no sense.
  void validate() const;
  bool operator==(const SimulationOptions&) const = default;
};

/// The table of these options: names, units, sentences, ranges.
const OptionTable<SimulationOptions>& simulationOptionTable();

}  // namespace kinegraph
