#pragma once

#include "kinegraph/komo/collision/slice_motions.h"
#include "kinegraph/komo/objective.h"

namespace kinegraph::inline komo_internal {

// A continuously collision-free motion is a problem with infinitely many constraints. It is solved with the constraints
// in the slices first. Collision samples are then added at the times between slices at which the solution collides, and
// the problem is solved again until it is collision-free.
// Source: Blankenship, Falk, Infinitely constrained optimization problems, 1976; Hauser, Semi-infinite programming for
// trajectory optimization with non-convex obstacles, 2021.

inline constexpr double kFreeTolerance = 1e-5;  ///< tolerance of continuous collision checks, m
inline constexpr int kSpareSamplesPerMotion =
    16;  ///< empty samples per motion that a solver can fill before its problem is
         ///< rebuilt
inline constexpr double kAlternativePathReach =
    .05;  ///< m: an alternative path starts with samples for all pairs closer than
          ///< this

/// Returns the distance (m) beyond which the separate form of a collision objective ignores a pair. It is half as large
/// for continuously constrained motions, because the samples are updated after each step.
double cutoffDistance(const Objective& objective);

/// Translates the largest violation of a margin (m) to the solver's terms.
Refinement refinementOf(double violation);

/// Checks the motions of an objective that is `between_slices`, and adds samples at which pairs are closer than its
/// margin. Returns the largest violation, m; 0 if there is none. If the path begins closer than the margin, the margin
/// of the first motion is half of the initial clearance.
double addSamples(Objective& objective, SliceMotions& motions);

/// Returns the objectives with samples added at which the path violates them.
std::vector<Objective> withSamples(std::vector<Objective> objectives, const Path& path);

/// The end points of a motion at its last check.
struct CheckedMotion {
  VectorXd from, to;  ///< empty before the first check

  bool hasMoved(const SliceMotion& motion) const;
};

struct FilledSamples {
  double violation = 0.;     ///< largest violation of the margin, m
  std::vector<int> motions;  ///< motions in which empty samples were filled
};

/// Fills samples during a solver run. Unlike addSamples it only replaces empty samples, also for pairs that are close
/// to violating the margin, and skips motions that have hardly moved since their last check. With `is_solution` it
/// checks all motions continuously and adds samples to all that collide.
FilledSamples fillSamples(Objective& objective, SliceMotions& motions, bool is_solution,
                          std::vector<CheckedMotion>& checked);

/// Adds empty samples until each motion has at least `count`.
void reserveSamples(Objective& objective, int count);

/// Adds samples at which pairs approach each other to less than `max_distance` (m).
void addApproaches(Objective& objective, SliceMotions& motions, double max_distance);

}  // namespace kinegraph::inline komo_internal
