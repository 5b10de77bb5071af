#pragma once

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/planning/plan_motion.h"

namespace kinegraph {

/// A disc of radius .2 that moves in a plane, and a box of .4 that is no part of q.
inline Config discAndBox() {
  Config C;
  C.addText(R"(
world: {}
disc(world): {joint: transXY, limits: [-2, -2, 2, 2]}
body(disc): {shape: cylinder, size: [0.2, 0.2], contact: 1}
cart: {}
box(cart): {shape: ssBox, size: [0.4, 0.4, 0.2, 0.01], contact: 1}
)");
  C.setJointState(VectorXd{{-1., 0.}});
  return C;
}

inline VectorXd poseAt(double x, double y, double angle = 0.) {
  return VectorXd{{x, y, 0., std::cos(.5 * angle), 0., 0., std::sin(.5 * angle)}};
}

/// A frame that is at these poses at these times.
inline ObstacleTrajectory moves(const std::string& frame, const std::vector<std::pair<double, VectorXd>>& track) {
  ObstacleTrajectory obstacle{frame, VectorXd(Eigen::Index(track.size())),
                              MatrixXd(Eigen::Index(track.size()), track.front().second.size())};
  for (std::size_t i = 0; i < track.size(); ++i) {
    obstacle.times[Eigen::Index(i)] = track[i].first;
    obstacle.values.row(Eigen::Index(i)) = track[i].second.transpose();
  }
  return obstacle;
}

/// The least distance of the disc and any obstacle every `step` s of the motion, and for a while after it. Places the
/// obstacles independently: linear interpolation of poses, with normalized quaternions, and of joints.
inline double leastOfTime(Config C, const MotionPlan& plan, const std::vector<ObstacleTrajectory>& obstacles,
                          double step, double after = 3.) {
  double least = 1.;
  for (double t = 0.; t <= plan.duration() + after; t += step) {
    for (const ObstacleTrajectory& obstacle : obstacles) {
      Eigen::Index k = 0;
      while (k + 1 < obstacle.times.size() && obstacle.times[k + 1] <= t) ++k;
      VectorXd values = obstacle.values.row(k).transpose();
      if (k + 1 < obstacle.times.size() && t > obstacle.times[k]) {
        const double share = (t - obstacle.times[k]) / (obstacle.times[k + 1] - obstacle.times[k]);
        VectorXd next = obstacle.values.row(k + 1).transpose();
        if (values.size() == 7 && values.tail<4>().dot(next.tail<4>()) < 0.) next.tail<4>() *= -1.;
        values += share * (next - values);
      }
      Frame frame = C.getFrame(obstacle.frame);
      values.size() == 7 ? frame.setPose(Pose::fromNumbers(values)) : frame.setJointState(values);
    }
    C.setJointState(plan.eval(t).q);
    const int body = C.getFrame("body").id();
    for (const Config::NearPair& pair : C.getCollisions(.5))
      if (pair.a == body || pair.b == body) least = std::min(least, pair.distance);
  }
  return least;
}

/// Checks every `step` s that position and velocity are continuous and that limits hold.
inline void expectSmooth(const MotionPlan& plan, double velocity, double acceleration, double step = 1e-3) {
  MotionState before = plan.eval(0.);
  for (double t = step; t <= plan.duration(); t += step) {
    const MotionState now = plan.eval(t);
    ASSERT_LE((now.q - before.q).cwiseAbs().maxCoeff(), velocity * step * (1. + 1e-9) + 1e-12) << t;
    ASSERT_LE((now.velocity - before.velocity).cwiseAbs().maxCoeff(), acceleration * step * (1. + 1e-9) + 1e-9) << t;
    ASSERT_LE(now.velocity.cwiseAbs().maxCoeff(), velocity * (1. + 1e-9)) << t;
    before = now;
  }
}

}  // namespace kinegraph
