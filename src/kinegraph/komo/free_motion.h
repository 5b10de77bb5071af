#pragma once

#include "kinegraph/komo/objective.h"
#include "kinegraph/komo/path_motion.h"

namespace kinegraph {

// A motion that is to be free at all times is a problem with infinitely many constraints. It is solved with those of
// the slices, and then again with those of the instants between them at which the solution is not free, until it is.
// Source: Blankenship, Falk, Infinitely constrained optimization problems, 1976; Hauser, Semi-infinite programming for
// trajectory optimization with non-convex obstacles, 2021.

inline constexpr double kFreeTolerance = 1e-5;  ///< of checks of motions, m

/// Looks at the motions to the slices of an objective that is `on_the_way`, and adds instants at which pairs are nearer
/// than its margin. Returns by how much at most, m; 0 if there are none. Where the path begins nearer than that, the
/// first motion keeps half of what the beginning has.
double addInstants(Objective& objective, const Path& path, MotionProbe& probe);

/// The objectives, those on the way with the instants at which the path violates them.
std::vector<Objective> withInstants(std::vector<Objective> objectives, const Path& path);

/// A motion between two slices, where it was when it was looked at last.
struct LookedAt {
  VectorXd from, to;  ///< empty: it was not yet

  bool isFar(const SliceMotion& motion) const;
};

struct FilledInstants {
  double lack = 0.;          ///< by how much a pair is nearer than the margin, at most, m
  std::vector<int> motions;  ///< that have instants which were empty
};

/// As addInstants, while a solver is at work: in place of empty instants only, and also where pairs nearly come so
/// near. Motions that have hardly moved since they were looked at are left out. `is_solution`: all are looked at, and
/// at all times; instants are added to those that are not free.
FilledInstants fillInstants(Objective& objective, const Path& path, MotionProbe& probe, bool is_solution,
                            std::vector<LookedAt>& looked_at);

/// As many instants that are empty for each motion.
void keepRoom(Objective& objective, int count);

/// Adds those at which pairs come nearer than `most` (m) on the way.
void addApproaches(Objective& objective, const Path& path, MotionProbe& probe, double most);

}  // namespace kinegraph
