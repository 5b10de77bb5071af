// Part 9: custom features. A function of frames is a feature like any other.
//
// It receives a view of each frame at one configuration and returns a value, or a value and its Jacobian.
// Without the Jacobian, central differences replace it.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// Distance of the gripper from the vertical line through the post, squared (m^2).
FeatureValue fromAxis(std::span<const FrameView> frames) {
  return (frames[0].getPosition() - frames[1].getPosition()).head<2>().squaredNorm();
}

/// Height of the gripper (m), with its Jacobian.
FeatureValue onHeight(std::span<const FrameView> frames) {
  return {frames[0].getPosition().z(), frames[0].getPositionJacobian().row(2)};
}

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("post", "table").setShape(ST::marker, {.1}).setRelativePosition({.2, .35, .4});
  const FeatureSource from_axis = ownFeature("fromAxis", fromAxis), on_height = ownFeature("onHeight", onHeight);

  const auto [y, J] = C.eval(from_axis, {"l_gripper", "post"});
  std::cout << "distance squared and its gradient: " << y << ", " << J << "\n";

  Komo komo(C, 1, 1, 0);
  komo.addObjective({}, FS::jointState, {}, OT::sos, .1, C.getJointState());
  komo.addObjective({}, from_axis, {"l_gripper", "post"}, OT::eq, 10., .15 * .15);  // on a cylinder around the post
  komo.addObjective({}, on_height, {"l_gripper"}, OT::eq, 10., 1.1);
  const SolverResult result = komo.solve();
  std::cout << result.str() << "\n";

  const VectorXd start = C.getJointState(), end = komo.getPath().row(0);
  C.setJointState(end);
  const double distance = std::sqrt(C.eval(from_axis, {"l_gripper", "post"}).y[0]);
  const double height = C.eval(on_height, {"l_gripper"}).y[0];
  std::cout << "gripper at height " << height << " m, " << distance << " m from the post\n";

  const std::optional<MotionContact> contact = C.checkMotion(start, end);
  std::cout << (contact ? "the straight way there meets something\n" : "the straight way there is free\n");
  return result.feasible && std::abs(height - 1.1) < 1e-3 && std::abs(distance - .15) < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
