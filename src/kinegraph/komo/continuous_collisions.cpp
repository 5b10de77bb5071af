#include "kinegraph/komo/continuous_collisions.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "kinegraph/features/collisions.h"

namespace kinegraph::inline komo_internal {

namespace {

constexpr double kDeep = .01;      // m: a deeper contact is a motion through an obstacle, not a cut corner
constexpr double kReserve = 5e-3;  // m beyond the distance that a solver aims for: closer pairs get a sample
constexpr double kSame = .1;       // fraction of a motion: samples of a pair closer in time than this are redundant,
constexpr double kEqual = 1e-9;    // and closer than this are identical
constexpr double kMoved = .01;     // rad or m that a dof must move before its motion is checked again

/// Returns the margin that the motion can satisfy.
double marginOf(const Objective& objective, int slice, SliceMotions& motions) {
  if (slice > 0 || objective.margin == 0.) return objective.margin;
  const double limit = objective.margin + 2. * kFreeTolerance, at_begin = motions.clearanceAtBegin(slice, limit);
  return at_begin < limit ? std::max(.5 * at_begin, 0.) : objective.margin;
}

int motionsOf(const Objective& objective) { return std::max(objective.to - objective.from + 1, 0); }

bool has(const std::vector<CollisionSample>& samples, const CollisionSample& one, double near) {
  return std::ranges::any_of(samples, [&](const CollisionSample& other) {
    return other.a == one.a && other.b == one.b && std::abs(other.time - one.time) <= near;
  });
}

/// Replaces an empty sample. Returns false if there is none.
bool fill(std::vector<CollisionSample>& samples, const CollisionSample& one) {
  const auto empty = std::ranges::find_if(samples, &CollisionSample::isEmpty);
  if (empty == samples.end()) return false;
  *empty = one;
  return true;
}

void add(std::vector<CollisionSample>& samples, const CollisionSample& one) {
  if (!has(samples, one, kEqual) && !fill(samples, one)) samples.push_back(one);
}

/// Returns the contacts of a motion that violate the margin: the closest approaches if any were found, otherwise the
/// contact found by the continuous check.
std::vector<MotionContact> violationsOf(SliceMotions& motions, int slice, double margin) {
  const std::optional<MotionContact> hit = motions.tooNear(slice, margin);
  if (!hit) return {};
  std::vector<MotionContact> found = motions.approaches(slice, margin + kFreeTolerance);
  if (found.empty()) found.push_back(*hit);
  return found;
}

double violationOf(const MotionContact& contact, double margin) {
  return std::max(margin + kFreeTolerance - contact.distance, kFreeTolerance);
}

/// Fills empty samples with the contacts. Contacts that violate the margin are added even if a sample is close in time.
/// Returns true if a sample was filled. Raises `violation` to the largest one.
bool fillWith(const std::vector<MotionContact>& found, double margin, std::vector<CollisionSample>& samples,
              double& violation) {
  bool any = false;
  for (const MotionContact& contact : found) {
    violation = std::max(violation, margin - contact.distance);
    const CollisionSample sample{contact.time, contact.a, contact.b};
    const double near = contact.distance < margin ? kEqual : kSame;
    if (!has(samples, sample, near)) any = fill(samples, sample) || any;
  }
  return any;
}

/// A motion through an obstacle could move its collision to an adjacent motion. The motions around it therefore get
/// samples in their middle, and at the second time in the middle of each half.
void guard(Objective& objective, int motion, const MotionContact& contact) {
  const int count = int(objective.samples.size()), reach = std::max(2, count / 8);
  for (int i = std::max(motion - reach, 0); i <= std::min(motion + reach, count - 1); ++i) {
    std::vector<CollisionSample>& samples = objective.samples[std::size_t(i)];
    const auto at = [&](double time) { return CollisionSample{time, contact.a, contact.b}; };
    if (!has(samples, at(.5), 0.)) {
      add(samples, at(.5));
    } else {
      add(samples, at(.25));
      add(samples, at(.75));
    }
  }
}

}  // namespace

bool CheckedMotion::hasMoved(const SliceMotion& motion) const {
  const auto moved = [](const VectorXd& a, const VectorXd& b) { return (a - b).lpNorm<Eigen::Infinity>(); };
  return from.size() == 0 || std::max(moved(from, motion.from), moved(to, motion.to)) >= kMoved;
}

double cutoffDistance(const Objective& objective) {
  const double far = (objective.slack > 0. ? .5 : 1.) * PairCollisions::kFar,
               apart = objective.margin + objective.slack;
  return far + std::max(apart - .5 * far, 0.);
}

Refinement refinementOf(double violation) {
  constexpr double kMuch = .01;  // m: deeper than any almost collision-free motion, but not than one through a wall
  return violation > kMuch ? Refinement::much : violation > 0. ? Refinement::little : Refinement::none;
}

double addSamples(Objective& objective, SliceMotions& motions) {
  double largest = 0.;
  const int count = motionsOf(objective);
  objective.samples.resize(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const int slice = objective.from + i;
    const double margin = marginOf(objective, slice, motions);
    for (const MotionContact& contact : violationsOf(motions, slice, margin)) {
      const double violation = violationOf(contact, margin);
      largest = std::max(largest, violation);
      add(objective.samples[std::size_t(i)], {contact.time, contact.a, contact.b});
      if (violation > kDeep) guard(objective, i, contact);
    }
  }
  return largest;
}

std::vector<Objective> withSamples(std::vector<Objective> objectives, const Path& path) {
  MotionProbe probe(kFreeTolerance);
  LinearSliceMotions lines(path, probe);
  for (Objective& objective : objectives) {
    if (objective.between_slices) addSamples(objective, lines);
  }
  return objectives;
}

FilledSamples fillSamples(Objective& objective, SliceMotions& motions, bool is_solution,
                          std::vector<CheckedMotion>& checked) {
  FilledSamples filled;
  checked.resize(objective.samples.size());
  for (int i = 0; i < int(objective.samples.size()); ++i) {
    const int slice = objective.from + i;
    const SliceMotion motion = motions.motionInto(slice);
    CheckedMotion& last = checked[std::size_t(i)];
    if (!is_solution && !last.hasMoved(motion)) continue;
    const double margin = marginOf(objective, slice, motions);
    std::vector<MotionContact> found;
    if (is_solution) {
      found = violationsOf(motions, slice, margin);
      if (found.empty()) continue;
      for (const MotionContact& contact : found)
        filled.violation = std::max(filled.violation, violationOf(contact, margin));
    } else {
      last = {motion.from, motion.to};
    }
    const double reach = margin < objective.margin ? margin : margin + objective.slack + kReserve;
    std::ranges::copy(motions.approaches(slice, reach), std::back_inserter(found));
    if (fillWith(found, margin, objective.samples[std::size_t(i)], filled.violation)) filled.motions.push_back(i);
  }
  return filled;
}

void reserveSamples(Objective& objective, int count) {
  objective.samples.resize(std::size_t(motionsOf(objective)));
  for (std::vector<CollisionSample>& samples : objective.samples) {
    const auto empty = std::ranges::count_if(samples, &CollisionSample::isEmpty);
    if (empty < count) samples.resize(samples.size() + std::size_t(count - empty));
  }
}

void addApproaches(Objective& objective, SliceMotions& motions, double max_distance) {
  objective.samples.resize(std::size_t(motionsOf(objective)));
  for (std::size_t i = 0; i < objective.samples.size(); ++i) {
    for (const MotionContact& contact : motions.approaches(objective.from + int(i), max_distance))
      add(objective.samples[i], {contact.time, contact.a, contact.b});
  }
}

}  // namespace kinegraph::inline komo_internal
