#include "kinegraph/kinematics/state.h"

#include "kinegraph/kinematics/place_links.h"

namespace kinegraph {

namespace {

using lanes::Packed3;

/// Writes the twists of a step where they belong.
struct TwistWriter {
  State::Twist* twist;

  void turns(int k, const Packed3& angular, const Packed3& point) const {
    lanes::store(angular, twist[k].angular.data());
    lanes::store(cross(point, angular), twist[k].linear.data());
  }
  void slides(int k, const Packed3& velocity) const {
    twist[k].angular.setZero();
    lanes::store(velocity, twist[k].linear.data());
  }
  void rests(int k) const {
    twist[k].angular.setZero();
    twist[k].linear.setZero();
  }
};

}  // namespace

State::State(std::shared_ptr<const Program> program, std::shared_ptr<const Parameters> parameters)
    : program_(std::move(program)),
      parameters_(std::move(parameters)),
      q_(program_->home),
      link_pose_(program_->links.size()),
      twists_(program_->column_dof.size()),
      turns_(program_->turn_dof.size()) {
  update();
}

void State::setJoints(const double* q) {
  q_ = Eigen::Map<const VectorXd>(q, program_->dofs);
  update();
}

void State::setParameters(std::shared_ptr<const Parameters> parameters) {
  parameters_ = std::move(parameters);
  update();
}

void State::update() {
  static_assert(sizeof(RigidTransform) == lanes::kPerPlace * sizeof(double));
  using Pair = lanes::Pack<2>;
  const Program& program = *program_;
  for (std::size_t i = 0; i < program.turn_dof.size(); i += 2) {
    const Pair angles = {program.turn_factor[i] * q_[program.turn_dof[i]], program.turn_factor[i + 1] * q_[program.turn_dof[i + 1]]};
    Pair sines, cosines;
    if (lanes::magnitude(angles[0]) <= lanes::kMostAngle && lanes::magnitude(angles[1]) <= lanes::kMostAngle) {
      lanes::sineAndCosine(angles, sines, cosines);
    } else {
      lanes::sineAndCosineOfAny(angles, sines, cosines);
    }
    for (int k = 0; k < 2; ++k) turns_[i + k] = {sines[k], cosines[k]};
  }
  const Turn* turn = turns_.data();
  Packed3 pose[4];  // of the link before, by columns; what has just been written in parts is slow to read as a whole
  for (int k = 0; k < 4; ++k) load(link_pose_[0].R.data() + 3 * k, pose[k]);
  for (int l = 1; l < int(program.links.size()); ++l) {
    const Program::Link& link = program.links[l];
    const JointBase& base = parameters_->joint_base[l];
    if (link.parent != l - 1) {
      for (int k = 0; k < 4; ++k) load(link_pose_[link.parent].R.data() + 3 * k, pose[k]);
    }
    auto X = lanes::movedBy<Packed3>([&pose](int k) { return pose[k]; }, base.turn, base.R.data(), base.p.data());
    const double* q = q_.data() + link.dof;
    TwistWriter sink{twists_.data() + link.first_column};
    for (int s = link.first_step; s < link.first_step + link.steps; ++s) {
      const MotionStep& step = program.steps[s];
      lanes::moveBy(step.kind, step.axis, step.sign * link.scale, link.axis.data(), q, [&](double) { return *turn++; }, X, sink);
      q += step.dofs();
      sink.twist += step.dofs();
    }
    lanes::storePlace(X, link_pose_[l].R.data());
    for (int k = 0; k < 3; ++k) pose[k] = X.R[k];
    pose[3] = X.p;
  }
}

void State::addPointJacobian(int frame, const Vector3d& p_WQ, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  const double x = p_WQ[0], y = p_WQ[1], z = p_WQ[2];
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const double* w = twists_[c].angular.data();
    const double* v = twists_[c].linear.data();
    double* to = rows + program_->column_dof[c];
    to[0] += factor * (v[0] + (w[1] * z - w[2] * y));
    to[stride] += factor * (v[1] + (w[2] * x - w[0] * z));
    to[2 * stride] += factor * (v[2] + (w[0] * y - w[1] * x));
  }
}

void State::addAngularJacobian(int frame, double factor, JacobianRows J) const {
  double* rows = J.data();
  const Eigen::Index stride = J.outerStride();
  for (int c = program_->last_column[link(frame)]; c >= 0; c = program_->column_before[c]) {
    const double* w = twists_[c].angular.data();
    double* to = rows + program_->column_dof[c];
    to[0] += factor * w[0];
    to[stride] += factor * w[1];
    to[2 * stride] += factor * w[2];
  }
}

}  // namespace kinegraph
