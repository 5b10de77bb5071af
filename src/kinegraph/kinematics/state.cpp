#include "kinegraph/kinematics/state.h"

#include <algorithm>

#include "kinegraph/kinematics/state_kernel.h"

namespace kinegraph::inline kinematics_internal {

State::State(std::shared_ptr<const KinematicModel> model, std::shared_ptr<const Parameters> parameters)
    : model_(std::move(model)),
      parameters_(std::move(parameters)),
      q_(model_->home),
      link_pose_(model_->links.size() + 1),
      twists_(model_->column_dof.size() + 1),
      sines_cosines_(model_->angle_dof.size()) {
  update();
}

void State::setJoints(const double* q) {
  q_ = Eigen::Map<const VectorXd>(q, model_->dofs);
  update();
}

void State::setParameters(std::shared_ptr<const Parameters> parameters) {
  parameters_ = std::move(parameters);
  update();
}

void State::update() {
  static_assert(sizeof(RigidTransform) == 12 * sizeof(double) && sizeof(Twist) == 6 * sizeof(double) &&
                sizeof(SineCosine) == 2 * sizeof(double));
  static const UpdateState kernel = stateKernel();
  const KinematicModel& model = *model_;
  const Parameters& parameters = *parameters_;
  kernel({parameters.link.data(), int(parameters.link.size()), parameters.step.data(), model.angle_dof.data(),
          parameters.angle_factor.data(), int(model.angle_dof.size()), q_.data(),
          reinterpret_cast<double*>(sines_cosines_.data()), link_pose_[0].R.data(),
          reinterpret_cast<double*>(twists_.data())});
}

namespace {

/// Clears the columns [from, to). Separate because it is rarely needed.
[[gnu::noinline]] void clearColumns(double* rows, Eigen::Index stride, int from, int to) {
  for (int r = 0; r < 6; ++r) std::fill(rows + r * stride + from, rows + r * stride + to, 0.);
}

}  // namespace

void State::jacobian(int frame, const Vector3d& p_WQ, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  const double x = p_WQ[0], y = p_WQ[1], z = p_WQ[2];
  const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
  const Twist* twists = twists_.data();
  int done = dofs();  // entries from here on are written; dofs mostly descend along a chain, and those in between are
                      // zero
  for (int c = model_->last_column[link(frame)]; c >= 0; c = before[c]) {
    if (dof[c] >= done) {
      J.setZero();
      addPointJacobian(frame, p_WQ, 1., J.topRows(3));
      addAngularJacobian(frame, 1., J.bottomRows(3));
      return;
    }
    if (dof[c] + 1 < done) clearColumns(rows, stride, dof[c] + 1, done);
    done = dof[c];
    const double *w = twists[c].angular.data(), *v = twists[c].linear.data();
    double* to = rows + done;
    to[0] = v[0] + (w[1] * z - w[2] * y);
    to[stride] = v[1] + (w[2] * x - w[0] * z);
    to[2 * stride] = v[2] + (w[0] * y - w[1] * x);
    to[3 * stride] = w[0];
    to[4 * stride] = w[1];
    to[5 * stride] = w[2];
  }
  if (done > 0) clearColumns(rows, stride, 0, done);
}

void State::addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  const double x = p_WQ[0], y = p_WQ[1], z = p_WQ[2];
  const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
  const Twist* twists = twists_.data();
  for (int c = model_->last_column[link(frame)]; c >= 0; c = before[c]) {
    const double *w = twists[c].angular.data(), *v = twists[c].linear.data();
    const double dx = factor * (v[0] + (w[1] * z - w[2] * y)), dy = factor * (v[1] + (w[2] * x - w[0] * z)),
                 dz = factor * (v[2] + (w[0] * y - w[1] * x));
    double* to = rows + dof[c];
    to[0] += dx;
    to[stride] += dy;
    to[2 * stride] += dz;
  }
}

void State::addAngularJacobian(int frame, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
  const Twist* twists = twists_.data();
  for (int c = model_->last_column[link(frame)]; c >= 0; c = before[c]) {
    const double* w = twists[c].angular.data();
    const double dx = factor * w[0], dy = factor * w[1], dz = factor * w[2];
    double* to = rows + dof[c];
    to[0] += dx;
    to[stride] += dy;
    to[2 * stride] += dz;
  }
}

/// `velocity(twist)` is the velocity of the point or direction.
template <class Velocity>
void State::addCurvature(int frame, const Velocity& velocity, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const {
  const int *before = model_->column_before.data(), *dof = model_->column_dof.data();
  const Twist* twists = twists_.data();
  double* entries = H.data();
  const Eigen::Index stride = H.outerStride();
  for (int d = model_->last_column[link(frame)]; d >= 0; d = before[d]) {
    const Vector3d moment = velocity(twists[d]).cross(weight);
    const double x = moment[0], y = moment[1], z = moment[2];
    const int j = dof[d];
    const auto power = [=](int c) {
      const double* w = twists[c].angular.data();
      return w[0] * x + w[1] * y + w[2] * z;
    };
    entries[j * stride + j] += power(d);
    for (int c = before[d]; c >= 0; c = before[c]) {
      const int i = dof[c];
      const double value = power(c);
      entries[i < j ? i * stride + j : j * stride + i] += i == j ? 2. * value : value;  // mimicking joints share a dof
    }
  }
}

void State::addPointCurvature(int frame, const Vector3d& p_WQ, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const {
  addCurvature(
      frame, [&p_WQ](const Twist& twist) -> Vector3d { return twist.linear + twist.angular.cross(p_WQ); }, weight, H);
}

void State::addDirectionCurvature(int frame, const Vector3d& u, const Vector3d& weight, Eigen::Ref<MatrixXd> H) const {
  addCurvature(
      frame, [&u](const Twist& twist) -> Vector3d { return twist.angular.cross(u); }, weight, H);
}

}  // namespace kinegraph::inline kinematics_internal
