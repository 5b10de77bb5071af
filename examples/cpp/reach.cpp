// Inverse kinematics from C++: brings the gripper of a Franka Panda to a position.
#include <kinegraph/kinegraph.h>

#include <cstdio>

using namespace kinegraph;

int main() try {
  Config C;
  C.addFile(modelPath("scenarios/pandaSingle.g"));
  C.addFrame("target", "table").setRelativePosition({.2, .4, .5});

  const auto komo = std::make_shared<Komo>(C, 1., 1, 0);
  komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, MatrixXd::Constant(1, 1, .1),
                     C.getJointState());
  komo->addObjective({}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq,
                     MatrixXd::Constant(1, 1, 10.));

  Rng rng(0);
  const SolverResult result = NlpSolver(makeNlp(komo), 0).solve(false, rng);
  C.setJointState(komo->getPath().row(0));
  const double error = (C.getFrame("l_gripper").getPose().p - C.getFrame("target").getPose().p).norm();
  std::printf("%s\ngripper is %.2g m from the target\n", result.message.c_str(), error);
  return result.feasible && error < 1e-4 ? 0 : 1;
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
