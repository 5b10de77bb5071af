#pragma once

#include <array>
#include <string>

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

}  // namespace kinegraph
