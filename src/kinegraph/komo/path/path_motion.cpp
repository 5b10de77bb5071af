#include "kinegraph/komo/path/path_motion.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/collision/displacement_bound.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Distance of a pair along a motion.
class PairDistance {
 public:
  PairDistance(const SliceMotion& motion, int a, int b)
      : motion_(motion), pair_(*motion.model, {{a, b}}), placed_(pair_), state_(motion.model, motion.parameters) {}

  double at(double s) {
    q_ = (1. - s) * motion_.from + s * motion_.to;
    state_.setJoints(q_.data());
    placed_.place(state_);
    return placed_.proximity(0).distance;
  }

  /// Bound on the relative speed of points of the two bodies, m per unit of s.
  double speed() const {
    DisplacementBound bounds(state_);
    bounds.setEdge(motion_.from.data(), motion_.to.data());
    const auto [a, b] = pair_.pairs[0];
    return bounds.relativeRates(linkOf(a), reachOf(a), linkOf(b), reachOf(b)).speed;
  }

 private:
  int linkOf(int body) const { return state_.link(pair_.frames[std::size_t(body)]); }

  double reachOf(int body) const {
    return bodyReach(state_, pair_.frames[std::size_t(body)], *pair_.bodies[std::size_t(body)]);
  }

  const SliceMotion& motion_;
  BodyPairs pair_;
  PlacedBodies placed_;
  State state_;
  VectorXd q_;
};

/// Returns the time after `start` at which the pair is closest: the best of several samples, refined by golden section
/// search.
std::pair<double, double> nearest(PairDistance& pair, double start) {
  constexpr int kSamples = 64, kSections = 25;
  constexpr double kGolden = .6180339887498949;
  const double step = (1. - start) / kSamples;
  double best = start, least = pair.at(start);
  const auto measure = [&](double s) {
    const double distance = pair.at(s);
    if (distance < least) {
      least = distance;
      best = s;
    }
    return distance;
  };
  for (int i = 1; i <= kSamples; ++i) measure(i == kSamples ? 1. : start + i * step);
  double low = std::max(best - step, start), high = std::min(best + step, 1.);
  double left = high - kGolden * (high - low), right = low + kGolden * (high - low);
  double of_left = measure(left), of_right = measure(right);
  for (int i = 0; i < kSections; ++i) {
    if (of_left < of_right) {
      high = std::exchange(right, left);
      of_right = of_left;
      of_left = measure(left = high - kGolden * (high - low));
    } else {
      low = std::exchange(left, right);
      of_left = of_right;
      of_right = measure(right = low + kGolden * (high - low));
    }
  }
  return {best, least};
}

/// Finds the first time at which a pair is closer than the margin, by conservative advancement with the speed bound.
/// Contacts less deep than the tolerance may be missed.
std::optional<MotionContact> firstContactOf(const SliceMotion& motion, std::pair<int, int> frames, double margin,
                                            double tolerance) {
  const auto [a, b] = frames;
  PairDistance pair(motion, a, b);
  const double speed = pair.speed();
  for (double s = 0.; s <= 1.;) {
    const double distance = pair.at(s);
    if (distance < margin) return MotionContact{s, a, b, distance};
    if (speed == 0.) break;
    s += std::max(distance - margin, tolerance) / speed;
  }
  const double at_end = pair.at(1.);
  return at_end < margin ? std::optional(MotionContact{1., a, b, at_end}) : std::nullopt;
}

PathContact describe(const SliceMotion& motion, const MotionContact& contact) {
  PairDistance pair(motion, contact.a, contact.b);
  const auto [deepest, distance] = nearest(pair, contact.time);
  const auto timeOf = [&](double s) { return motion.begin + s * (motion.end - motion.begin); };
  const std::vector<std::string>& names = motion.model->frame_name;
  return {motion.slice, timeOf(contact.time), names[std::size_t(contact.a)], names[std::size_t(contact.b)],
          distance,     timeOf(deepest)};
}

}  // namespace

std::vector<int> komo_internal::sameDofs(const Path& path, int slice) {
  const KinematicModel &before = path.state(slice - 1).model(), &now = path.state(slice).model();
  std::vector<int> same(std::size_t(before.dofs), -1);
  const bool one_mode = &before == &now;
  for (std::size_t frame = 0; frame < before.frame_dofs.size(); ++frame) {
    const auto [first, count] = before.frame_dofs[frame];
    const auto [first_now, count_now] = now.frame_dofs[frame];
    if (count != count_now) continue;
    const auto joint = [&](int t) {
      if (path.modes().empty()) return 0;
      const auto& added = path.mode(t).added;
      const auto place = added.find(int(frame));
      return place == added.end() ? 0 : place->second.id;
    };
    if (!one_mode && joint(slice - 1) != joint(slice)) continue;
    for (int i = 0; i < count; ++i) same[std::size_t(first + i)] = first_now + i;
  }
  return same;
}

int komo_internal::firstMotion(const Path& path) { return path.grid().order() > 0 ? 0 : 1; }

SliceMotion komo_internal::motionInto(const Path& path, int slice) {
  const State &before = path.state(slice - 1), &now = path.state(slice);
  SliceMotion motion{slice,
                     path.grid().timeOf(slice - 1),
                     path.grid().timeOf(slice),
                     before.sharedModel(),
                     before.sharedParameters(),
                     before.q(),
                     before.q()};
  if (&before.model() == &now.model()) {
    motion.to = now.q();
    return motion;
  }
  const std::vector<int> same = sameDofs(path, slice);
  for (std::size_t dof = 0; dof < same.size(); ++dof) {
    if (same[dof] >= 0) motion.to[Eigen::Index(dof)] = now.q()[same[dof]];
  }
  return motion;
}

std::vector<SliceMotion> komo_internal::motionsOf(const Path& path) {
  std::vector<SliceMotion> motions;
  for (int slice = firstMotion(path); slice < path.grid().slices(); ++slice) motions.push_back(motionInto(path, slice));
  return motions;
}

MotionProbe::Scene::Scene(const SliceMotion& motion, double tolerance)
    : model(motion.model), parameters(motion.parameters), checker(State(model, parameters), 0., tolerance) {}

EdgeChecker& MotionProbe::checkerOf(const SliceMotion& motion) {
  if (!scene_ || scene_->model != motion.model || scene_->parameters != motion.parameters)
    scene_ = std::make_unique<Scene>(motion, tolerance_);
  return scene_->checker;
}

std::optional<MotionContact> MotionProbe::firstContact(const SliceMotion& motion, double margin) {
  std::optional<MotionContact> first = motion.all_pairs ? firstOfAllPairs(motion, margin) : std::nullopt;
  for (const auto& pair : motion.pairs) {
    const std::optional<MotionContact> contact = firstContactOf(motion, pair, margin, tolerance_);
    if (contact && (!first || contact->time < first->time)) first = contact;
  }
  return first;
}

std::optional<MotionContact> MotionProbe::firstOfAllPairs(const SliceMotion& motion, double margin) {
  EdgeChecker& checker = checkerOf(motion);
  checker.setMargin(margin);
  const double *from = motion.from.data(), *to = motion.to.data();
  if (checker.isFree(from, to)) return std::nullopt;
  const std::optional<MotionContact> hit = checker.lastHit();
  const std::optional<MotionContact> first = checker.firstContact(from, to);
  return first ? first : hit;
}

bool MotionProbe::isFree(const SliceMotion& motion, double margin) {
  EdgeChecker& checker = checkerOf(motion);
  checker.forget();
  checker.setMargin(margin);
  return checker.isFree(motion.from.data(), motion.to.data());
}

const std::vector<MotionContact>& MotionProbe::approaches(const SliceMotion& motion, double max_distance) {
  EdgeChecker& checker = checkerOf(motion);
  checker.forget();
  return checker.approaches(motion.from.data(), motion.to.data(), max_distance);
}

double MotionProbe::clearance(const SliceMotion& motion, double time, double max_distance) {
  const VectorXd q = (1. - time) * motion.from + time * motion.to;
  return checkerOf(motion).clearance(q.data(), max_distance);
}

std::string PathContact::str() const {
  const double mm = std::round(-1e5 * distance) / 100.;
  const std::string pair = cat("'", a, "' and '", b, "' ");
  const std::string how = distance < 0. ? cat("overlap by ", mm, " mm") : cat("come within ", -mm, " mm");
  return cat(pair, how, " at phase time ", std::round(1e4 * deepest) / 1e4, ", between slices ", slice - 1, " and ",
             slice);
}

std::vector<PathContact> komo_internal::contactsOf(const std::vector<SliceMotion>& motions, double margin,
                                                   double tolerance, const CancellationToken& cancellation) {
  std::vector<PathContact> contacts;
  MotionProbe probe(tolerance);
  for (const SliceMotion& motion : motions) {
    cancellation.check();
    if (const auto contact = probe.firstContact(motion, margin)) contacts.push_back(describe(motion, *contact));
  }
  return contacts;
}

}  // namespace kinegraph
