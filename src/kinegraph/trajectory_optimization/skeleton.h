#pragma once

#include <string>
#include <vector>

#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// What shall hold when, in words: entries such as "from phase 1 on, the box hangs stably at the gripper" or "at phase
/// 1 the palm touches the box". Makes motion problems of different detail that all obey the same entries. Source:
/// Toussaint, Allen, Smith, Tenenbaum, Differentiable physics and stable modes for tool-use and manipulation planning,
/// 2018.
class Skeleton {
 public:
  struct Entry {
    double from, to;  ///< phases; to < 0: until the end, for an attachment until the object's next one
    SwitchMode symbol;
    std::vector<std::string> frames;
  };

  /// `times` is {at} or {from, to}. Throws ValueError for wrong times or a wrong number of frames, and for the symbols
  /// that have no meaning (identical, pushAndPlace).
  void addEntry(const std::vector<double>& times, SwitchMode symbol, const std::vector<std::string>& frames);

  /// Frames two by two that shall not overlap, at any time.
  void addExplicitCollisions(const std::vector<std::string>& pairs);

  /// Objects that rise above 0.6 m in the middle of each phase of a path, if nothing speaks against it.
  void addLiftPriors(const std::vector<std::string>& objects);

  /// Do the problems demand that nothing collides? They do by default.
  void useBroadCollisions(bool on) { collisions_ = on; }

  const std::vector<Entry>& entries() const { return entries_; }
  const std::vector<std::string>& explicitCollisions() const { return explicit_pairs_; }
  const std::vector<std::string>& liftPriors() const { return lifted_; }
  bool usesBroadCollisions() const { return collisions_; }
  double maxPhase() const;  ///< 0 without entries

  /// A path of 5 s per phase with costs on accelerations and on the distance from home; a scale of 0 or less leaves a
  /// cost out.
  Komo path(const Config& config, int steps_per_phase, double acceleration_scale, double homing_scale) const;

  /// One configuration per phase, with costs on their distances from one another and from home.
  Komo waypoints(const Config& config, double length_scale, double homing_scale) const;

  /// Two configurations, of which the second one is the end of the last phase, and the first all that came before:
  /// where objects were taken.
  Komo finalSlice(const Config& config, double length_scale, double homing_scale) const;

  /// Adds the entries to a problem, attachments first, in the order of their times.
  void addTo(Komo& komo) const { add(komo, entries_); }

 private:
  Komo problem(const Config& config, double phases, int steps, double seconds, int order) const;
  void add(Komo& komo, const std::vector<Entry>& entries) const;
  std::vector<Entry> lastEntries() const;

  std::vector<Entry> entries_;
  std::vector<std::string> explicit_pairs_, lifted_;
  bool collisions_ = true;
};

/// Adds what an entry of a skeleton demands that is not an attachment.
void addCondition(Komo& komo, const Skeleton::Entry& entry);

}  // namespace kinegraph
