#pragma once

#include <array>
#include <string>

#include "kinegraph/math/pose.h"

namespace kinegraph {

/// The sticks of a gamepad as velocities of a position, through Linux' joystick interface.
class Gamepad {
 public:
  /// Opens a device. `speed` is that of the position where a stick is at its end, m/s; `axes` are those of the gamepad that
  /// move x, y and z; y and z against the sticks, which count downwards. Throws FileError if it cannot be opened.
  explicit Gamepad(const std::string& device = "/dev/input/js0", double speed = .2,
                   std::array<int, 3> axes = {0, 1, 4});
  ~Gamepad();
  Gamepad(const Gamepad&) = delete;

  /// Takes in what has happened since the last call. Returns where the sticks push, m/s.
  Vector3d velocity();

  void close();  ///< the sticks stay where they were

 private:
  int file_;
  double speed_;
  std::array<int, 3> axes_;
  Vector3d values_ = Vector3d::Zero();  ///< of the axes, -1 to 1
};

}  // namespace kinegraph
