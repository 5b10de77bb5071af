#pragma once

#include <cstdint>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/steering/steering.h"
#include "kinegraph/rrt/search_tree.h"

namespace kinegraph::inline planning_internal {

/// A query of searchPath.
struct PathQuery {
  PlanningConstraints constraints;
  std::vector<VectorXd> starts, goals;  ///< collision-free configurations, at least one each
  double range = 1.;                    ///< longest edge by which trees are extended, in joint space
  std::uint64_t seed = 0;
  long max_evaluations = 1000000;  ///< samples and evaluations of Steering, in all tree searches together
  long max_samples = 0;            ///< if positive, counts instead: iterations, in all tree searches together
  int threads = 1;
  bool tries_line = true;  ///< first checks the straight edge from each start to each goal
  CancellationToken cancellation = {};
  Steering* steering = nullptr;  ///< of the same constraints, for the calling thread; null: constructed here
};

/// The answer of searchPath. Tree searches count up to the first that succeeded.
struct PathSearchResult {
  std::vector<VectorXd> points;  ///< of the path; empty: none was found. Edges are continuously collision-free
  int start = 0, goal = 0;       ///< numbers of the start and the goal that the path connects
  bool is_line = false;
  bool was_stopped = false;  ///< by the cancellation token
  long evaluations = 0;
  std::vector<SearchReport> searches;
  PairCounts hits;                ///< pairs that their edges collided with
  std::vector<SearchTree> trees;  ///< of the last search: of the starts, of the goals
};

/// Searches a path from one of the starts to one of the goals: a straight edge if one is free, else by RRT-Connect with
/// restarts. Each restart has its own random numbers and a larger budget than the one before. The path of the first
/// search that succeeds counts, so that the result does not depend on the number of threads, which run several
/// searches at once.
PathSearchResult searchPath(const PathQuery& query);

}  // namespace kinegraph::inline planning_internal
