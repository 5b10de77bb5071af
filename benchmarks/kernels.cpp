// Times the most frequent computations of Kinegraph on the Panda, or runs one of these kernels for a profiler.
//     kernels MODELS_FOLDER                  microseconds per call of each
//     kernels MODELS_FOLDER KERNEL COUNT     runs one COUNT times
//     kernels --conditions                   conditions of instruction counts besides the sources
#include <array>
#include <chrono>
#include <cstdio>
#include <functional>
#include <map>
#include <string>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"

using namespace kinegraph;

namespace {

using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// The Panda on its table, a target for its gripper, and a list of joint vectors.
struct Bench {
  explicit Bench(const std::string& models) : file(models + "/scenarios/pandaSingle.g") {
    config.addFile(file);
    config.addFrame("target", "table").setRelativePosition({.1, .4, .5});
    home = config.getJointState();
    Rng rng(1);
    for (VectorXd& q : configurations) {
      q = home;
      for (double& angle : q) angle += rng.uniform(-.3, .3);
    }
    gripper = config.getFrame("l_gripper").data().id;
  }
  const VectorXd& posture(int i) const { return configurations[std::size_t(i) % configurations.size()]; }

  std::string file;
  Config config;
  VectorXd home;
  std::array<VectorXd, 16> configurations;
  int gripper;
};

using Kernel = std::function<void(Bench&, int count)>;

void forwardKinematics(Bench& bench, int count) {
  State state = bench.config.state();
  for (int i = 0; i < count; ++i) state.setJoints(bench.posture(i).data());
}

void jacobian(Bench& bench, int count) {
  State state = bench.config.state();
  Matrix J(6, state.dofs());
  for (int i = 0; i < count; ++i) {
    state.setJoints(bench.posture(i).data());
    state.jacobian(bench.gripper, state.position(bench.gripper), J);
  }
}

void evaluate(Bench& bench, int count, FeatureSymbol feature, const std::vector<std::string>& frames) {
  Residual residual = makeResidual(bench.config.state(), feature, frames);
  VectorXd y(residual.rows());
  Matrix J(residual.rows(), bench.config.getJointDimension());
  for (int i = 0; i < count; ++i) {
    bench.config.setJointState(bench.posture(i));
    J.setZero();
    eval(bench.config, residual, y, J);
  }
}

/// The same queries for many configurations in one call.
struct Batch {
  explicit Batch(Bench& bench) : scene(bench.config.state()), Q(kBatch, scene.dofs()) {
    for (int i = 0; i < kBatch; ++i) Q.row(i) = bench.posture(i).transpose();
  }
  static constexpr int kBatch = 256;
  State scene;
  RowMatrix Q;
};

void jacobianBatch(Bench& bench, int count) {
  const Batch batch(bench);
  RowMatrix J(6 * Batch::kBatch, batch.scene.dofs());
  for (int i = 0; i < count; i += Batch::kBatch) frameJacobians(batch.scene, {bench.gripper}, batch.Q, J);
}

void evaluateBatch(Bench& bench, int count, FeatureSymbol feature) {
  const Batch batch(bench);
  const Residual residual = makeResidual(batch.scene, feature, {"l_gripper"});
  RowMatrix y(Batch::kBatch, residual.rows()), J(residual.rows() * Batch::kBatch, batch.scene.dofs());
  JacobianRows rows = J;
  for (int i = 0; i < count; i += Batch::kBatch) evalBatch(batch.scene, residual, batch.Q, y, &rows);
}

/// The tip of a chain of hinges, and its Jacobian.
void chain(int joints, int count) {
  Config config;
  std::string text = "link0: {}\n";
  for (int i = 1; i <= joints; ++i)
    text += cat("link", i, "(link", i - 1, "): { pre: \"t(.01 0 0)\", joint: hingeZ }\n");
  config.addText(text);
  Residual residual = makeResidual(config.state(), FeatureSymbol::position, {cat("link", joints)});
  VectorXd y(3), q = VectorXd::Constant(joints, .01);
  Matrix J(3, joints);
  for (int i = 0; i < count; ++i) {
    config.setJointState(q);
    J.setZero();
    eval(config, residual, y, J);
  }
}

void load(Bench& bench, int count) {
  for (int i = 0; i < count; ++i) Config().addFile(bench.file);
}

void inverseKinematics(Bench& bench, int count) {
  Rng rng(0);
  Config& C = bench.config;
  for (int i = 0; i < count; ++i) {
    C.setJointState(bench.posture(i));
    const auto komo = std::make_shared<Komo>(C, 1., 1, 0);
    komo->addObjective({}, FeatureSymbol::qItself, {}, ObjectiveType::sos, .1, bench.home);
    komo->addObjective({}, FeatureSymbol::positionDiff, {"l_gripper", "target"}, ObjectiveType::eq,
                       MatrixXd::Constant(1, 1, 10.));
    if (!NlpSolver(makeNlp(komo), 0).solve(false, rng).feasible) throw Error("inverse kinematics: no solution");
  }
}

const std::map<std::string, Kernel> kKernels = {
    {"forward kinematics", forwardKinematics},
    {"Jacobian", jacobian},
    {"position", [](Bench& b, int count) { evaluate(b, count, FeatureSymbol::position, {"l_gripper"}); }},
    {"collisions", [](Bench& b, int count) { evaluate(b, count, FeatureSymbol::accumulatedCollisions, {}); }},
    {"Jacobian, batch", jacobianBatch},
    {"pose, batch", [](Bench& b, int count) { evaluateBatch(b, count, FeatureSymbol::pose); }},
    {"chain of 100", [](Bench&, int count) { chain(100, count); }},
    {"chain of 1000", [](Bench&, int count) { chain(1000, count); }},
    {"load", load},
    {"inverse kinematics", inverseKinematics},
};

}  // namespace

int main(int argc, char** argv) try {
  if (argc == 2 && std::string(argv[1]) == "--conditions") {
    std::printf("GCC %s, %s\n", __VERSION__, __builtin_cpu_supports("fma") ? "fma" : "no fma");
    return 0;
  }
  if (argc != 2 && argc != 4) {
    std::fprintf(stderr, "usage: kernels MODELS_FOLDER [KERNEL COUNT]\n");
    return 2;
  }
  Bench bench(argv[1]);
  if (argc == 4) {
    kKernels.at(argv[2])(bench, std::stoi(argv[3]));
    return 0;
  }
  for (const auto& [name, kernel] : kKernels) {
    double best = 1e9;
    for (int round = 0, count = 1; round < 20; ++round) {
      const auto start = std::chrono::steady_clock::now();
      kernel(bench, count);
      const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      if (seconds < .01) {
        count *= 2;
        --round;
      } else {
        best = std::min(best, seconds / count);  // counts above 256 are multiples of it
      }
    }
    std::printf("%-20s %9.3f us\n", name.c_str(), 1e6 * best);
  }
} catch (const Error& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
