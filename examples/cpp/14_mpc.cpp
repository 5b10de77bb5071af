// A receding horizon controls a simulated Panda, which follows a target and recovers from a push: one solver step per
// call.
#include <kinegraph/kinegraph.h>

#include <cmath>
#include <iostream>

using namespace kinegraph;

int main() try {
  constexpr double tau = .05;
  constexpr int slices = 20;
  Config M;  // the planner's model
  M.addFile(modelPath("scenarios/pandaSingle.g"));
  M.addFrame("target").setPose(M.getFrame("l_gripper").getPose());
  const Vector3d start = M.getFrame("l_gripper").getPosition();
  const auto targetAt = [&](double t) -> Vector3d { return start + .1 * Vector3d(std::sin(t), 0., 1. - std::cos(t)); };

  KOMO komo(M, slices * tau, 20, 2);
  komo.addControlObjective({}, 2, .1);
  komo.addObjective({}, FS::accumulatedCollisions, {}, OT::eq);
  komo.addObjective({}, FS::jointLimits, {}, OT::ineq);
  komo.addObjective({}, FS::poseDiff, {"l_gripper", "target"}, OT::sos, 10.);
  Mpc mpc(komo, {.evaluations = 2});

  Config C;  // the simulated world
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  Simulation S(C);
  MatrixXd ahead(slices, 3);
  VectorXd reference(14);
  double error = 0., worst = 0.;
  for (int i = 0; i < 100; ++i) {
    for (int t = 0; t < slices; ++t) ahead.row(t) = targetAt((i + t + 1) * tau).transpose();
    mpc.setPoses("target", ahead);
    mpc.step(S.get_q(), S.get_qDot());
    if (i == 60) S.applyForce("l_gripper", {0., 60., 0.});
    if (i == 62) S.clearForces();
    for (int k = 1; k <= 5; ++k) {
      const MotionPoint point = mpc.at(.01 * k);
      reference << point.q, point.velocity;
      S.step(reference, .01, ControlMode::positionVelocity);
    }
    error = (C.getFrame("l_gripper").getPosition() - targetAt((i + 1) * tau)).norm();
    if (i > 30) worst = std::max(worst, error);
  }
  std::cout << "after the push " << 1e3 * worst << " mm off, at the end " << 1e3 * error << " mm\n";
  return mpc.result().feasible && error < 5e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
