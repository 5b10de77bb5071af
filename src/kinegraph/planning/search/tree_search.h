#pragma once

#include <cstdint>
#include <functional>

#include "kinegraph/planning/search/motion_tree.h"
#include "kinegraph/planning/steering/steering.h"

namespace kinegraph {

/// A bidirectional search of trees for a way between one of several starts and one of several goals.
///
/// RRT-Connect: the smaller tree grows towards a random posture, and then, as far as it comes, towards the nearest
/// posture of the other tree. Dynamic domain: a posture next to obstacles grows only towards what is near it. Motions
/// are looked at posture by posture while the trees grow; those of a way that is found are checked at all times, and
/// what fails is cut off the tree, and the search goes on. Sources: Kuffner, LaValle, RRT-Connect, 2000; Yershova,
/// Jaillet, Simeon, LaValle, Dynamic-domain RRTs, 2005; Thomason, Kingston, Kavraki, Motions in microseconds via
/// vectorized sampling-based planning, 2024.
class TreeSearch {
 public:
  struct Options {
    double range = 1.;          ///< longest motion that is added at once, in joint space
    std::uint64_t seed = 0;     ///< of the random postures
    long evaluations = 100000;  ///< postures drawn and postures looked at, together, at most
  };

  /// `steering` must stay. Starts and goals are free.
  TreeSearch(Steering& steering, const std::vector<VectorXd>& starts, const std::vector<VectorXd>& goals,
             const Options& options);

  /// True if a way was found. `stop` is asked now and then; true ends the search.
  bool run(const std::function<bool()>& stop);

  /// Of the way that was found: its postures, from a start to a goal, and which ones these are.
  const std::vector<VectorXd>& path() const { return path_; }
  int start() const { return start_; }
  int goal() const { return goal_; }

  long evaluations() const { return draws_ + steering_.evaluations() - evaluations_before_; }
  long samples() const { return draws_; }
  int nodes(bool of_goals) const { return trees_[of_goals].size(); }
  const MotionTree& tree(bool of_goals) const { return trees_[of_goals]; }

 private:
  bool grow();
  int extend(MotionTree& tree, int from, const VectorXd& target, bool& reached);
  bool join(int mine, int other);
  bool makeSure(MotionTree& tree, const std::vector<int>& branch);

  Steering& steering_;
  Options options_;
  Rng rng_;
  MotionTree trees_[2];
  int growing_ = 1;
  long draws_ = 0, evaluations_before_;
  int surprises_ = 0;  ///< motions that seemed free and are not
  std::vector<VectorXd> path_;
  int start_ = 0, goal_ = 0;
};

}  // namespace kinegraph
