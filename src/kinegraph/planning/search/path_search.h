#pragma once

#include <atomic>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/planning/search/tree_search.h"

namespace kinegraph {

/// What is asked of searchPath.
struct PathQuery {
  PlanningConstraints constraints;
  std::vector<VectorXd> starts, goals;  ///< free, at least one each
  double range = 1.;                    ///< longest motion that trees grow by, in joint space
  std::uint64_t seed = 0;
  long evaluations = 1000000;  ///< postures drawn, and evaluations of Steering, in all attempts together, at most
  int threads = 1;
  bool tries_line = true;  ///< first the straight motions, from each start to each goal
  CancellationToken cancellation = {};
  Steering* steering = nullptr;  ///< of the same demands, for the calling thread; must stay. None: it makes its own
};

/// How one attempt with trees ended.
struct SearchReport {
  long samples = 0, evaluations = 0;
  int start_nodes = 0, goal_nodes = 0;
};

/// What searchPath found.
struct Way {
  std::vector<VectorXd> points;  ///< empty: none. Straight motions between them are free at all times
  int start = 0, goal = 0;       ///< which ones it joins
  bool is_line = false;
  bool was_stopped = false;            ///< by the watch
  long evaluations = 0;                ///< of the attempts that count
  std::vector<SearchReport> attempts;  ///< those that count: up to the one that succeeded
  PairCounts hits;                     ///< what their motions ran into
  std::vector<MotionTree> trees;       ///< of the last attempt that counts: of the starts and of the goals
};

/// A way from one of the starts to one of the goals: the straight one if it is free, else by attempts with trees
/// (TreeSearch), each with random numbers of its own and more effort than the one before. The way of the first attempt
/// that succeeds counts, so that threads, which make several attempts at once, change nothing but the time.
Way searchPath(const PathQuery& request);

}  // namespace kinegraph
