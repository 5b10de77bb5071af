#include "kinegraph/kinematics/state.h"

#include <gtest/gtest.h>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

/// A chain with one joint of every type, each on the previous one, with random constant transforms, and one frame on
/// every link. The second half of it mimics nothing; the last link mimics the first joint with scale -2.
struct Chain {
  std::shared_ptr<KinematicModel> model = std::make_shared<KinematicModel>();
  std::shared_ptr<Parameters> parameters = std::make_shared<Parameters>();
};

Chain makeChain(Rng& rng) {
  Chain chain;
  const auto random_transform = [&] {
    VectorXd numbers(7);
    for (double& x : numbers) x = .5 * rng.normal();
    return Pose::fromNumbers(numbers).transform();
  };
  KinematicModel& model = *chain.model;
  model.links.push_back({});
  const auto addLink = [&](const std::vector<MotionStep>& steps, int dof, double scale) {
    KinematicModel::Link link;
    link.parent = int(model.links.size()) - 1;
    link.first_step = int(model.steps.size());
    link.steps = int(steps.size());
    link.dof = dof;
    link.scale = scale;
    link.axis = Vector3d(1, 2, -1).normalized();
    model.steps.insert(model.steps.end(), steps.begin(), steps.end());
    model.links.push_back(link);
  };
  std::vector<double> home;
  for (const auto& [name, type] : jointTypeNames()) {
    const auto steps = motionSteps(type, "xYzAbc");
    if (steps.empty()) continue;
    addLink(steps, int(home.size()), rng.uniform(.5, 1.5));
    for (double x : motionIdentity(steps)) home.push_back(x);
  }
  addLink(motionSteps(JointType::hingeX), 0, -2.);
  for (std::size_t l = 0; l < model.links.size(); ++l) model.frame_link.push_back(int(l));
  model.dofs = int(home.size());
  model.home = Eigen::Map<VectorXd>(home.data(), model.dofs);
  connectChains(model);
  *chain.parameters = emptyParameters(model);
  for (std::size_t l = 0; l < model.links.size(); ++l) {
    if (l > 0) placeJoint(model, int(l), random_transform(), *chain.parameters);
    chain.parameters->frame_offset[l] = random_transform();
  }
  return chain;
}

}  // namespace

TEST(State, JacobiansEqualCentralDifferencesForEveryJointType) {
  Rng rng(4);
  const Chain chain = makeChain(rng);
  State state(chain.model, chain.parameters);
  const int n = state.dofs(), frames = int(chain.model->frame_link.size());
  for (int sample = 0; sample < 5; ++sample) {
    VectorXd q = chain.model->home;
    for (double& x : q) x += .3 * rng.normal();
    for (int frame = 0; frame < frames; ++frame) {
      const Vector3d point(.1, -.2, .3);
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J(6, n);
      J.setZero();
      state.setJoints(q.data());
      const Matrix3d R = state.pose(frame).R;
      state.addPointJacobian(frame, state.pose(frame) * point, 1., J.topRows(3));
      state.addAngularJacobian(frame, 1., J.bottomRows(3));
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> at_once(
          7, n + 1);  // surrounded by numbers that must not change
      at_once.setConstant(7.);
      state.jacobian(frame, state.pose(frame) * point, at_once.topLeftCorner(6, n));
      EXPECT_EQ(at_once.topLeftCorner(6, n), J) << "frame " << frame;
      EXPECT_TRUE((at_once.rightCols(1).array() == 7.).all() && (at_once.bottomRows(1).array() == 7.).all());
      for (int i = 0; i < n; ++i) {
        const double h = 1e-6;
        VectorXd plus = q, minus = q;
        plus[i] += h;
        minus[i] -= h;
        state.setJoints(plus.data());
        const RigidTransform up = state.pose(frame);
        state.setJoints(minus.data());
        const RigidTransform down = state.pose(frame);
        const Vector3d linear = (up * point - down * point) / (2 * h);
        const Matrix3d W = (up.R - down.R) / (2 * h) * R.transpose();
        const Vector3d angular(W(2, 1), W(0, 2), W(1, 0));
        EXPECT_LT((linear - J.col(i).head<3>()).norm(), 1e-7 * (1. + linear.norm()))
            << "frame " << frame << " dof " << i;
        EXPECT_LT((angular - J.col(i).tail<3>()).norm(), 1e-7 * (1. + angular.norm()))
            << "frame " << frame << " dof " << i;
      }
    }
  }
}

TEST(State, WeightedJacobianIsTheSumOfItsParts) {
  Rng rng(5);
  const Chain chain = makeChain(rng);
  State state(chain.model, chain.parameters);
  const int n = state.dofs(), frame = int(chain.model->frame_link.size()) - 1;
  const Vector3d p(.3, .2, .1);
  MatrixXd A(2, 3), B(2, 3);
  A << 1, 2, 3, 4, 5, 6;
  B << -1, 0, 2, 3, 1, 1;
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> J = MatrixXd::Zero(2, n),
                                                                         P = MatrixXd::Zero(3, n),
                                                                         W = MatrixXd::Zero(3, n);
  state.addJacobian(frame, p, A, B, J);
  state.addPointJacobian(frame, p, 1., P);
  state.addAngularJacobian(frame, 1., W);
  EXPECT_LT((J - A * P - B * W).norm(), 1e-12);
}
