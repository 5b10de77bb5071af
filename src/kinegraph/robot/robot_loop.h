#pragma once

#include <memory>
#include <utility>

#include "kinegraph/robot/command_log.h"
#include "kinegraph/robot/motion_limits.h"
#include "kinegraph/robot/reference_motion.h"
#include "kinegraph/robot/robot_driver.h"

namespace kinegraph::inline robot_internal {

/// Moves a robot in control periods: `step` writes the reference at the end of the period to the driver, within the
/// robot's limits of position, velocity and acceleration, and reads the robot's state. A state with numbers that are
/// not finite, a clock that stands still, a tracking error, and an error of the robot or its driver stop the robot. The
/// loop logs each command with the number of its period. It has no clock: its caller sets the pace.
class RobotLoop {
 public:
  /// Connects the driver, reads the robot, and holds it. Throws the driver's errors, and RobotFault if the robot
  /// reports an error.
  RobotLoop(std::shared_ptr<RobotDriver> driver, double period, const SafetyLimits& safety = {});
  ~RobotLoop();

  /// Runs one control period.
  void step();

  /// Executes a command before the next period. Throws ValueError or RobotFault if it does not fit the robot.
  void apply(const LoopCommand& command);

  double period() const { return log_.period; }
  long tick() const { return log_.ticks; }                          ///< number of periods so far
  double time() const { return double(log_.ticks) * log_.period; }  ///< control time, s
  LoopMode mode() const { return mode_; }
  const std::string& fault() const { return fault_; }  ///< cause of the fault; empty without one

  void warn(const std::string& message) { warning_ += warning_.empty() ? message : "; " + message; }

  /// Returns and clears the last warning, such as of a joint that came too far from its command; empty without one.
  std::string takeWarning() { return std::exchange(warning_, {}); }
  const RobotState& state() const { return state_; }
  const ReferenceMotion& motion() const { return motion_; }  ///< of the modes follow and hold
  const RobotInfo& info() const { return info_; }
  RobotInfo& info() { return info_; }
  const CommandLog& log() const { return log_; }
  RobotDriver& driver() { return *driver_; }

  /// The last command: the reference within the robot's limits, or the robot's q while it floats.
  const VectorXd& commanded() const { return commanded_; }
  const VectorXd& commandedVelocity() const { return commanded_velocity_; }

  /// Returns the reference at a control time (s) and its two derivatives: 3 x n. A floating robot's is its own q, at
  /// rest.
  MatrixXd reference(double time) const;

  /// Throws RobotFault if the robot is in fault, or if `q` is farther from the robot than the start distance.
  void requireReady(const char* call, const VectorXd& q) const;

  /// Returns a stopping segment from the reference at `time` (s): a cubic that takes `duration` s, or as long as limits
  /// of acceleration require.
  BSpline stoppingSegment(double time, const MatrixXd& reference, double duration = .05) const;

  /// Puts the robot in fault.
  void stop(const std::string& reason);

 private:
  RobotCommand nextCommand();
  void accept(const RobotState& state);
  std::string trackingFault() const;
  void execute(const FollowSpline& command);
  void execute(const FollowTrajectory& command);
  void execute(const HoldRobot& command);
  void execute(const FloatRobot& command);
  void execute(const SetStiffness& command);
  void execute(const GripperCommand& command);
  void execute(const AttachFrames& command);
  void execute(const PlaceFrame& command);
  void execute(const RecoverRobot& command);
  void requireDimension(int dimension) const;
  void startFollowing();
  void restAtState();
  SimulatedWorld& world(const char* call);

  std::shared_ptr<RobotDriver> driver_;
  SafetyLimits safety_;
  RobotInfo info_;
  CommandLog log_;
  LoopMode mode_ = LoopMode::hold;
  std::string fault_, warning_;
  bool lags_ = false;
  RobotState state_;
  double clock_pause_ = 0.;  ///< how long the robot's clock has stood still, s
  ReferenceMotion motion_;
  VectorXd commanded_, commanded_velocity_;
  MatrixXd stiffness_;
  double floating_damping_ = 0.;
};

}  // namespace kinegraph::inline robot_internal
