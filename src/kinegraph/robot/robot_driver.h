#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/simulation/simulation_data.h"

namespace kinegraph {

/// A gripper of a robot. Widths are of the opening between its fingers.
struct GripperInfo {
  std::string name;
  double min_width = 0., max_width = .08;  ///< smallest and largest width, m
  double max_speed = .2;                   ///< largest speed of the width, m/s
  double max_force = 70.;                  ///< largest force, N
};

/// Name, joints, limits and grippers of a robot. Limits are per joint, infinite if there is none.
struct RobotInfo {
  std::string name;
  std::vector<std::string> joints;  ///< one name per entry of q, as Config::getJointNames gives them
  VectorXd lower, upper;            ///< limits of position, rad or m
  VectorXd velocity, acceleration;  ///< largest values, rad/s and rad/s^2, or with m
  VectorXd effort;                  ///< largest torques and forces, N m or N
  double rate = 100.;               ///< preferred rate of commands, Hz
  bool compliant = false;           ///< supports a reduced stiffness
  std::vector<GripperInfo> grippers;

  /// Returns the limits of a scene's joints; accelerations are not limited.
  static RobotInfo of(const Config& config, std::string name);

  /// Throws ValueError for the first field with a wrong size or value.
  void validate() const;
};

/// The state of a gripper.
struct GripperState {
  double width = 0.;    ///< distance between the fingers, m
  bool is_done = true;  ///< it has reached its target width, or an object stops it
};

/// The state of a robot.
struct RobotState {
  double time = 0.;          ///< time of the robot's clock, s; it must increase
  VectorXd q, velocity;      ///< state of the joints, rad and rad/s, or with m
  VectorXd effort;           ///< torques and forces of the motors, N m or N; empty if they are not measured
  VectorXd external_effort;  ///< torques and forces by contacts, N m or N; empty if they are not measured
  std::vector<GripperState> grippers;
  std::string error;  ///< reported by the robot; empty without one
};

/// The target of a robot at the end of a control period.
struct RobotCommand {
  double period = .01;    ///< length of the control period, s
  VectorXd q, velocity;   ///< setpoints at the end of the period, rad and rad/s, or with m
  VectorXd acceleration;  ///< that of the reference there, rad/s^2 or m/s^2
  MatrixXd stiffness;     ///< n x n factor on the robot's stiffness; identity is full, 0 is none. Empty: full
  double damping = 1.;    ///< factor on the robot's damping, if the stiffness is not full
  bool isStiff() const { return stiffness.size() == 0; }
};

/// A command to a gripper.
struct GripperCommand {
  int gripper = 0;
  bool grasp = false;             ///< close until an object stops the fingers, and hold it with `force`
  double width = 0., speed = .2;  ///< m, m/s; target width, or the width of the grasped object
  double force = 20.;             ///< largest force, N
  std::string object;             ///< frame of the grasped object, if it is known
};

/// The simulated world around a robot.
class SimulatedWorld {
 public:
  virtual ~SimulatedWorld() = default;

  /// Sets q, grippers and free objects of `config`, which has frames of the same names, to the state of the world.
  virtual void updateConfig(Config& config) const = 0;

  /// The world as a configuration, for images.
  virtual const Config& config() const = 0;

  /// Attaches a frame to another one at its present pose, or detaches it. Throws FrameNotFound.
  virtual void attach(const std::string& from, const std::string& to) = 0;
  virtual void detach(const std::string& from, const std::string& to) = 0;

  /// Sets the pose of a frame. Throws FrameNotFound.
  virtual void setFramePose(const std::string& frame, const Pose& pose) = 0;

  /// Copies the frames of `config` whose names are new. Returns their number.
  virtual int addObjects(const Config& config) = 0;

  /// Returns the present contacts; none in a world without forces.
  virtual std::vector<Contact> contacts() const { return {}; }
};

/// The control mode of a robot.
enum class LoopMode : int {
  follow,    ///< follows its reference motion, and rests at the end
  hold,      ///< rests
  floating,  ///< has no stiffness
  fault,     ///< was stopped by a safety limit or by an error of the robot
};

/// Limits that stop a robot, or keep a motion from starting.
struct SafetyLimits {
  double start_distance = .05;    ///< rad or m: a motion starts at most this far from the robot, per joint
  double tracking_distance = .3;  ///< rad or m: a stiff joint that is farther from its command is a fault
  double clock_timeout = .1;      ///< s: a robot's clock that stands still for longer is a fault
  bool lag_stops = true;          ///< false: a joint that is far from its command is a warning only
};

/// The interface of BotOp to a simulated or real robot. Calls come from one thread at a time. An exception of a driver
/// puts the robot in fault, and BotOp reports its message.
class RobotDriver {
 public:
  virtual ~RobotDriver() = default;

  /// Describes the robot; constant after `connect`.
  virtual RobotInfo info() = 0;
  virtual void connect() {}
  virtual void disconnect() {}

  virtual RobotState read() = 0;
  virtual void write(const RobotCommand& command) = 0;

  /// Brings the robot to rest after a fault. `write` is not called again until `recover`.
  virtual void stop(const std::string& reason) = 0;

  /// Clears errors, so that the robot can move again.
  virtual void recover() {}

  virtual void moveGripper(const GripperCommand& command);

  /// Advances a simulation by `period` (s). Drivers of real robots do nothing.
  virtual void step(double period) { (void)period; }

  /// The world of a simulated robot; null for a real robot.
  virtual SimulatedWorld* world() { return nullptr; }
};

/// A robot that cannot move: it reports an error, or a safety limit has stopped it.
class RobotFault : public Error {
 public:
  using Error::Error;
};

}  // namespace kinegraph
