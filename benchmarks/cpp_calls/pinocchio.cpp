// Pinocchio's part of benchmarks/cpp_calls.py, which compiles it with the headers of the wheel.
//     pinocchio_calls CHAIN JOINT_VECTORS    CHAIN: the description by kinegraph_calls
#include <pinocchio/multibody.hpp>

#include <pinocchio/algorithm/frames.hpp>
#include <pinocchio/algorithm/jacobian.hpp>
#include <pinocchio/algorithm/kinematics.hpp>
#include <pinocchio/config.hpp>

#include "calls.h"

namespace pin = pinocchio;
using Eigen::Vector3d;

namespace {

/// A serial chain of joints about their own z axes, the fastest kind.
pin::Model readChain(const std::string& path, pin::FrameIndex& tip) {
  std::vector<calls::Numbers> rows = calls::readRows(path);
  rows.resize(rows.size() - 2);  // the last ones are limits
  pin::Model model;
  pin::SE3 parent = pin::SE3::Identity();
  pin::JointIndex last = 0;
  for (std::size_t i = 0; i + 1 < rows.size(); ++i) {
    const Vector3d axis(rows[i].data()), point(rows[i].data() + 3);
    const pin::SE3 place(Eigen::Quaterniond::FromTwoVectors(Vector3d::UnitZ(), axis).toRotationMatrix(), point);
    last = model.addJoint(last, pin::JointModelRZ(), parent.actInv(place), "joint" + std::to_string(i));
    parent = place;
  }
  const pin::SE3 place(parent.rotation(), Vector3d(rows.back().data()));
  tip = model.addFrame(pin::Frame("tip", last, 0, parent.actInv(place), pin::OP_FRAME));
  return model;
}

}  // namespace

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  pin::FrameIndex tip;
  const pin::Model model = readChain(argv[1], tip);
  pin::Data data(model);
  std::vector<Eigen::VectorXd> joint_vectors;
  for (const calls::Numbers& numbers : calls::readRows(argv[2])) {
    joint_vectors.push_back(Eigen::VectorXd::Map(numbers.data(), Eigen::Index(numbers.size())));
  }
  pin::Data::Matrix6x J = pin::Data::Matrix6x::Zero(6, model.nv);
  const auto call = [&](std::size_t i) {
    J.setZero();
    pin::computeFrameJacobian(model, data, joint_vectors[i], tip, pin::LOCAL_WORLD_ALIGNED,
                              J);  // and the frame's placement
  };
  const auto answer = [&] {
    const Vector3d position = data.oMf[tip].translation();
    calls::Numbers numbers(position.begin(), position.end());
    for (const auto& row : J.rowwise()) numbers.insert(numbers.end(), row.begin(), row.end());
    return numbers;
  };
  calls::report(PINOCCHIO_VERSION, joint_vectors.size(), call, answer);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 1;
}
