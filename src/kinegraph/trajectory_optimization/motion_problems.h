#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/trajectories/trajectory.h"

namespace kinegraph {

/// Returns starting points x for a trajectory optimization problem: its present path, then random ones as from
/// setRandomPath. Restores the path. `cancellation` is polled before each sample, and may throw.
std::vector<VectorXd> sampleStarts(Komo& komo, int count, std::uint64_t seed,
                                   const CancellationToken& cancellation = {});

/// Solves a trajectory optimization problem from several starting points x, with one copy of it per thread. Leaves the
/// Komo at the best solution. `solver` are the options of all runs. Throws ValueError without starts, and for starts of
/// a wrong length.
SolveManyResult solveFromMany(const std::shared_ptr<Komo>& komo, const std::vector<VectorXd>& starts,
                              const SolverOptions& solver = {}, const SolveManyOptions& options = {},
                              const ProgressCallback& progress = {}, const CancellationToken& cancellation = {});

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

struct SplineMotionOptions {
  int points = 8;            ///< control points after the start, evenly spaced in time; at most one per slice
  int degree = 3;            ///< of the spline, 1 to 9
  bool ends_at_rest = true;  ///< otherwise there are floor(degree / 2) more control points

  void validate(int slices) const;  ///< throws ValueError
};

/// The trajectory optimization problem of a Komo with its slices on a B-spline, whose control points are the variables.
/// They are few even for many slices, the motion is smooth for any objectives, and it can be executed directly.
///
/// All joints of the initial configuration are part of the spline, which starts at rest in the slice before the first.
/// Joint limits are bounds of its control points, so that the spline satisfies them everywhere. With addFreeMotion the
/// spline is continuously collision-free, and reports of collisions refer to the spline. Other variables, such as the
/// dofs of attached objects and dofs that slices share, remain variables; they move linearly between slices.
class SplineMotion {
 public:
  /// Throws ValueError for invalid options.
  explicit SplineMotion(std::shared_ptr<Komo> komo, const SplineMotionOptions& options = {});

  const std::shared_ptr<Komo>& komo() const { return komo_; }
  const SplineMotionOptions& options() const { return options_; }

  /// Returns the problem for a solver, which leaves the Komo's path at its result. It uses the objectives and the start
  /// that the Komo has now, and starts near its present path.
  std::shared_ptr<Nlp> nlp() const;

  /// Returns the spline through the Komo's present path, in s after the start; the best approximation if a solver has
  /// not left the path there.
  BSpline spline() const;

  /// Returns true if all pairs of shapes that joints move relative to each other provably stay `margin` (m) apart along
  /// the spline. May return false for pairs within margin + 3e-5 m. Throws ValueError for a margin that is not finite.
  bool isFree(double margin = 0.) const;

 private:
  std::shared_ptr<Komo> komo_;
  SplineMotionOptions options_;
};

}  // namespace kinegraph
