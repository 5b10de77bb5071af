#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/option_table.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph::inline kinematics_internal {
class State;
}

namespace kinegraph::inline planning_internal {
class JointSpace;
}

namespace kinegraph {

/// Settings of a PathFinder, with the names of the reference package.
struct PathFinderOptions {
  int verbose = 0;
  double stepsize = .1;
  int subsamples = 4;
  int maxIters = 5000;
  double p_connect = .5;
  double collisionTolerance = 1e-4;
  bool useBroadCollisions = true;

  void validate() const;  ///< throws ValueError
};

const OptionTable<PathFinderOptions>& pathFinderOptionTable();

/// Finds a continuously collision-free path between two joint vectors by RRT-Connect and shortcutting.
///
///     PathFinder finder;
///     finder.setProblem(C).setStartGoal(q0, qT);
///     SolverResult result = finder.solve();   // x: the path, K x n, row by row
///
/// `solve` checks start and goal first; if one is in collision or beyond limits, the result is not feasible and its
/// message says so. A sliding joint without limits is sampled around start and goal, with a warning. The Config must
/// outlive the finder; `solve` reads it and does not change it.
class PathFinder {
 public:
  PathFinder& setOptions(const PathFinderOptions& options);  ///< throws ValueError
  const PathFinderOptions& options() const { return options_; }

  PathFinder& setProblem(const Config& config);

  /// Also sets the start and the goal, as setStartGoal.
  PathFinder& setProblem(const Config& config, const VectorXd& start, const VectorXd& goal);

  /// Sets one joint vector each; `solve` checks their lengths.
  PathFinder& setStartGoal(const VectorXd& start, const VectorXd& goal);

  /// Restricts collisions to these pairs of frames. No pairs: those of the Config.
  PathFinder& setExplicitCollisionPairs(std::vector<std::pair<std::string, std::string>> pairs);

  /// Searches a path. x has its configurations, at most stepsize apart, start and goal included; it is empty if there
  /// is no path. evals is the number of iterations. Equal seeds give equal paths. Throws ValueError for invalid
  /// arguments.
  SolverResult solve(std::uint64_t seed = 0, const CancellationToken& cancellation = {});

  /// Returns the warning of the last `solve`, and clears it.
  std::string takeWarning() { return std::exchange(warning_, {}); }

  /// The last path, K x n; no rows if there is none.
  const MatrixXd& path() const { return path_; }

  /// Returns T configurations along the path, T x n, evenly spaced in its index. Throws ValueError if there is none.
  MatrixXd get_resampledPath(int T) const;

  /// Plays the path in the viewer of the scene, as Config::viewPath. Throws ValueError if there is none.
  int view(bool pause = false, const std::string& message = {}) const;

  const Config* config() const { return config_; }

 private:
  MatrixXd search(const State& scene, std::uint64_t seed, const CancellationToken& cancellation, SolverResult& result);

  PathFinderOptions options_;
  const Config* config_ = nullptr;
  VectorXd start_, goal_;
  std::vector<std::pair<std::string, std::string>> pairs_;
  MatrixXd path_;
  std::string warning_;
};

/// Resamples a path at steps of at most `step` in joint space.
MatrixXd resampleBySteps(const JointSpace& space, const MatrixXd& path, double step);

/// Resamples a path at T configurations, evenly spaced in its index.
MatrixXd resampleByIndex(const MatrixXd& path, int T);

struct RefineOptions {
  double margin = 0.;      ///< least distance of all collidable pairs, m
  double blend = .05;      ///< largest deviation of `smooth` from the path in every dof, rad or m
  std::uint64_t seed = 0;  ///< of the random shortcuts
  CancellationToken cancellation = {};
};

/// Shortens a path (K, n) between the same ends; the result is continuously collision-free. Throws ValueError for a
/// path of another width, and for a path in collision; the message says between which rows.
MatrixXd shortcut(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

/// Rounds the corners of a path as far as that is continuously collision-free. Errors as `shortcut`.
MatrixXd smooth(const Config& config, const MatrixXd& path, const RefineOptions& options = {});

}  // namespace kinegraph
