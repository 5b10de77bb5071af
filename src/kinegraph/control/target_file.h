#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// Reads the sticks of a gamepad as velocity of a position, through the joystick interface of Linux.
class Gamepad {
 public:
  /// Opens a device. `speed` (m/s) is the speed of the position for a stick at its end. `axes` of the gamepad move x, y
  /// and z; y and z have the opposite sign, because sticks count downwards. Throws FileError if the device cannot be
  /// opened.
  explicit Gamepad(const std::string& device = "/dev/input/js0", double speed = .2,
                   std::array<int, 3> axes = {0, 1, 4});
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;

  /// Reads all events since the last call and returns the velocity, m/s.
  Vector3d velocity();

  void close();  ///< the velocity keeps its last value

 private:
  int file_;
  double speed_;
  std::array<int, 3> axes_;
  Vector3d values_ = Vector3d::Zero();  ///< of the axes, -1 to 1
};

/// A sequence of timed poses from a text: lines of t x y z, or t x y z qw qx qy qz, in s and m. Commas separate the
/// numbers. Empty lines, lines that begin with # and a header are ignored. Between lines, positions are interpolated
/// linearly and rotations spherically; before the first and after the last line the pose is constant.
class TargetFile {
 public:
  /// Reads a file. Throws FileError if it cannot be read, ParseError with the place of an unexpected text.
  explicit TargetFile(const std::string& path);

  /// Reads a text; errors contain `name`.
  static TargetFile fromText(std::string_view text, const std::string& name = {});

  double duration() const { return entries_.back().time; }  ///< time of the last line, s

  /// Returns the pose at a time t, s: x y z (3,), or x y z qw qx qy qz (7,).
  VectorXd operator()(double t) const;

 private:
  struct Entry {
    double time;
    VectorXd pose;
  };
  TargetFile() = default;

  std::vector<Entry>
      entries_;  ///< at least one; times ascend, quaternions have length one and signs of the shorter rotation
};

}  // namespace kinegraph
