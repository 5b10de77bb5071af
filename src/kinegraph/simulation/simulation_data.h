#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/option_table.h"
#include "kinegraph/math/pose.h"

namespace kinegraph {

/// A contact point between two frames.
struct Contact {
  std::string frame_a, frame_b;  ///< "ground" for the plane at z = 0
  Vector3d position;             ///< place of the contact in the world, m
  Vector3d normal;               ///< unit, from a to b
  double distance;               ///< distance of the shapes, m; negative if the shapes overlap
  Vector3d force;                ///< exerted by a on b, world, N
};

/// The state of a simulation. Fields may be changed before it is restored.
struct SimulationState {
  double time = 0.;       ///< simulated time, s
  VectorXd q, qDot;       ///< positions and velocities of the active joints, (n,) each
  MatrixXd freePos;       ///< F x 7, world poses of the free frames: x y z qw qx qy qz
  MatrixXd freeVel;       ///< F x 6, linear (m/s) and angular (rad/s) velocities, world
  std::string remainder;  ///< everything else that affects later steps, as bytes

  bool operator==(const SimulationState&) const = default;
};

class Simulation;

/// A step would diverge: positions, velocities or accelerations become infinite or huge.
class DivergenceError : public Error {
 public:
  using Error::Error;
};

/// Observes the steps of a simulation, and may delay them or change the simulation in between.
struct SimulationObserver {
  virtual ~SimulationObserver() = default;

  /// Called before each step. Returns false to delay it: the caller then calls `rest` and asks again.
  virtual bool mayStep(Simulation& simulation) = 0;

  /// Waits for at most 20 ms. May throw to prevent the step.
  virtual void rest() = 0;

  /// Called if a step of `tau` s would diverge, at the state before it. Returns true if it set the state after the step
  /// itself, or false for the error.
  virtual bool replaceStep(Simulation& simulation, double tau) = 0;

  /// Called after each step, when the Config is up to date.
  virtual void afterStep(Simulation& simulation) = 0;
};

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
  double friction = 1.;                 ///< friction coefficient of frames without the attribute `friction`
  double torsional_friction = .005;     ///< m: against spinning on the spot
  double rolling_friction = 1e-4;       ///< m: against rolling
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

class Config;
class Simulation;

/// A recorded run of a simulation: the scene, the start state, all calls, and the poses after each step. With the same
/// version of the library on the same kind of machine, `replay` repeats it bit for bit.
struct Recording {
  /// A call of the simulation, with its arguments as numbers and names.
  struct Call {
    enum class Kind : int {
      step,
      gripper,
      attach,
      detach,
      spline,
      reset_spline,
      reset_time,
      set_state,
      apply_force,
      clear_forces,
      perturb,
      end_perturbation
    };
    Kind kind = Kind::step;
    std::vector<double> numbers;
    std::vector<std::string> names;
  };

  std::string scene;  ///< as written by sceneToBytes
  SimulationEngine engine = SimulationEngine::physx;
  SimulationOptions options;
  SimulationState start, end;
  std::vector<Call> calls;

  std::vector<double> times;      ///< simulated times, s, after each step
  std::vector<VectorXd> q;        ///< joint states at these times
  std::vector<MatrixXd> freePos;  ///< world poses of the free frames, F x 7
  std::vector<VectorXd>
      motions;          ///< positions of the engine: all joints, including grippers and followers, and free bodies
  bool is_cut = false;  ///< a change of the scene's structure ended the recording

  std::string toBytes() const;
  static Recording fromBytes(const std::string& bytes);  ///< throws ValueError
  void save(const std::string& path) const;              ///< throws FileError
  static Recording load(const std::string& path);        ///< throws FileError and ValueError

  /// Returns the scene at the start of the run.
  Config makeConfig() const;

  /// Computes the world poses of all frames (by id) after the given steps. Throws ValueError for unknown steps.
  std::vector<std::vector<Pose>> framePoses(const std::vector<std::size_t>& steps) const;

  /// Writes an HTML page that plays the run, with a time slider. `client`: see ConfigViewer::saveHtml. Throws
  /// FileError.
  void saveHtml(const std::string& path, const std::string& client = "") const;

  /// Repeats the run on `config`, which makeConfig made. Throws Error if the final state differs from the recorded one.
  Simulation replay(Config& config) const;
};

}  // namespace kinegraph
