#pragma once

#include <memory>

#include "kinegraph/robot/command_log.h"
#include "kinegraph/robot/motion_limits.h"

namespace kinegraph {

/// How a robot is moved at present.
enum class LoopMode : int {
  follow,    ///< along a motion, and at rest at its end
  hold,      ///< at rest
  floating,  ///< without stiffness
  fault,     ///< stopped by a guard or by an error of the robot
};

/// What stops a robot.
struct GuardLimits {
  double engage_distance = .05;  ///< rad or m: further from the robot no motion may begin
  double follow_distance = .3;   ///< rad or m: further from where it shall be no stiff robot is moved on
  double stale_time = .1;        ///< s for which a robot's clock may stand still
};

/// Moves a robot period by period: the reference at the end of the next one goes to the driver, within its limits of
/// velocity and acceleration, and the robot is read. Guards look at every reading: numbers that are not finite, a clock
/// that stands still, an error of the robot or of its driver stop it. All commands are logged with the period before
/// which they came. It knows no clock: who calls `step` decides how fast time goes.
class RobotLoop {
 public:
  /// Connects the driver, reads the robot, and holds it where it is. Throws what the driver throws, and RobotFault if the
  /// robot reports an error.
  RobotLoop(std::shared_ptr<RobotDriver> driver, double period, const GuardLimits& guards = {});
  ~RobotLoop();

  void step();                             ///< one period
  void apply(const LoopCommand& command);  ///< now, before the next period; throws what does not fit

  double period() const { return log_.period; }
  long tick() const { return log_.ticks; }
  double time() const { return double(log_.ticks) * log_.period; }  ///< s since it began
  LoopMode mode() const { return mode_; }
  const std::string& fault() const { return fault_; }  ///< why it was stopped; empty if it was not
  const RobotState& state() const { return state_; }
  const BSpline& motion() const { return motion_; }  ///< empty unless it follows or holds
  const RobotInfo& info() const { return info_; }
  RobotInfo& info() { return info_; }
  const CommandLog& log() const { return log_; }
  RobotDriver& driver() { return *driver_; }

  /// What was written last: the reference now, as far as limits let it be; where the robot is while it floats.
  const VectorXd& commanded() const { return commanded_; }
  const VectorXd& commandedVelocity() const { return commanded_velocity_; }

  /// The reference at a time, and its derivatives: 3 x n. That of a floating robot is where it is.
  MatrixXd reference(double time) const;

  /// Throws RobotFault if the robot was stopped, or is too far from where a motion from `reference` would begin.
  void requireReady(const char* call, const VectorXd& reference) const;

  /// The shortest motion to rest from where the reference is, at most `most` seconds or as long as limits of acceleration
  /// need.
  BSpline braking(double most = .05) const;

  void stop(const std::string& reason);  ///< as guards do

 private:
  RobotCommand nextCommand();
  void look(const RobotState& state);
  std::string heldUp() const;
  void applyNow(const FollowSpline& command);
  void applyNow(const HoldRobot& command);
  void applyNow(const FloatRobot& command);
  void applyNow(const SetStiffness& command);
  void applyNow(const GripperCommand& command);
  void applyNow(const AttachFrames& command);
  void applyNow(const PlaceFrame& command);
  void applyNow(const RecoverRobot& command);
  void requireMotion(const BSpline& motion) const;
  void restAtState();
  SimulatedWorld& world(const char* call);

  std::shared_ptr<RobotDriver> driver_;
  GuardLimits guards_;
  RobotInfo info_;
  CommandLog log_;
  LoopMode mode_ = LoopMode::hold;
  std::string fault_;
  RobotState state_;
  double still_ = 0.;  ///< for how long the robot's clock has not moved, s
  BSpline motion_;
  VectorXd commanded_, commanded_velocity_;  ///< what was written last
  MatrixXd stiffness_;
  double floating_damping_ = 0.;
};

}  // namespace kinegraph
