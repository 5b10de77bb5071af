#pragma once

#include <limits>
#include <memory>
#include <variant>
#include <vector>

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// Follows a spline, in control time. The present motion goes on until `begin` (s).
struct FollowSpline {
  BSpline motion;
  double begin = -std::numeric_limits<double>::infinity();
};

/// Follows a trajectory whose t = 0 is the control time `begin` (s). Its samples are the references of control periods.
struct FollowTrajectory {
  double begin = 0.;
  std::shared_ptr<const SampledTrajectory> motion;
};

/// Comes to rest along a spline in control time that ends soon, and stays at its end.
struct HoldRobot {
  BSpline motion;
};

/// Sets the stiffness to zero, so that a hand can move the robot.
struct FloatRobot {
  double damping = 0.;  ///< share of the robot's damping that remains, 0 to 1
};

/// Sets a reduced stiffness; see RobotCommand::stiffness. Empty: full stiffness.
struct SetStiffness {
  MatrixXd stiffness;
};

/// Attaches a frame of a simulated world to another one, or detaches it.
struct AttachFrames {
  std::string from, to;
  bool attach = true;
};

/// Sets the pose of a frame of a simulated world.
struct PlaceFrame {
  std::string frame;
  Pose pose;
};

/// Clears a fault.
struct RecoverRobot {};

using LoopCommand = std::variant<FollowSpline, FollowTrajectory, HoldRobot, FloatRobot, SetStiffness, GripperCommand,
                                 AttachFrames, PlaceFrame, RecoverRobot>;

/// All commands to a robot with the control period of each. The same log from the same start gives the same motion.
struct CommandLog {
  struct Entry {
    long tick = 0;  ///< number of control periods before the command
    LoopCommand command;
  };
  double period = .01;  ///< control period, s
  long ticks = 0;       ///< number of control periods in all
  std::vector<Entry> entries;

  /// Returns the log as text, one command per line, with all digits of its numbers.
  std::string text() const;

  /// Reads such a text; `name` stands for the file in messages. Throws ParseError.
  static CommandLog fromText(const std::string& text, const std::string& name = "text");

  void save(const std::string& path) const;         ///< throws FileError
  static CommandLog load(const std::string& path);  ///< throws FileError, ParseError
};

}  // namespace kinegraph
