// Derivatives of solutions by parameters of the problem. The mounting of a tool is estimated from the robot's
// configurations at known points, by gradients through inverse kinematics.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

/// Solves the robot's inverse kinematics with the tool at `place`; returns q and its derivative by the tool's position.
std::pair<VectorXd, MatrixXd> reach(Config& C, const Vector3d& point, const Vector3d& place) {
  C.getFrame("tool").setRelativePosition(place);
  Komo komo(C, 1, 1, 0);
  komo.addControlObjective({}, 0, .1);
  komo.addObjective({}, FS::position, {"tool"}, OT::eq, 10., point);
  const SolverResult result = komo.solve();
  Sensitivity sensitivity(result, {parameterOf(*result.problem, "tool")});
  return {sensitivity.x(), sensitivity.jacobian()};
}

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("tool", "l_gripper");
  Rng rng(0);
  const auto random = [&rng] { return rng.uniform(-1., 1.); };

  const Vector3d truth(.03, -.02, .05);
  std::vector<Vector3d> points;
  std::vector<VectorXd> observed;
  for (int i = 0; i < 6; ++i) {
    points.push_back(Vector3d(.3, .3, 1.) + .2 * Vector3d(random(), random(), random()));
    observed.push_back(reach(C, points[i], truth).first);
    for (double& q : observed[i]) q += 1e-4 * rng.normal();  // noise of the measured joints, rad
  }

  // Gauss-Newton on the tool's position, with the predicted configurations and their derivatives.
  Vector3d place = Vector3d::Zero();
  for (int step = 0; step < 5; ++step) {
    VectorXd missing(7 * points.size());
    MatrixXd jacobian(7 * points.size(), 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [q, dq] = reach(C, points[i], place);
      missing.segment<7>(7 * i) = observed[i] - q;
      jacobian.middleRows<7>(7 * i) = dq;
    }
    std::cout << "step " << step << ": configurations off by "
              << 1e3 * std::sqrt(missing.squaredNorm() / missing.size()) << " mrad, tool at " << place.transpose()
              << "\n";
    place += jacobian.colPivHouseholderQr().solve(missing);
  }
  const double error = (place - truth).cwiseAbs().maxCoeff();
  std::cout << "found within " << 1e3 * error << " mm\n";
  C.getFrame("tool").setRelativePosition(place).setShape(ST::sphere, {.02});
  C.view(false, "the tool where it was found");
  return error < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
