#pragma once

#include <string>
#include <vector>

namespace kinegraph {

/// The kind of quantity that a residual or variable measures.
enum class Measure {
  number,      ///< no unit
  length,      ///< m
  angle,       ///< rad
  quaternion,  ///< component of the difference of two unit quaternions
  axis,        ///< component of the difference of two unit vectors
  cosine,      ///< cos(angle) - cos(target)
};

/// Describes a residual in terms of the user: phi = scale * (quantity of kind `measure`).
struct RowDescription {
  std::string objective;  ///< "positionDiff of l_gripper, target"
  int group = -1;         ///< residuals of one group are one requirement of the user, which holds as a whole or not
  std::vector<std::string> frames;
  int slice = -1;  ///< of a path; -1: no path
  Measure measure = Measure::number;
  double scale = 1.;
  double target = 0.;  ///< of a cosine
  int time_order = 0;  ///< 1: per s, 2: per s^2
};

/// Describes a variable in terms of the user.
struct VariableDescription {
  std::string name;   ///< "panda_joint4"
  std::string frame;  ///< frame of the joint; may be empty
  int slice = -1;     ///< of a path; -1: no path
  Measure measure = Measure::number;
};

}  // namespace kinegraph
