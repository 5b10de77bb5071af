#include "kinegraph/features/masses.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/dynamics.h"

namespace kinegraph::inline features_internal {

namespace {

const FrameMass& massOf(const State& state, int frame) { return state.parameters().frame_mass[frame]; }

/// Returns the common center of mass of frames, or of everything that moves without frames, and adds its Jacobian times
/// `factor` to J. `caller` and the frame `of` (-1: none) are for messages.
Vector3d addCenterOfMass(const State& state, const std::vector<int>& frames, double factor, const char* caller, int of,
                         JacobianRows* J) {
  const auto forEach = [&](const auto& visit) {
    if (!frames.empty()) {
      for (int frame : frames) visit(frame, massOf(state, frame).mass);
      return;
    }
    for (std::size_t frame = 0; frame < state.parameters().frame_mass.size(); ++frame) {
      if (state.link(int(frame)) > 0) visit(int(frame), massOf(state, int(frame)).mass);
    }
  };
  double total = 0.;
  Vector3d moment = Vector3d::Zero();
  forEach([&](int frame, double mass) {
    if (mass == 0.) return;
    total += mass;
    moment += mass * frameCenterOfMass(state, frame);
  });
  if (!(total > 0.)) {
    const std::string whose = of < 0 ? "" : cat(" of '", state.model().frame_name[std::size_t(of)], "'");
    throw ValueError(cat(caller, whose, ": ", frames.empty() ? "nothing that moves" : "none of the frames listed",
                         " has a mass; give them `mass: ..` or call setMass"));
  }
  if (!J) return moment / total;
  forEach([&](int frame, double mass) {
    if (mass > 0.) state.addPointJacobian(frame, frameCenterOfMass(state, frame), factor * mass / total, *J);
  });
  return moment / total;
}

}  // namespace

void Energy::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const Eigen::RowVector3d none = Eigen::RowVector3d::Zero();
  y[0] = 0.;
  for (int frame : frames_) {
    const double known = massOf(*states[1], frame).mass, mass = known > 0. ? known : 1.;
    const Vector3d before = frameCenterOfMass(*states[0], frame), now = frameCenterOfMass(*states[1], frame),
                   velocity = (now - before) / tau;
    y[0] += mass * (.5 * velocity.squaredNorm() - kGravity.dot(now));
    if (!J) continue;
    const Eigen::RowVector3d momentum = mass / tau * velocity.transpose(), weight = mass * kGravity.transpose();
    const Eigen::Index n = J->cols() / 2;
    states[0]->addJacobian(frame, before, -momentum, none, J->leftCols(n));
    states[1]->addJacobian(frame, now, momentum - weight, none, J->rightCols(n));
  }
}

void CenterOfMass::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  y = addCenterOfMass(*states[0], frames_, 1., "centerOfMass", -1, J);
}

void CenterOfMassOffset::eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y,
                              JacobianRows* J) const {
  const State& state = *states[0];
  y = state.position(frame_) - addCenterOfMass(state, others_, -1., "EqCenterOfMass", frame_, J);
  if (J) state.addPointJacobian(frame_, state.position(frame_), 1., *J);
}

void FreeFlight::eval(std::span<const State* const> states, double tau, Eigen::Ref<VectorXd> y, JacobianRows* J) const {
  const Vector3d c[] = {frameCenterOfMass(*states[0], frame_), frameCenterOfMass(*states[1], frame_),
                        frameCenterOfMass(*states[2], frame_)};
  Vector3d before, now;
  y.head<3>() = (c[2] - 2. * c[1] + c[0]) / tau;
  y[2] += gravity_ * tau;
  if (!J) {
    angular_.eval(states.first(2), tau, before, nullptr);
    angular_.eval(states.last(2), tau, now, nullptr);
    y.tail<3>() = now - before;
    return;
  }
  const Eigen::Index n = J->cols() / 3;
  const double factor[] = {1. / tau, -2. / tau, 1. / tau};
  for (int i = 0; i < 3; ++i) states[i]->addPointJacobian(frame_, c[i], factor[i], J->block(0, i * n, 3, n));
  JacobianRows earlier = J->block(3, 0, 3, 2 * n), later = J->block(3, n, 3, 2 * n);
  angular_.eval(states.first(2), tau, before, &earlier);
  earlier *= -1.;
  angular_.eval(states.last(2), tau, now, &later);
  y.tail<3>() = now - before;
}

}  // namespace kinegraph::inline features_internal
