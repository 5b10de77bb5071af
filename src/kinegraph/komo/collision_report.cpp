#include "kinegraph/komo/collision_report.h"

#include <algorithm>
#include <iterator>

namespace kinegraph::inline komo_internal {

namespace {

using FramePairs = std::vector<std::pair<int, int>>;  // ascending

/// Collisions that are constrained in a slice or motion.
struct Constrained {
  bool all = false;  ///< of all shapes that may collide
  FramePairs named;  ///< pairs of such shapes
  FramePairs apart;  ///< pairs of frames that keep a distance; their shapes need not be allowed to collide otherwise

  bool any() const { return all || !named.empty() || !apart.empty(); }
};

enum class Kind { none, all, named, apart };

/// Returns the kind of constraint that an objective imposes in its slices.
Kind kindOf(const Objective& objective) {
  using S = FeatureSymbol;
  const bool is_inequality = objective.type == ObjectiveType::ineq || objective.type == ObjectiveType::ineqB;
  if (objective.order != 0 && !objective.between_slices) return Kind::none;
  if (objective.feature == S::accumulatedCollisions || objective.feature == S::pairCollisions) {
    if (!is_inequality && objective.type != ObjectiveType::eq) return Kind::none;
    return objective.frames.empty() ? Kind::all : Kind::named;
  }
  const bool keeps_apart = objective.feature == S::distance && is_inequality &&
                           (objective.scale.size() == 0 || (objective.scale.array() > 0.).all()) &&
                           (objective.target.size() == 0 || (objective.target.array() <= 0.).all());
  return keeps_apart ? Kind::apart : Kind::none;
}

void addPairs(const KinematicModel& model, const Objective& objective, Kind kind, Constrained& to) {
  std::vector<int> ids;
  for (const std::string& name : objective.frames) ids.push_back(frameId(model, name, objective.name()));
  if (kind == Kind::apart) {
    if (model.movesApart(ids[0], ids[1])) to.apart.emplace_back(std::minmax(ids[0], ids[1]));
    return;
  }
  const std::vector<ContactRules::Body>& bodies = model.contacts.bodies;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    if (std::ranges::find(ids, bodies[i].frame) == ids.end()) continue;
    for (std::size_t j = 0; j < bodies.size(); ++j) {
      const int a = bodies[i].frame, b = bodies[j].frame;
      if (j != i && model.movesApart(a, b) && model.contacts.allow(i, j)) to.named.emplace_back(std::minmax(a, b));
    }
  }
}

void sortUnique(FramePairs& pairs) {
  std::ranges::sort(pairs);
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

/// Returns the constraints in a slice, or on the motion to it. Frames are those of the kinematic model of the slice.
Constrained constrainedIn(const std::vector<Objective>& objectives, const KinematicModel& model, int slice,
                          bool between_slices) {
  Constrained found;
  for (const Objective& objective : objectives) {
    if (objective.between_slices != between_slices || slice < objective.from || slice > objective.to) continue;
    const Kind kind = kindOf(objective);
    if (kind == Kind::all) found.all = true;
    if (kind == Kind::named || kind == Kind::apart) addPairs(model, objective, kind, found);
  }
  sortUnique(found.named);
  sortUnique(found.apart);
  return found;
}

/// Returns the collisions that both constraints forbid.
Constrained inBoth(const Constrained& one, const Constrained& other) {
  const auto common = [](const FramePairs& a, const FramePairs& b, FramePairs& to) {
    std::ranges::set_intersection(a, b, std::back_inserter(to));
  };
  Constrained both;
  both.all = one.all && other.all;
  if (one.all != other.all) {
    both.named = one.all ? other.named : one.named;
  } else {
    common(one.named, other.named, both.named);
  }
  common(one.apart, other.apart, both.apart);
  return both;
}

Constrained constrainedOnMotion(const Path& path, const std::vector<Objective>& objectives, int slice) {
  const KinematicModel& model = path.state(slice - 1).model();
  Constrained found = constrainedIn(objectives, model, slice, true);
  if (path.grid().slicesPerPhase() == 1) return found;
  Constrained at_end = constrainedIn(objectives, model, slice, false);
  const Constrained both =
      slice == 0 ? std::move(at_end) : inBoth(constrainedIn(objectives, model, slice - 1, false), at_end);
  found.all = found.all || both.all;
  found.named.insert(found.named.end(), both.named.begin(), both.named.end());
  found.apart.insert(found.apart.end(), both.apart.begin(), both.apart.end());
  return found;
}

}  // namespace

bool constrainsAnyMotion(const Path& path, const std::vector<Objective>& objectives) {
  const bool are_waypoints = path.grid().slicesPerPhase() == 1;
  return std::ranges::any_of(objectives, [&](const Objective& objective) {
    return kindOf(objective) != Kind::none && (objective.between_slices || !are_waypoints) &&
           std::max(objective.from, firstMotion(path)) <= objective.to;
  });
}

std::vector<SliceMotion> constrainedMotions(const Path& path, const std::vector<Objective>& objectives) {
  std::vector<SliceMotion> motions;
  for (int slice = firstMotion(path); slice < path.grid().slices(); ++slice) {
    Constrained constrained = constrainedOnMotion(path, objectives, slice);
    if (!constrained.any()) continue;
    SliceMotion& motion = motions.emplace_back(motionInto(path, slice));
    motion.all_pairs = constrained.all;
    if (!constrained.all) motion.pairs = std::move(constrained.named);
    motion.pairs.insert(motion.pairs.end(), constrained.apart.begin(), constrained.apart.end());
    sortUnique(motion.pairs);
  }
  return motions;
}

ValidityReport reportCollisions(const std::vector<SliceMotion>& motions, const CancellationToken& cancellation) {
  constexpr double kTolerance = 1e-5;  // m
  const std::vector<PathContact> contacts = contactsOf(motions, 0., kTolerance, cancellation);
  if (contacts.empty()) return {};
  const auto deepest = std::ranges::min_element(contacts, {}, &PathContact::distance);
  return {false, deepest->str()};
}

}  // namespace kinegraph::inline komo_internal
