// A loop at 1 kHz: a gripper follows a target, within limits of velocity and acceleration.
#include <kinegraph/kinegraph.h>

#include <chrono>
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
  std::chrono::duration<double, std::micro> used{};
  for (int i = 0; i < 6000; ++i) {
    const double t = .001 * i;
    C.getFrame("target").setPosition(start + Vector3d(.1 * std::sin(t), .1 * (1. - std::cos(t)), 0.));
    const auto begin = std::chrono::steady_clock::now();
    ik.step(.001);
    used += std::chrono::steady_clock::now() - begin;
    if (i > 500) worst = std::max(worst, C.eval(FS::positionDiff, {"l_gripper", "target"}).y.norm());
  }
  std::cout << "within " << 1e3 * worst << " mm; a step takes " << used.count() / 6000 << " of 1000 us\n";
  return ik.status() == DiffIkStatus::solved && worst < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
