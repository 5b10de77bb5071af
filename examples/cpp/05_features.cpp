// Part 5: features. A feature is a quantity y of a configuration that comes with its derivative J = dy/dq.
//
// Evaluates features on two Panda arms, and compares every J with finite differences of y.
#include <kinegraph/kinegraph.h>

#include <iostream>

using namespace kinegraph;

using Frames = std::vector<std::string>;

/// Two Pandas, 80 cm apart: `gripper` on the left one, `r_gripper` on the right one, and a box.
Config twoArms() {
  Config C;
  C.addFile(modelPath("panda/panda.g"));
  C.addFile(modelPath("panda/panda.g"), "r_");
  C.getFrame("r_panda_base").setPosition({0, -.8, 0});
  C.addFrame("box").setPosition({.5, -.4, .3}).setShape(ST::ssBox, {.3, .3, .3, .02}).setContact(1);
  return C;
}

double differenceToFiniteDifferences(Config& C, FS symbol, const Frames& frames, const MatrixXd& J) {
  const double step = 1e-5;
  const VectorXd q = C.getJointState();
  double worst = 0.;
  for (int i = 0; i < q.size(); ++i) {
    const VectorXd e = step * VectorXd::Unit(q.size(), i);
    C.setJointState(q + e);
    const VectorXd plus = C.eval(symbol, frames).y;
    C.setJointState(q - e);
    const VectorXd minus = C.eval(symbol, frames).y;
    worst = std::max(worst, ((plus - minus) / (2 * step) - J.col(i)).lpNorm<Eigen::Infinity>());
  }
  C.setJointState(q);
  return worst;
}

const std::vector<std::pair<const char*, Frames>> kTable = {
    {"position", {"gripper"}},
    {"quaternion", {"gripper"}},
    {"vectorZ", {"gripper"}},
    {"positionDiff", {"gripper", "r_gripper"}},
    {"poseRel", {"gripper", "r_gripper"}},
    {"gazeAt", {"gripper", "r_gripper"}},
    {"scalarProductXZ", {"gripper", "r_gripper"}},
    {"distance", {"panda_coll7", "r_panda_coll7"}},
    {"negDistance", {"panda_coll7", "box"}},
    {"insideBox", {"gripper", "box"}},
    {"oppose", {"finger1", "finger2", "box"}},
    {"accumulatedCollisions", {}},
    {"jointLimits", {}},
    {"qItself", {}},
};

int main() try {
  Config C = twoArms();
  Rng rng(1);
  VectorXd q = C.getJointState();
  for (double& angle : q) angle += .2 * rng.normal();
  C.setJointState(q);
  C.view(true, "two arms and a box");

  double worst = 0.;
  for (const auto& [name, frames] : kTable) {
    const FS symbol = featureSymbolFromName(name);
    const auto [y, J] = C.eval(symbol, frames);
    const double error = differenceToFiniteDifferences(C, symbol, frames, J);
    std::cout << name << ": " << y.size() << " rows, |J - J_fd| " << error
              << ", y = " << y.head(std::min<Eigen::Index>(y.size(), 7)).transpose() << "\n";
    worst = std::max(worst, error);
  }

  // Velocities compare two configurations: the one of C, and the next slice of a path that starts there.
  Komo komo(C, 1, 1, 1);
  komo.addObjective({}, FS::angularVel, {"gripper"}, OT::eq, 1., {}, 1);
  q[6] += .5;
  const auto nlp = komo.nlp();
  VectorXd y(nlp->types().size());  // a number per residual
  nlp->evaluate(q, y, nullptr);
  std::cout << "\nangularVel of the gripper when its last joint rotates by .5 rad within 1 s: " << y.transpose()
            << ", norm " << y.norm() << "\n";

  // The same features on a scene with a single arm.
  Config D;
  D.addFile(modelPath("scenarios/pandaSingle.g"));
  std::cout << "height of the gripper over the table: " << D.eval(FS::positionRel, {"l_gripper", "table"}).y[2]
            << " m\n";
  std::cout << "distance of palm and table: " << -D.eval(FS::negDistance, {"l_palm", "table"}).y[0] << " m\n";
  return worst < 1e-5 && std::abs(y.norm() - .5) < .01 ? 0 : 1;
} catch (const Error& error) {
  std::cerr << error.what() << "\n";
  return 1;
}
