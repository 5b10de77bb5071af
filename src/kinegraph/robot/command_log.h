#pragma once

#include <iosfwd>
#include <variant>

#include "kinegraph/robot/robot_driver.h"
#include "kinegraph/trajectories/b_spline.h"

namespace kinegraph {

/// Follow a motion, in control time.
struct FollowSpline {
  BSpline motion;
};

/// Come to rest along a motion that ends soon, and stay.
struct HoldRobot {
  BSpline motion;
};

/// No stiffness: who pushes the robot moves it.
struct FloatRobot {
  double damping = 0.;  ///< share of the robot's, 0 to 1
};

/// Be less stiff; see RobotCommand::stiffness. Empty: fully stiff again.
struct SetStiffness {
  MatrixXd stiffness;
};

/// Fix a frame of a simulated world to another one, or free it.
struct AttachFrames {
  std::string from, to;
  bool attach = true;
};

/// Put a frame of a simulated world somewhere.
struct PlaceFrame {
  std::string frame;
  Pose pose;
};

/// Go on after a fault.
struct RecoverRobot {};

using LoopCommand = std::variant<FollowSpline, HoldRobot, FloatRobot, SetStiffness, GripperCommand, AttachFrames,
                                 PlaceFrame, RecoverRobot>;

/// All that a robot was told, and when, in periods of control. From the same start, the same log gives the same motion.
struct CommandLog {
  struct Entry {
    long tick = 0;  ///< it was told before this period
    LoopCommand command;
  };
  double period = .01;  ///< s
  long ticks = 0;       ///< how long it ran
  std::vector<Entry> entries;

  /// As text, one command a line, with numbers that read back as they are.
  std::string text() const;
  static CommandLog fromText(const std::string& text, const std::string& name = "text");  ///< throws ParseError

  void save(const std::string& path) const;         ///< throws FileError
  static CommandLog load(const std::string& path);  ///< throws FileError, ParseError
};

}  // namespace kinegraph
