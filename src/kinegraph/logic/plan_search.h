#pragma once

#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/logic/landmark_cut.h"

namespace kinegraph {

/// Plans of a problem, the shortest first: all sequences of actions that end where the goal holds for the first time and
/// come to no state twice. Which plan is the next one depends on the problem and on what was forbidden alone.
///
/// Distances to the goal are found exactly, by A* with a closed list and landmarks; what a search has found about other
/// states is kept (Koenig, Likhachev, Adaptive A*, 2005). Plans are then enumerated without dead ends.
class PlanSearch {
 public:
  enum class Status {
    found,
    exhausted,  ///< there is no further plan: this is proved
    limit,      ///< of effort
    cancelled,
  };
  struct Options {
    long most_expansions = 2000000;    ///< states that are expanded in all
    CancellationToken cancellation{};  ///< ends `next` with `cancelled`
  };

  explicit PlanSearch(GroundProblem ground);
  PlanSearch(GroundProblem ground, Options options);

  /// The next plan: numbers of actions.
  std::optional<std::vector<int>> next();

  /// How the last `next` ended.
  Status status() const { return status_; }

  /// An action is not possible in states in which all of these facts hold; none: never.
  void forbid(int action, const std::vector<int>& facts);

  /// No plan begins like that.
  void forbidBeginning(const std::vector<int>& actions);

  const GroundProblem& problem() const { return ground_; }
  long expansions() const { return expansions_; }
  std::size_t states() const { return states_.size(); }

  /// The least number of actions from the start to the goal, under what is forbidden; LandmarkCut::kNever if none.
  int distance();

 private:
  struct Edge {
    int action, to;
  };
  struct StateInfo {
    FactSet facts;
    int bound = -1;  ///< the goal is at least that far; -1: not yet known
    bool exact = false, expanded = false, on_path = false, is_goal = false;
    std::vector<Edge> edges;
  };
  struct Step {
    int state;
    std::size_t next;
  };
  struct Stopped {};  ///< thrown where effort ends

  int stateOf(const FactSet& facts);
  int bound(int state);
  const std::vector<Edge>& edges(int state);
  bool isForbidden(int action, const FactSet& facts) const;
  int exactDistance(int state);
  bool advance();
  void restart();
  void leave();
  bool beginsForbidden() const;

  GroundProblem ground_;
  Options options_;
  LandmarkCut landmarks_;
  std::vector<StateInfo> states_;
  std::unordered_map<std::uint64_t, std::vector<int>> by_hash_;
  std::unordered_map<int, std::vector<std::vector<int>>> forbidden_;
  std::set<std::vector<int>> beginnings_;
  std::set<std::vector<int>> told_;  ///< plans since something was forbidden, or before
  std::vector<Step> path_;
  std::vector<int> actions_;
  int length_ = 0, next_length_ = 0;
  long expansions_ = 0;
  Status status_ = Status::found;
};

}  // namespace kinegraph
