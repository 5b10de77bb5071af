// Kinegraph's part of benchmarks/cpp_calls.py.
//     kinegraph_calls SCENE FRAME JOINT_VECTORS    times the call
//     kinegraph_calls SCENE FRAME                  describes the chain: axis and a point on it per joint, at q = 0,
//                                                  then the frame's position, and the joints' limits
#include "calls.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/config.h"

using namespace kinegraph;

namespace {

using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;

void printRow(const VectorXd& numbers) {
  std::printf("%d", int(numbers.size()));
  for (const double number : numbers) std::printf(" %.17g", number);
  std::printf("\n");
}

void describe(const Config& config, int frame) {
  State state = config.state();
  state.setJoints(VectorXd::Zero(state.dofs()).eval().data());
  const KinematicModel& model = state.model();
  for (std::size_t link = 1; link < model.links.size(); ++link) {
    VectorXd joint(6);
    joint << state.twist(model.links[link].first_column).angular, state.position(model.links[link].frame);
    printRow(joint);
  }
  printRow(state.position(frame));
  printRow(model.lower);
  printRow(model.upper);
}

void time(const Config& config, int frame, const std::vector<calls::Numbers>& joint_vectors) {
  State state = config.state();
  Vector3d position;
  Jacobian J(6, state.dofs());
  const auto call = [&](std::size_t i) {
    state.setJoints(joint_vectors[i].data());
    position = state.position(frame);
    state.jacobian(frame, position, J);
  };
  const auto answer = [&] {
    calls::Numbers numbers(position.begin(), position.end());
    numbers.insert(numbers.end(), J.data(), J.data() + J.size());
    return numbers;
  };
  calls::report("", joint_vectors.size(), call, answer);
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3 && argc != 4) {
    std::fprintf(stderr, "usage: kinegraph_calls SCENE FRAME [JOINT_VECTORS]\n");
    return 2;
  }
  Config config;
  config.addFile(argv[1]);
  const int frame = config.getFrame(argv[2]).id();
  if (argc == 3) {
    describe(config, frame);
  } else {
    time(config, frame, calls::readRows(argv[3]));
  }
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
