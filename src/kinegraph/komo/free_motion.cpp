#include "kinegraph/komo/free_motion.h"

#include <algorithm>
#include <cmath>

namespace kinegraph {

namespace {

constexpr double kThrough = .01;  // m: what is so deep is not a corner that is cut

/// The margin that the motion can keep.
double marginOf(const Objective& objective, const SliceMotion& motion, MotionProbe& probe) {
  if (motion.slice > 0 || objective.margin == 0.) return objective.margin;
  const double limit = objective.margin + 2. * kFreeTolerance, at_begin = probe.clearance(motion, 0., limit);
  return at_begin < limit ? std::max(.5 * at_begin, 0.) : objective.margin;
}

/// What a motion lacks to keep a margin.
struct Lack {
  double most = 0.;              ///< m
  std::vector<double> instants;  ///< shares of the way at which it lacks more than just before and after
};

/// From samples of the way, and the first contact, where these miss it.
Lack findLack(const SliceMotion& motion, double margin, double first, MotionProbe& probe) {
  constexpr int kSamples = 32;
  std::vector<double> lacks;
  for (int i = 0; i <= kSamples; ++i) lacks.push_back(margin - probe.clearance(motion, double(i) / kSamples, margin));
  Lack found;
  for (int i = 0; i <= kSamples; ++i) {
    const auto lackAt = [&](int k) { return k < 0 || k > kSamples ? 0. : lacks[std::size_t(k)]; };
    const double here = lackAt(i);
    if (here <= 0.) continue;
    found.most = std::max(found.most, here);
    const bool is_peak = here > lackAt(i - 1) && here >= lackAt(i + 1);
    if (is_peak) found.instants.push_back(double(i) / kSamples);
  }
  if (found.instants.empty()) {
    found.instants.push_back(first);
    found.most = std::max(margin - probe.clearance(motion, first, margin), kFreeTolerance);
  }
  return found;
}

}  // namespace

namespace {

/// Where a motion goes right through something, the next one may do so a little earlier or later. So that it cannot,
/// the motions around it get instants in their middle, and then in the middle of these.
void guard(Objective& objective, int through) {
  const int count = int(objective.instants.size()), reach = std::max(2, count / 8);
  for (int i = std::max(through - reach, 0); i <= std::min(through + reach, count - 1); ++i) {
    std::vector<double>& instants = objective.instants[std::size_t(i)];
    if (std::ranges::find(instants, .5) == instants.end()) {
      instants.push_back(.5);
    } else if (std::ranges::find(instants, .25) == instants.end()) {
      instants.insert(instants.end(), {.25, .75});
    }
  }
}

}  // namespace

double addInstants(Objective& objective, const Path& path, MotionProbe& probe) {
  double most = 0.;
  const int count = std::max(objective.to - objective.from + 1, 0);
  objective.instants.resize(std::size_t(count));
  for (int i = 0; i < count; ++i) {
    const SliceMotion motion = motionInto(path, objective.from + i);
    const double margin = marginOf(objective, motion, probe);
    const std::optional<MotionContact> contact = probe.firstContact(motion, margin);
    if (!contact) continue;
    const Lack lack = findLack(motion, margin + kFreeTolerance, contact->time, probe);
    most = std::max(most, lack.most);
    std::vector<double>& known = objective.instants[std::size_t(i)];
    known.insert(known.end(), lack.instants.begin(), lack.instants.end());
    if (lack.most > kThrough) guard(objective, i);
  }
  return most;
}

std::vector<Objective> withInstants(std::vector<Objective> objectives, const Path& path) {
  MotionProbe probe(kFreeTolerance);
  for (Objective& objective : objectives) {
    if (objective.on_the_way) addInstants(objective, path, probe);
  }
  return objectives;
}

}  // namespace kinegraph
