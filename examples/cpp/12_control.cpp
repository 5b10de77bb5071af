// A gripper follows a target in steps of 5 ms, within limits of velocity and acceleration.
#include <kinegraph/kinegraph.h>

#include <cmath>
#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  const Frame target = C.addFrame("target").setPose(C.getFrame("l_gripper").getPose());
  const Vector3d start = target.getPosition();

  DiffIkOptions options;
  options.velocity = VectorXd::Constant(7, 2.);
  options.acceleration = VectorXd::Constant(7, 20.);
  DiffIk ik(C, options);
  ik.addTask(FS::poseDiff, {"l_gripper", "target"});
  double worst = 0.;
  for (int i = 0; i < 1200; ++i) {
    const double t = .005 * i;
    C.getFrame("target").setPosition(start + Vector3d(.1 * std::sin(t), .1 * (1. - std::cos(t)), 0.));
    ik.step(.005);
    if (i > 100) worst = std::max(worst, C.eval(FS::positionDiff, {"l_gripper", "target"}).y.norm());
  }
  std::cout << "within " << 1e3 * worst << " mm\n";
  return ik.status() == DiffIkStatus::solved && worst < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
