#include "kinegraph/komo/continuous_collisions.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kinegraph/features/collisions.h"

namespace kinegraph {

namespace {

constexpr double kThrough = .01;   // m: what is so deep is not a corner that is cut
constexpr double kReserve = 5e-3;  // m, beyond what a solver aims at: pairs that come so near count from then on
constexpr double kSame = .1;       // share of the way: instants of a pair that are so near to each other say the same,
constexpr double kEqual = 1e-9;    // and are the same
constexpr double kMoved = .01;     // rad or m that a dof moves, at least, before a motion is looked at anew

/// The margin that the motion can keep.
double marginOf(const Objective& objective, int slice, SliceMotions& motions) {
  if (slice > 0 || objective.margin == 0.) return objective.margin;
  const double limit = objective.margin + 2. * kFreeTolerance, at_begin = motions.clearanceAtBegin(slice, limit);
  return at_begin < limit ? std::max(.5 * at_begin, 0.) : objective.margin;
}

int motionsOf(const Objective& objective) { return std::max(objective.to - objective.from + 1, 0); }

bool has(const std::vector<CollisionSample>& samples, const CollisionSample& one, double near) {
  return std::ranges::any_of(samples, [&](const CollisionSample& other) {
    return other.a == one.a && other.b == one.b && std::abs(other.share - one.share) <= near;
  });
}

/// In place of an empty one. False if there is none.
bool fill(std::vector<CollisionSample>& samples, const CollisionSample& one) {
  const auto empty = std::ranges::find_if(samples, &CollisionSample::isEmpty);
  if (empty == samples.end()) return false;
  *empty = one;
  return true;
}

void add(std::vector<CollisionSample>& samples, const CollisionSample& one) {
  if (!has(samples, one, kEqual) && !fill(samples, one)) samples.push_back(one);
}

/// What is too near on a motion: where it comes nearest on the way, else what was found at any time.
std::vector<MotionContact> violationsOf(SliceMotions& motions, int slice, double margin) {
  const std::optional<MotionContact> hit = motions.tooNear(slice, margin);
  if (!hit) return {};
  std::vector<MotionContact> found = motions.approaches(slice, margin + kFreeTolerance);
  if (found.empty()) found.push_back(*hit);
  return found;
}

double lackOf(const MotionContact& contact, double margin) {
  return std::max(margin + kFreeTolerance - contact.distance, kFreeTolerance);
}

/// Puts what was found in place of empty instants; what violates the margin also where there are others near to it. Was
/// there any? `lack` becomes the largest one.
bool fillWith(const std::vector<MotionContact>& found, double margin, std::vector<CollisionSample>& samples,
              double& lack) {
  bool any = false;
  for (const MotionContact& contact : found) {
    lack = std::max(lack, margin - contact.distance);
    const CollisionSample sample{contact.time, contact.a, contact.b};
    const double near = contact.distance < margin ? kEqual : kSame;
    if (!has(samples, sample, near)) any = fill(samples, sample) || any;
  }
  return any;
}

/// Where a motion goes right through something, the next one may do so a little earlier or later. So that it cannot,
/// the motions around it get instants in their middle, and then in the middle of these.
void guard(Objective& objective, int through, const MotionContact& contact) {
  const int count = int(objective.samples.size()), reach = std::max(2, count / 8);
  for (int i = std::max(through - reach, 0); i <= std::min(through + reach, count - 1); ++i) {
    std::vector<CollisionSample>& samples = objective.samples[std::size_t(i)];
    const auto at = [&](double share) { return CollisionSample{share, contact.a, contact.b}; };
    if (!has(samples, at(.5), 0.)) {
      add(samples, at(.5));
    } else {
      add(samples, at(.25));
      add(samples, at(.75));
    }
  }
}

}  // namespace

bool CheckedMotion::isFar(const SliceMotion& motion) const {
  const auto moved = [](const VectorXd& a, const VectorXd& b) { return (a - b).lpNorm<Eigen::Infinity>(); };
  return from.size() == 0 || std::max(moved(from, motion.from), moved(to, motion.to)) >= kMoved;
}

double farOf(const Objective& objective) {
  const double far = (objective.slack > 0. ? .5 : 1.) * PairCollisions::kFar,
               apart = objective.margin + objective.slack;
  return far + std::max(apart - .5 * far, 0.);
}

Refinement refinementOf(double lack) {
  constexpr double kMuch = .01;  // m: so deep a motion that is nearly free is not, but one through a wall
  return lack > kMuch ? Refinement::much : lack > 0. ? Refinement::little : Refinement::none;
}

double addSamples(Objective& objective, SliceMotions& motions) {
  double most = 0.;
  const int count = motionsOf(objective);
  objective.samples.resize(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const int slice = objective.from + i;
    const double margin = marginOf(objective, slice, motions);
    for (const MotionContact& contact : violationsOf(motions, slice, margin)) {
      const double lack = lackOf(contact, margin);
      most = std::max(most, lack);
      add(objective.samples[std::size_t(i)], {contact.time, contact.a, contact.b});
      if (lack > kThrough) guard(objective, i, contact);
    }
  }
  return most;
}

std::vector<Objective> withSamples(std::vector<Objective> objectives, const Path& path) {
  MotionProbe probe(kFreeTolerance);
  LinearSliceMotions lines(path, probe);
  for (Objective& objective : objectives) {
    if (objective.on_the_way) addSamples(objective, lines);
  }
  return objectives;
}

FilledSamples fillSamples(Objective& objective, SliceMotions& motions, bool is_solution,
                          std::vector<CheckedMotion>& looked_at) {
  FilledSamples filled;
  looked_at.resize(objective.samples.size());
  for (int i = 0; i < int(objective.samples.size()); ++i) {
    const int slice = objective.from + i;
    const SliceMotion motion = motions.motionInto(slice);
    CheckedMotion& last = looked_at[std::size_t(i)];
    if (!is_solution && !last.isFar(motion)) continue;
    const double margin = marginOf(objective, slice, motions);
    std::vector<MotionContact> found;
    if (is_solution) {
      found = violationsOf(motions, slice, margin);
      if (found.empty()) continue;
      for (const MotionContact& contact : found) filled.lack = std::max(filled.lack, lackOf(contact, margin));
    } else {
      last = {motion.from, motion.to};
    }
    const double reach = margin < objective.margin ? margin : margin + objective.slack + kReserve;
    std::ranges::copy(motions.approaches(slice, reach), std::back_inserter(found));
    if (fillWith(found, margin, objective.samples[std::size_t(i)], filled.lack)) filled.motions.push_back(i);
  }
  return filled;
}

void keepRoom(Objective& objective, int count) {
  objective.samples.resize(std::size_t(motionsOf(objective)));
  for (std::vector<CollisionSample>& samples : objective.samples) {
    const auto empty = std::ranges::count_if(samples, &CollisionSample::isEmpty);
    if (empty < count) samples.resize(samples.size() + std::size_t(count - empty));
  }
}

void addApproaches(Objective& objective, SliceMotions& motions, double most) {
  objective.samples.resize(std::size_t(motionsOf(objective)));
  for (std::size_t i = 0; i < objective.samples.size(); ++i) {
    for (const MotionContact& contact : motions.approaches(objective.from + int(i), most))
      add(objective.samples[i], {contact.time, contact.a, contact.b});
  }
}

}  // namespace kinegraph
