#include "kinegraph/task_planning/motions/contact_speed.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kSlowUpTo = .05, kFastFrom = .07;  ///< m: distances of a hand from its contact point
constexpr double kRounding = 1e-7;                  ///< relative, of accelerations

/// The hand that takes or leaves something at the end of an action; "" if there is none.
std::string handInContact(const TaskAction& action) {
  if (isPick(action) || isHold(action) || isGuided(action)) return action[3];
  if (isPlace(action)) return action[2];
  return !action.empty() && action[0] == "handover" ? action[3] : "";
}

/// A motion in pieces between waypoints, whose durations are stretched: w is the square of the rate at which the old
/// time passes.
class Stretching {
 public:
  Stretching(const MatrixXd& path, const VectorXd& times, const MatrixXd& limits)
      : count_(path.rows() - 1),
        steps_(times.tail(count_) - times.head(count_)),
        velocities_((path.bottomRows(count_) - path.topRows(count_)).array().colwise() / steps_.array()),
        accelerations_(accelerationsAt(VectorXd::Ones(count_))),
        most_(accelerations_.cwiseAbs().array().max(limits.row(1).replicate(count_ - 1, 1).array())) {}

  /// The largest w up to `caps` whose slope keeps a share of the limits of acceleration.
  VectorXd squaredRates(VectorXd w, double share) const {
    for (Eigen::Index k = count_ - 2; k >= 0; --k) w[k] = std::min(w[k], w[k + 1] + change(k, w[k + 1], -1., share));
    for (Eigen::Index k = 0; k + 1 < count_; ++k) w[k + 1] = std::min(w[k + 1], w[k] + change(k, w[k], 1., share));
    return w;
  }

  VectorXd steps(const VectorXd& w) const { return steps_.array() / w.array().sqrt(); }

  bool keepsLimits(const VectorXd& w) const {
    return (accelerationsAt(w).cwiseAbs().array() <= (1. + kRounding) * most_.array()).all();
  }

 private:
  /// The largest change of w from piece k to the next (`sign` 1), or from the next one to it (-1).
  double change(Eigen::Index k, double w, double sign, double share) const {
    double slope = std::numeric_limits<double>::infinity();
    for (Eigen::Index j = 0; j < velocities_.cols(); ++j) {
      const double v = .5 * (velocities_(k, j) + velocities_(k + 1, j));
      const double along = (v < 0. ? -sign : sign) * accelerations_(k, j) * w;
      if (v != 0.) slope = std::min(slope, 2. * std::max(share * most_(k, j) - along, 0.) / std::abs(v));
    }
    return slope * .5 * (steps_[k] + steps_[k + 1]);
  }

  MatrixXd accelerationsAt(const VectorXd& w) const {
    const VectorXd steps = this->steps(w);
    const MatrixXd v = velocities_.array().colwise() * w.array().sqrt();
    const VectorXd between = .5 * (steps.head(count_ - 1) + steps.tail(count_ - 1));
    return (v.bottomRows(count_ - 1) - v.topRows(count_ - 1)).array().colwise() / between.array();
  }

  const Eigen::Index count_;
  const VectorXd steps_;
  const MatrixXd velocities_, accelerations_, most_;
};

}  // namespace

std::vector<ContactPoint> contactPoints(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                        const TaskAction& action, const TaskAction& before) {
  std::vector<ContactPoint> points;
  Config scene = C;
  for (const auto& [hand, q] : {std::pair(handInContact(before), q0), std::pair(handInContact(action), q1)}) {
    if (hand.empty()) continue;
    scene.setJointState(q);
    points.push_back({hand, scene.getFrame(hand).getPosition()});
  }
  return points;
}

VectorXd slowerNearContacts(const Config& C, const MatrixXd& path, const VectorXd& times, const MatrixXd& limits,
                            const std::vector<ContactPoint>& points, double speed) {
  const Eigen::Index count = path.rows() - 1;
  if (count < 2 || points.empty() || !std::isfinite(speed)) return times;
  VectorXd caps = VectorXd::Ones(count);
  for (const ContactPoint& point : points) {
    const std::vector<Vector3d> at = positionsAlong(C, path, point.hand);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector3d &a = at[std::size_t(k)], &b = at[std::size_t(k + 1)];
      const double near = (kFastFrom - (.5 * (a + b) - point.at).norm()) / (kFastFrom - kSlowUpTo);
      const double excess = (b - a).norm() / ((times[k + 1] - times[k]) * speed);
      if (near > 0. && excess > 1.)
        caps[k] = std::min(caps[k], 1. / (1. + std::min(near, 1.) * (excess * excess - 1.)));
    }
  }
  const Stretching stretching(path, times, limits);
  const auto stretched = [&](const VectorXd& w) {
    VectorXd later = times;
    const VectorXd steps = stretching.steps(w);
    for (Eigen::Index k = 0; k < count; ++k) later[k + 1] = later[k] + steps[k];
    return later;
  };
  for (const double share : {1., .98, .95, .9, .75, .5}) {
    const VectorXd w = stretching.squaredRates(caps, share);
    if (w.minCoeff() > 0. && stretching.keepsLimits(w)) return stretched(w);
  }
  return stretched(VectorXd::Constant(count, caps.minCoeff()));  // all of it is slower, and keeps all limits
}

}  // namespace kinegraph::inline task_planning_internal
