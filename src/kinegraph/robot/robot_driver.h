#pragma once

#include <string>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/simulation/contact.h"

namespace kinegraph {

/// A gripper of a robot. Widths are those of the opening between its fingers.
struct GripperInfo {
  std::string name;
  double min_width = 0., max_width = .08;  ///< m
  double max_speed = .2;                   ///< m/s of the width
  double max_force = 70.;                  ///< N
};

/// What a robot is. Limits are of q, one number per joint, infinite where there is none.
struct RobotInfo {
  std::string name;
  std::vector<std::string> joints;  ///< one name per entry of q, as Config::getJointNames gives them
  VectorXd lower, upper;            ///< rad or m
  VectorXd velocity, acceleration;  ///< rad/s, rad/s^2, or with m
  VectorXd effort;                  ///< N m or N
  double rate = 100.;               ///< commands per second that it wants, Hz
  bool compliant = false;           ///< can it be less stiff than fully?
  std::vector<GripperInfo> grippers;

  /// The limits of a scene's joints, without any on accelerations.
  static RobotInfo of(const Config& config, std::string name);

  /// Throws ValueError, which names the field, if something does not fit the number of joints or makes no sense.
  void validate() const;
};

/// A gripper as it is.
struct GripperState {
  double width = 0.;    ///< m
  bool is_done = true;  ///< it has reached the width it was told, or something holds it up
};

/// A robot as it is.
struct RobotState {
  double time = 0.;          ///< of the robot's clock, s; it must go on
  VectorXd q, velocity;      ///< rad, rad/s, or with m
  VectorXd effort;           ///< of its motors, N m or N; empty if it does not measure it
  VectorXd external_effort;  ///< by what it touches; empty if it does not know
  std::vector<GripperState> grippers;
  std::string error;  ///< what the robot says is wrong; empty if nothing is
};

/// Where a robot shall be at the end of a period.
struct RobotCommand {
  double period = .01;    ///< s from now
  VectorXd q, velocity;   ///< at its end
  VectorXd acceleration;  ///< wanted at its end
  MatrixXd stiffness;     ///< n x n share of the robot's stiffness: identity is full, 0 is none. Empty: full
  double damping = 1.;    ///< share of the robot's damping where the stiffness is not full
  bool isStiff() const { return stiffness.size() == 0; }
};

/// What a gripper shall do.
struct GripperCommand {
  int gripper = 0;
  bool grasp = false;             ///< close until something is between the fingers, and hold it with `force`
  double width = 0., speed = .2;  ///< m, m/s; where to go, or how wide that is which is grasped
  double force = 20.;             ///< N, at most
  std::string object;             ///< the name of what is grasped, if that is known
};

/// A world that is simulated around a robot, besides the robot itself.
class SimulatedWorld {
 public:
  virtual ~SimulatedWorld() = default;

  /// Moves what moves to where it is, in a configuration with the same frames: q, grippers, things.
  virtual void updateConfig(Config& config) const = 0;

  /// The world as a configuration of its own, for pictures of it.
  virtual const Config& config() const = 0;

  /// Fixes a frame to another one where it is, or frees it again. Throws FrameNotFound.
  virtual void attach(const std::string& from, const std::string& to) = 0;
  virtual void detach(const std::string& from, const std::string& to) = 0;

  /// Puts a frame somewhere. Throws FrameNotFound.
  virtual void setFramePose(const std::string& frame, const Pose& pose) = 0;

  /// Takes up the frames of `config` that are not here yet. Returns their number.
  virtual int addObjects(const Config& config) = 0;

  /// What touches now. None in a world without forces.
  virtual std::vector<Contact> contacts() const { return {}; }
};

/// What stands between BotOp and a robot: a simulated one, or one that is there. Calls come from one thread at a time.
/// What it throws ends the motion: BotOp holds the robot and says why.
class RobotDriver {
 public:
  virtual ~RobotDriver() = default;

  /// What robot it is; the same at all times after `connect`.
  virtual RobotInfo info() = 0;
  virtual void connect() {}
  virtual void disconnect() {}

  virtual RobotState read() = 0;
  virtual void write(const RobotCommand& command) = 0;

  /// Called when something is wrong, instead of `write`, until `recover`: come to rest.
  virtual void stop(const std::string& reason) = 0;

  /// Clears errors, so that it can be moved again.
  virtual void recover() {}

  virtual void moveGripper(const GripperCommand& command);

  /// Simulated time goes on by `period`, s. A robot that is there does nothing: its time goes on by itself.
  virtual void step(double period) { (void)period; }

  /// The world of a simulated robot; null for a robot that is there.
  virtual SimulatedWorld* world() { return nullptr; }
};

/// A robot that cannot be moved: it reports an error, or a guard has stopped it.
class RobotFault : public Error {
 public:
  using Error::Error;
};

}  // namespace kinegraph
