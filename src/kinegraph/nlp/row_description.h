#pragma once

#include <string>
#include <vector>

namespace kinegraph {

/// What kind of quantity a residual, or a variable, is.
enum class Measure {
  number,      ///< without a unit
  length,      ///< m
  angle,       ///< rad
  quaternion,  ///< an entry of the difference of two unit quaternions
  axis,        ///< an entry of the difference of two unit vectors
  cosine,      ///< cos(angle) - cos(target)
};

/// What a person would call a residual: phi = scale * (what `measure` says).
struct RowDescription {
  std::string objective;  ///< "positionDiff of l_gripper, target"
  int group = -1;         ///< residuals of one group are one demand of the user, which is kept or given up as a whole
  std::vector<std::string> frames;
  int slice = -1;  ///< of a path; -1: there are none
  Measure measure = Measure::number;
  double scale = 1.;
  double target = 0.;  ///< of a cosine
  int time_order = 0;  ///< 1: per s, 2: per s^2
};

/// What a person would call a variable.
struct VariableDescription {
  std::string name;   ///< "panda_joint4"
  std::string frame;  ///< whose joint it is; may be empty
  int slice = -1;
  Measure measure = Measure::number;
};

}  // namespace kinegraph
