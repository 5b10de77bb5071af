#pragma once

#include "kinegraph/komo/collision/slice_motions.h"
#include "kinegraph/komo/objective.h"

namespace kinegraph {

// A motion that is to be free at all times is a problem with infinitely many constraints. It is solved with those of
// the slices, and then again with those of the instants between them at which the solution is not free, until it is.
// Source: Blankenship, Falk, Infinitely constrained optimization problems, 1976; Hauser, Semi-infinite programming for
// trajectory optimization with non-convex obstacles, 2021.

inline constexpr double kFreeTolerance = 1e-5;  ///< of checks of motions, m
inline constexpr int kRoomOfMotion = 16;  ///< instants that a solver can take up before its problem is laid out anew
inline constexpr double kNearToDetour = .05;  ///< m: what a detour comes so near to counts from its beginning on

/// Pairs that are farther apart than that are not looked at any closer in the separate form of an objective of collisions, m.
/// Of motions that are to be free it is half as much: what a step brings into the way is found as they are looked at.
double farOf(const Objective& objective);

/// What it means for a solver that pairs are nearer than their margin by so much, at most, m.
Refinement refinementOf(double lack);

/// Looks at the motions to the slices of an objective that is `on_the_way`, and adds instants at which pairs are nearer
/// than its margin. Returns by how much at most, m; 0 if there are none. Where the path begins nearer than that, the
/// first motion keeps half of what the beginning has.
double addSamples(Objective& objective, SliceMotions& motions);

/// The objectives, those on the way with the instants at which the path violates them.
std::vector<Objective> withSamples(std::vector<Objective> objectives, const Path& path);

/// A motion between two slices, where it was when it was looked at last.
struct CheckedMotion {
  VectorXd from, to;  ///< empty: it was not yet

  bool isFar(const SliceMotion& motion) const;
};

struct FilledSamples {
  double lack = 0.;          ///< by how much a pair is nearer than the margin, at most, m
  std::vector<int> motions;  ///< that have instants which were empty
};

/// As addSamples, while a solver is at work: in place of empty instants only, and also where pairs nearly come so
/// near. Motions that have hardly moved since they were looked at are left out. `is_solution`: all are looked at, and
/// at all times; instants are added to those that are not free.
FilledSamples fillSamples(Objective& objective, SliceMotions& motions, bool is_solution,
                          std::vector<CheckedMotion>& looked_at);

/// As many instants that are empty for each motion.
void keepRoom(Objective& objective, int count);

/// Adds those at which pairs come nearer than `most` (m) on the way.
void addApproaches(Objective& objective, SliceMotions& motions, double most);

}  // namespace kinegraph
