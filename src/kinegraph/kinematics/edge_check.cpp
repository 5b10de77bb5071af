#include "kinegraph/kinematics/edge_check.h"

#include <algorithm>

namespace kinegraph {

EdgeChecker::EdgeChecker(const State& scene, double margin, double tolerance)
    : state_(scene),
      margin_(margin),
      tolerance_(tolerance),
      pairs_(scene.program(), scene.program().movingPairs()),
      bodies_(pairs_),
      motions_(scene) {}

bool EdgeChecker::isFree(const double* q) {
  last_hit_.reset();
  state_.setJoints(q);
  bodies_.place(state_);
  const auto hits = [&](int pair) {
    if (!bodies_.mayBeNear(pair, margin_)) return false;
    const double distance = bodies_.proximity(pair).distance;
    if (!(distance < margin_)) return false;
    const auto [a, b] = pairs_.pairs[std::size_t(pair)];
    last_hit_ = MotionContact{0., pairs_.frames[std::size_t(a)], pairs_.frames[std::size_t(b)], distance};
    suspect_ = pair;
    return true;
  };
  if (suspect_ >= 0 && hits(suspect_)) return false;
  for (int pair = 0; pair < bodies_.pairs(); ++pair) {
    if (pair != suspect_ && hits(pair)) return false;
  }
  return true;
}

bool EdgeChecker::isFree(const double* from, const double* to) {
  if (!isFree(to)) {
    last_hit_->time = 1.;
    return false;
  }
  last_hit_ = firstContact(from, to);
  return !last_hit_;
}

std::optional<MotionContact> EdgeChecker::firstContact(const double* from, const double* to) {
  return motions_.firstContact(from, to, margin_, tolerance_);
}

double EdgeChecker::clearance(const double* q, double most) {
  state_.setJoints(q);
  bodies_.place(state_);
  for (int pair = 0; pair < bodies_.pairs(); ++pair) {
    if (bodies_.mayBeNear(pair, most)) most = std::min(most, bodies_.proximity(pair).distance);
  }
  return most;
}

double EdgeChecker::clearance(const double* from, const double* to, double most) {
  double high = std::min({most, clearance(from, most), clearance(to, most)}), low = high - tolerance_;
  for (double step = .01; motions_.firstContact(from, to, low, .5 * tolerance_); step *= 2.) {
    high = low;
    low -= step;
  }
  if (high == most && !motions_.firstContact(from, to, most, .5 * tolerance_)) return most;
  while (high - low > .5 * tolerance_) {
    const double middle = .5 * (low + high);
    (motions_.firstContact(from, to, middle, .5 * tolerance_) ? high : low) = middle;
  }
  return low;
}

}  // namespace kinegraph
