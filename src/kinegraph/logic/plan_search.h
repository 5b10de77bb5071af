#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "kinegraph/common/cancellation.h"
#include "kinegraph/logic/grounding.h"

namespace kinegraph::inline logic_internal {
class LandmarkCut;
}

namespace kinegraph {

/// Enumerates the plans of a problem: all sequences of actions that end in the first state with the goal and visit no
/// state twice. The shortest come first; if the problem has a metric, the cheapest come first, and of equal cost the
/// shortest. Plans of one cost come in the order of their actions; in large problems, the one that A* found comes
/// before them. The order depends only on the problem and on the forbidden actions.
///
/// Distances to the goal are exact, by A* with a closed list and landmarks. Bounds of other states are reused (Koenig,
/// Likhachev, Adaptive A*, 2005). The enumeration has no dead ends.
class PlanSearch {
 public:
  enum class Status {
    found,
    exhausted,  ///< proved: there is no further plan
    limit,      ///< max_expansions is reached
    cancelled,  ///< the cancellation token ended the search
  };
  struct Options {
    long max_expansions = 2000000;     ///< total number of expanded states
    long order_expansions = 2000;      ///< a quarter of those so far, and at least this many, may order the first plans
    CancellationToken cancellation{};  ///< ends `next` with `cancelled`
  };

  explicit PlanSearch(GroundProblem ground);
  PlanSearch(GroundProblem ground, Options options);
  ~PlanSearch();

  /// Returns the next plan, indices of actions. After a limit, a cancellation, or an exception of the cancellation
  /// token, the next call goes on: no plan is lost.
  std::optional<std::vector<int>> next();

  /// The result of the last `next`.
  Status status() const { return status_; }

  /// Forbids an action in states in which all of these facts hold; without facts, always.
  void forbid(int action, const std::vector<int>& facts);

  /// Forbids plans that begin with these actions.
  void forbidBeginning(const std::vector<int>& actions);

  const GroundProblem& problem() const { return ground_; }
  long expansions() const { return expansions_; }
  std::size_t states() const { return states_.size(); }

  /// Returns the minimum number of allowed actions from the start to the goal, with a metric their minimum cost;
  /// infinity if there is no plan.
  double distance();

 private:
  using Cost = std::int64_t;  ///< of cost and number of actions, see `searchCosts`
  struct Edge {
    int action, to;
  };
  struct StateInfo {
    FactSet facts;
    Cost bound = -1;  ///< lower bound of the distance to the goal; -1: unknown
    bool exact = false, expanded = false, on_path = false, is_goal = false;
    std::vector<Edge> edges;
  };
  struct Step {
    int state;
    std::size_t next;
  };
  struct Stopped {};     ///< thrown at the limit
  struct Unresolved {};  ///< thrown if the order of plans would cost more than the first plan

  int stateOf(const FactSet& facts);
  Cost bound(int state);
  const std::vector<Edge>& edges(int state);
  bool isForbidden(int action, const FactSet& facts) const;
  Cost exactDistance(int state);
  bool advance();
  bool advanceToFirst();
  std::vector<int> planOfDistances();
  void restart();
  void beginAgain();
  void leave();
  bool beginsForbidden() const;

  void listActions();

  GroundProblem ground_;
  Options options_;
  std::vector<Cost> costs_;                  ///< per action
  std::vector<std::vector<int>> needing_;    ///< per fact: actions that are possible only with it
  std::vector<int> unneeding_, candidates_;  ///< the other actions; a buffer
  std::unique_ptr<LandmarkCut> landmarks_;
  std::vector<StateInfo> states_;
  std::unordered_map<std::uint64_t, std::vector<int>> by_hash_;
  std::unordered_map<int, std::vector<std::vector<int>>> forbidden_;
  std::set<std::vector<int>> beginnings_;
  std::set<std::vector<int>> returned_;  ///< all plans so far
  std::vector<Step> path_;
  std::vector<int> actions_;
  Cost used_ = 0, length_ = 0, next_length_ = 0;
  long expansions_ = 0, most_to_order_ = 0;  ///< most_to_order_: then Unresolved is thrown; 0: never
  Status status_ = Status::found;
};

}  // namespace kinegraph
