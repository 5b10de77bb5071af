#pragma once

#include "kinegraph/robot/drivers.h"

namespace kinegraph {

/// A planar arm of two joints with limits of position, velocity and effort, and a gripper of two fingers; a table with
/// a box.
inline Config twoJointArm() {
  Config C;
  C.addText(R"(
base: {}
arm1 (base): { joint: hingeZ, limits: [-2 2], ctrl_limits: [2 50 -1] }
arm2_origin (arm1): { Q: [.5 0 0] }
arm2 (arm2_origin): { joint: hingeZ, limits: [-2 2], ctrl_limits: [2 20 -1] }
gripper (arm2): { Q: [.4 0 0], shape: marker, size: [.03] }
finger_origin (arm2): { Q: [.4 0 0] }
finger1 (finger_origin): { joint: transY, limits: [0 .04], ctrl_limits: [.1 30 -1], q: .04, joint_active: False, shape: box, size: [.02 .01 .02] }
finger2 (finger_origin): { joint: transY, joint_scale: -1, mimic: finger1, shape: box, size: [.02 .01 .02] }
box: { X: [.9 0 0], shape: box, size: [.03 .03 .03] }
)");
  return C;
}

/// A robot without grippers and limits whose joints are those of the arm.
inline RobotInfo plainRobot() {
  constexpr double all = std::numeric_limits<double>::infinity();
  const auto each = [](double value) { return VectorXd(VectorXd::Constant(2, value)); };
  return {"plain", {"arm1", "arm2"}, each(-all), each(all), each(all), each(all), each(all), 100., false, {}};
}

inline VectorXd pair(double a, double b) { return Eigen::Vector2d(a, b); }
inline MatrixXd row(double a, double b) { return pair(a, b).transpose(); }
inline VectorXd seconds(double t) { return VectorXd::Constant(1, t); }

}  // namespace kinegraph
