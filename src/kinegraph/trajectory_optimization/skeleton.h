#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// A schedule of modes and constraints, with entries such as "from phase 1 on, the box is attached to the gripper" or
/// "at phase 1 the palm touches the box". It makes trajectory optimization problems of different resolution with the
/// same entries.
/// Source: Toussaint, Allen, Smith, Tenenbaum, Differentiable physics and stable modes for tool-use and manipulation
/// planning, 2018.
class Skeleton {
 public:
  struct Entry {
    double from, to;  ///< phases; to < 0: until the end, for attachments until the object's next one
    SwitchMode symbol;
    std::vector<std::string> frames;
  };

  /// `times` is {at} or {from, to}. Throws ValueError for invalid times, a wrong number of frames, and the unsupported
  /// symbols identical and pushAndPlace.
  void addEntry(const std::vector<double>& times, SwitchMode symbol, const std::vector<std::string>& frames);

  /// Adds pairs of frames (two consecutive names each) that must not overlap in any slice.
  void addExplicitCollisions(const std::vector<std::string>& pairs);

  /// Adds objects that paths lift above 0.6 m in the middle of each phase, as a soft constraint.
  void addLiftPriors(const std::vector<std::string>& objects);

  /// Enables or disables collision avoidance of all pairs. Enabled by default.
  void useBroadCollisions(bool on) { collisions_ = on; }

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<std::string>& explicitCollisions() const { return explicit_pairs_; }
  const std::vector<std::string>& liftPriors() const { return lifted_; }
  bool usesBroadCollisions() const { return collisions_; }
  double maxPhase() const;  ///< 0 without entries

  /// Makes a path of 5 s per phase with costs on accelerations and on the distance from home. A scale of 0 or less
  /// omits a cost.
  Komo path(const Config& config, int steps_per_phase, double acceleration_scale, double homing_scale) const;

  /// Makes a problem with one configuration per phase, with costs on their distances from each other and from home.
  Komo waypoints(const Config& config, double length_scale, double homing_scale) const;

  /// Makes a problem with two configurations: the second is the end of the last phase, the first represents all earlier
  /// phases, in which objects were grasped.
  Komo finalSlice(const Config& config, double length_scale, double homing_scale) const;

  /// Adds the entries to a problem: attachments first, in order of time.
  void addTo(Komo& komo) const { add(komo, entries_); }

 private:
  Komo problem(const Config& config, double phases, int steps, double seconds, int order) const;
  void add(Komo& komo, const std::vector<Entry>& entries) const;
  std::vector<Entry> lastEntries() const;

  std::vector<Entry> entries_;
  std::vector<std::string> explicit_pairs_, lifted_;
  bool collisions_ = true;
};

/// Adds the constraints of a skeleton entry that is not an attachment.
void addCondition(Komo& komo, const Skeleton::Entry& entry);

}  // namespace kinegraph
