#include "kinegraph/trajectory_optimization/motion_problems.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Number of frames that a symbol takes; most -1: any number.
struct FrameCount {
  int least, most;
};

FrameCount frameCount(SwitchMode symbol) {
  using M = SwitchMode;
  switch (symbol) {
    case M::end:
      return {0, -1};
    case M::downUp:
    case M::lift:
    case M::stablePose:
    case M::dampMotion:
    case M::makeFree:
    case M::forceBalance:
      return {1, -1};
    case M::dynamic:
    case M::dynamicTrans:
    case M::quasiStatic:
    case M::magic:
      return {1, 2};
    case M::oppose:
    case M::topBoxPlace:
      return {3, 3};
    case M::boxGraspX:
    case M::boxGraspY:
    case M::boxGraspZ:
      return {2, 3};
    default:
      return {2, 2};
  }
}

const std::string& objectOf(const Skeleton::Entry& entry) { return entry.frames.back(); }

void makeFree(Config& config, const std::string& name) {
  const Frame frame = config.getFrame(name);
  Frame edited = frame;
  if (frame.data().parent == nullptr) {
    const auto& frames = config.scene()->frames();
    if (frames.front()->name == name)
      throw ValueError(cat("makeFree: '", name, "' is the first frame of the scene, which cannot be free"));
    edited.setParent(Frame(config.scene(), *frames.front()), true);
  }
  edited.setJoint(JointType::free);
}

}  // namespace

void Skeleton::addEntry(const std::vector<double>& times, SwitchMode symbol, const std::vector<std::string>& frames) {
  const std::string name = switchModeName(symbol);
  if (symbol == SwitchMode::identical || symbol == SwitchMode::pushAndPlace) {
    throw ValueError(cat("Skeleton: ", name, " is not supported; use poseEq, or push and stableOn"));
  }
  if (times.empty() || times.size() > 2) {
    throw ValueError(
        cat("Skeleton: the times of ", name, " must be [at] or [from, to], in phases; got ", times.size(), " numbers"));
  }
  Entry entry{times.front(), times.back(), symbol, frames};
  if (!std::isfinite(entry.from) || !std::isfinite(entry.to) || entry.from < 0.) {
    throw ValueError(cat("Skeleton: ", name, " begins at phase ", entry.from, "; expected a number of 0 or more"));
  }
  if (entry.to >= 0. && entry.to < entry.from) {
    throw ValueError(
        cat("Skeleton: ", name, " ends at phase ", entry.to, ", before it begins at ", entry.from, "; -1 is the end"));
  }
  const auto [least, most] = frameCount(symbol);
  const int count = int(frames.size());
  if (count < least || (most >= 0 && count > most)) {
    const std::string more = most < 0 ? " or more" : most > least ? cat(" to ", most) : std::string();
    throw ValueError(cat("Skeleton: ", name, " takes ", least, more, " frames; got ", count));
  }
  entries_.push_back(std::move(entry));
}

void Skeleton::addExplicitCollisions(const std::vector<std::string>& pairs) {
  if (pairs.size() % 2 != 0)
    throw ValueError(
        cat("addExplicitCollisions: expected pairs of frames, an even number of names; got ", pairs.size()));
  explicit_pairs_.insert(explicit_pairs_.end(), pairs.begin(), pairs.end());
}

void Skeleton::addLiftPriors(const std::vector<std::string>& objects) {
  lifted_.insert(lifted_.end(), objects.begin(), objects.end());
}

double Skeleton::maxPhase() const {
  double last = 0.;
  for (const Entry& entry : entries_) last = std::max({last, entry.from, entry.to});
  return last;
}

Komo Skeleton::problem(const Config& config, double phases, int steps, double seconds, int order) const {
  if (maxPhase() <= 0.) throw ValueError("Skeleton: there is no entry with a phase above 0; add one with addEntry");
  Config scene = config;
  for (const Entry& entry : entries_) {
    if (entry.symbol != SwitchMode::makeFree) continue;
    for (const std::string& name : entry.frames) makeFree(scene, name);
  }
  Komo komo;
  komo.setConfig(scene);
  komo.setTiming(phases, steps, seconds, order);
  return komo;
}

Komo Skeleton::path(const Config& config, int steps_per_phase, double acceleration_scale, double homing_scale) const {
  Komo komo = problem(config, maxPhase(), steps_per_phase, 5., 2);
  if (acceleration_scale > 0.) komo.addControlObjective({}, 2, acceleration_scale);
  if (homing_scale > 0.) komo.addControlObjective({}, 0, homing_scale);
  komo.addQuaternionNorms();
  if (collisions_) komo.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, 1e1);
  add(komo, entries_);
  const Eigen::RowVector3d up(0., 0., -1e1);
  for (const std::string& object : lifted_) {
    for (int phase = 0; phase < maxPhase(); ++phase) {
      if (const auto [first, last] = komo.path().grid().select({phase + .3, phase + .7}); first > last) continue;
      komo.addObjective({phase + .3, phase + .7}, FeatureSymbol::position, {object}, ObjectiveType::ineqP, up,
                        Vector3d(0., 0., .6));
    }
  }
  return komo;
}

Komo Skeleton::waypoints(const Config& config, double length_scale, double homing_scale) const {
  Komo komo = problem(config, maxPhase(), 1, 5., 1);
  if (length_scale > 0.) komo.addControlObjective({}, 1, length_scale);
  if (homing_scale > 0.) komo.addControlObjective({}, 0, homing_scale);
  komo.addQuaternionNorms();
  if (collisions_) komo.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq, 1e1);
  add(komo, entries_);
  return komo;
}

Komo Skeleton::finalSlice(const Config& config, double length_scale, double homing_scale) const {
  Komo komo = problem(config, 2., 1, 10., 1);
  if (length_scale > 0.) komo.addControlObjective({}, 1, length_scale);
  if (homing_scale > 0.) komo.addControlObjective({}, 0, homing_scale);
  komo.addQuaternionNorms();
  if (collisions_) komo.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::sos, 1e1);
  add(komo, lastEntries());
  return komo;
}

/// Returns the entries for finalSlice: attachments before the end of the last phase begin near 1, constraints at the
/// end are at 2.
std::vector<Skeleton::Entry> Skeleton::lastEntries() const {
  const double last = maxPhase();
  std::vector<Entry> list;
  for (Entry entry : entries_) {
    if (isAttachment(entry.symbol)) {
      entry.from = entry.from < last ? 1. + entry.from / (2. * last) : 2.;  // preserves the order
      entry.to = -1.;
    } else if (entry.from <= last && (entry.to < 0. || entry.to >= last) && entry.symbol != SwitchMode::bounce) {
      entry.from = entry.to = 2.;
    } else {
      continue;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

void Skeleton::add(Komo& komo, const std::vector<Entry>& entries) const {
  std::vector<Entry> attachments;
  for (const Entry& entry : entries) {
    if (isAttachment(entry.symbol)) attachments.push_back(entry);
  }
  std::stable_sort(attachments.begin(), attachments.end(),
                   [](const Entry& a, const Entry& b) { return a.from < b.from; });
  std::map<std::string, int> count;
  for (std::size_t i = 0; i < attachments.size(); ++i) {
    const Entry& entry = attachments[i];
    const int earlier = count[objectOf(entry)]++;
    double next = -1.;
    for (std::size_t j = i + 1; j < attachments.size() && next < 0.; ++j) {
      if (objectOf(attachments[j]) == objectOf(entry)) next = attachments[j].from;
    }
    if (next >= 0. && komo.path().grid().sliceAt(next) == komo.path().grid().sliceAt(entry.from))
      continue;  // the next attachment replaces it in the same slice
    double to = entry.to;
    if (to <= entry.from || (next >= 0. && to > next)) to = next;
    komo.addModeSwitch({entry.from, to}, entry.symbol, entry.frames, earlier == 0);
  }
  for (const Entry& entry : entries) {
    if (!isAttachment(entry.symbol)) addCondition(komo, entry);
  }
  for (std::size_t i = 0; i + 1 < explicit_pairs_.size(); i += 2) {
    komo.addObjective({}, FeatureSymbol::distance, {explicit_pairs_[i], explicit_pairs_[i + 1]}, ObjectiveType::ineq,
                      1e1);
  }
}

}  // namespace kinegraph
