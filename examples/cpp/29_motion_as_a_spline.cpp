// A motion problem whose variables are the control points of a B-spline.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("target", "table").setRelativePosition({-.3, .35, .3});
  C.addFrame("post", "table")
      .setShape(ShapeType::ssBox, {.06, .06, .6, .02})
      .setRelativePosition({-.12, .35, .3})
      .setContact(1);

  const auto komo = std::make_shared<KOMO>(C, 2., 30, 2);  // two phases of a second
  komo->addControlObjective({}, 2, .1);
  komo->addObjective({}, FS::accumulatedCollisions, {}, OT::eq, 10., {}, -1, .02);
  komo->addObjective({2.}, FS::positionDiff, {"l_gripper", "target"}, OT::eq, 10.);
  const SplineMotion motion(komo, {.points = 10});
  NlpSolver solver(motion.nlp(), 0);
  const SolverResult result = solver.solve();
  std::cout << result.x.size() << " variables for " << komo->getPath().size() << " numbers\n";
  if (!result.feasible) return 1;

  // Joint limits hold along the spline, because they hold at the control points.
  const BSpline spline = motion.spline();
  const MatrixXd limits = C.getJointLimits();
  for (int i = 0; i <= 2000; ++i) {
    const VectorXd q = spline.eval(.001 * i);
    if ((q.array() < limits.row(0).transpose().array()).any()) return 1;
    if ((q.array() > limits.row(1).transpose().array()).any()) return 1;
  }
  C.setJointState(spline.eval(spline.end()));
  const double off = (C.getFrame("l_gripper").getPosition() - C.getFrame("target").getPosition()).norm();
  std::cout << "the gripper is " << 1e3 * off << " mm off\n";
  return off < 1e-3 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
