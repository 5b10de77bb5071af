#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/common/option_table.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/solvers/interface/result.h"

namespace kinegraph {

/// Settings of a PathFinder, under the names that scripts know.
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

/// Finds a path between two joint vectors, free of collisions at all times: trees from both ends, then shortened.
///
///     PathFinder finder;
///     finder.setProblem(C).setStartGoal(q0, qT);
///     SolverResult result = finder.solve();   // x: the path, K x n, row by row
///
/// Start and goal are looked at first; where they collide, or are beyond limits, the result is not feasible and says
/// so. The Config must stay; it is read when `solve` is called, and not changed.
class PathFinder {
 public:
  PathFinder& setOptions(const PathFinderOptions& options);  ///< throws ValueError
  const PathFinderOptions& options() const { return options_; }

  PathFinder& setProblem(const Config& config);

  /// With the start and the goal, as in setStartGoal.
  PathFinder& setProblem(const Config& config, const VectorXd& start, const VectorXd& goal);

  /// One joint vector each, of any length until `solve`.
  PathFinder& setStartGoal(const VectorXd& start, const VectorXd& goal);

  /// Only these pairs may collide; without pairs, those of the Config.
  PathFinder& setExplicitCollisionPairs(std::vector<std::pair<std::string, std::string>> pairs);

  /// x has the path's postures, at most stepsize apart, start and goal included; it is empty if there is no path. evals
  /// is the number of postures drawn. The same seed gives the same path. Throws ValueError for what makes no sense.
  SolverResult solve(std::uint64_t seed = 0, const CancellationToken& cancellation = {});

  /// The path that was found, K x n; no rows before there is one.
  const MatrixXd& path() const { return path_; }

  /// T postures along the path, T x n: evenly in its index. Throws ValueError before there is one.
  MatrixXd get_resampledPath(int T) const;

  /// Plays the path in the viewer of the scene; as Config::viewPath. Throws ValueError before there is one.
  int view(bool pause = false, const std::string& message = {}) const;

  const Config* config() const { return config_; }

 private:
  MatrixXd search(const State& scene, std::uint64_t seed, const CancellationToken& cancellation, SolverResult& result);

  PathFinderOptions options_;
  const Config* config_ = nullptr;
  VectorXd start_, goal_;
  std::vector<std::pair<std::string, std::string>> pairs_;
  MatrixXd path_;
};

/// The same path with postures that are at most `step` apart in joint space.
MatrixXd resampleBySteps(const JointSpace& space, const MatrixXd& path, double step);

/// T postures along a path, evenly in its index.
MatrixXd resampleByIndex(const MatrixXd& path, int T);

}  // namespace kinegraph
