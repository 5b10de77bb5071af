#include "kinegraph/logic/plan_search.h"

#include <algorithm>
#include <queue>
#include <tuple>

#include "kinegraph/logic/landmark_cut.h"

namespace kinegraph {

namespace {

constexpr LandmarkCut::Cost kNever = LandmarkCut::kNever;
constexpr long kAskEvery = 64;                  ///< expansions
constexpr LandmarkCut::Cost kLonger = 1 << 20;  ///< actions; a unit of cost outweighs them

/// Whether the shortest plans are the cheapest.
bool haveEqualCosts(const GroundProblem& ground) {
  return std::ranges::all_of(ground.actions,
                             [&](const GroundRule& action) { return action.cost == ground.actions.front().cost; });
}

/// Costs such that the least sum is cheapest, and of these shortest.
std::vector<LandmarkCut::Cost> searchCosts(const GroundProblem& ground) {
  std::vector<LandmarkCut::Cost> costs;
  const bool equal = haveEqualCosts(ground);
  for (const GroundRule& action : ground.actions) costs.push_back(equal ? 1 : action.cost * kLonger + 1);
  return costs;
}

}  // namespace

PlanSearch::PlanSearch(GroundProblem ground) : PlanSearch(std::move(ground), Options()) {}

PlanSearch::PlanSearch(GroundProblem ground, Options options)
    : ground_(std::move(ground)),
      options_(std::move(options)),
      costs_(searchCosts(ground_)),
      landmarks_(std::make_unique<LandmarkCut>(ground_, costs_)) {
  listActions();
  stateOf(ground_.start);
}

PlanSearch::~PlanSearch() = default;

/// Lists each action at one of its preconditions, the one with the fewest actions so far.
void PlanSearch::listActions() {
  needing_.resize(ground_.facts.size());
  for (std::size_t a = 0; a < ground_.actions.size(); ++a) {
    const std::vector<int>& pre = ground_.actions[a].pre;
    const auto least = std::ranges::min_element(pre, {}, [&](int fact) { return needing_[std::size_t(fact)].size(); });
    (least == pre.end() ? unneeding_ : needing_[std::size_t(*least)]).push_back(int(a));
  }
}

int PlanSearch::stateOf(const FactSet& facts) {
  std::vector<int>& same = by_hash_[facts.hash()];
  for (int state : same) {
    if (states_[std::size_t(state)].facts == facts) return state;
  }
  same.push_back(int(states_.size()));
  states_.emplace_back();
  states_.back().facts = facts;
  states_.back().is_goal = ground_.isGoal(facts);
  return same.back();
}

PlanSearch::Cost PlanSearch::bound(int state) {
  StateInfo& info = states_[std::size_t(state)];
  if (info.bound < 0) {
    info.bound = info.is_goal ? 0 : (*landmarks_)(info.facts);
    info.exact = info.is_goal || info.bound >= kNever;
  }
  return info.bound;
}

bool PlanSearch::isForbidden(int action, const FactSet& facts) const {
  const auto found = forbidden_.find(action);
  if (found == forbidden_.end()) return false;
  return std::ranges::any_of(found->second, [&](const std::vector<int>& nogood) {
    return std::ranges::all_of(nogood, [&](int fact) { return facts.has(fact); });
  });
}

const std::vector<PlanSearch::Edge>& PlanSearch::edges(int state) {
  if (!states_[std::size_t(state)].expanded) {
    ++expansions_;
    if (most_to_order_ > 0 && expansions_ > most_to_order_) throw Unresolved();
    if (expansions_ > options_.max_expansions) {
      status_ = Status::limit;
      throw Stopped();
    }
    if (expansions_ % kAskEvery == 0 && options_.cancellation.isCancelled()) {
      status_ = Status::cancelled;
      throw Stopped();
    }
    std::vector<Edge> list;
    const FactSet facts = states_[std::size_t(state)].facts;
    candidates_ = unneeding_;
    for (std::size_t fact = 0; fact < needing_.size(); ++fact) {
      if (facts.has(int(fact))) candidates_.insert(candidates_.end(), needing_[fact].begin(), needing_[fact].end());
    }
    std::erase_if(candidates_, [&](int a) { return !ground_.isApplicable(ground_.actions[std::size_t(a)], facts); });
    std::ranges::sort(candidates_);
    for (int a : candidates_) {
      const int to = stateOf(ground_.apply(a, facts));
      if (to != state) list.push_back({a, to});
    }
    states_[std::size_t(state)].edges = std::move(list);
    states_[std::size_t(state)].expanded = true;
  }
  return states_[std::size_t(state)].edges;
}

/// A* from a state. Each expanded state gets a bound on its own distance.
PlanSearch::Cost PlanSearch::exactDistance(int state) {
  if (bound(state), states_[std::size_t(state)].exact) return states_[std::size_t(state)].bound;
  using Entry = std::tuple<Cost, Cost, long, int>;  // g + bound, -g, order, state
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  std::unordered_map<int, std::pair<Cost, int>> reached;  // state -> g, before
  std::vector<int> closed;
  long order = 0;
  reached[state] = {0, -1};
  open.push({bound(state), 0, order++, state});
  while (!open.empty()) {
    const auto [f, minus_g, number, s] = open.top();
    open.pop();
    const Cost g = -minus_g;
    if (g > reached[s].first) continue;
    if (states_[std::size_t(s)].exact) {
      const Cost total = g + states_[std::size_t(s)].bound;
      if (total > f) {  // outdated entry
        open.push({total, minus_g, order++, s});
        continue;
      }
      for (int c : closed) {
        StateInfo& info = states_[std::size_t(c)];
        info.bound = std::max(info.bound, total - reached[c].first);
      }
      for (int at = s; at >= 0; at = reached[at].second) {
        states_[std::size_t(at)].exact = true;
        states_[std::size_t(at)].bound = total - reached[at].first;
      }
      return total;
    }
    closed.push_back(s);
    for (const Edge& edge : edges(s)) {
      if (isForbidden(edge.action, states_[std::size_t(s)].facts)) continue;
      const Cost rest = bound(edge.to);
      if (rest >= kNever) continue;
      const Cost next = g + costs_[std::size_t(edge.action)];
      const auto known = reached.find(edge.to);
      if (known != reached.end() && known->second.first <= next) continue;
      reached[edge.to] = {next, s};
      open.push({next + rest, -next, order++, edge.to});
    }
  }
  for (int c : closed) {  // the goal is unreachable from all of them
    states_[std::size_t(c)].bound = kNever;
    states_[std::size_t(c)].exact = true;
  }
  return kNever;
}

double PlanSearch::distance() {
  Cost least = 0;
  try {
    least = exactDistance(0);
  } catch (Stopped) {
    least = bound(0);
  }
  if (least >= kNever) return std::numeric_limits<double>::infinity();
  if (!haveEqualCosts(ground_)) return double(least / kLonger) * ground_.cost_unit;
  return double(least) * (ground_.actions.empty() ? 1 : double(ground_.actions.front().cost) * ground_.cost_unit);
}

void PlanSearch::forbid(int action, const std::vector<int>& facts) {
  forbidden_[action].push_back(facts);
  if (facts.size() == 1) landmarks_->require(action, facts.front());
  restart();
}

void PlanSearch::forbidBeginning(const std::vector<int>& actions) {
  beginnings_.insert(actions);
  restart();
}

/// Forbidding only increases distances, so they remain bounds. No plan is returned twice.
void PlanSearch::restart() {
  for (StateInfo& info : states_) {
    info.exact = info.is_goal || (info.exact && info.bound >= kNever);
    info.on_path = false;
  }
  path_.clear();
  actions_.clear();
  used_ = length_ = 0;
}

bool PlanSearch::beginsForbidden() const { return !beginnings_.empty() && beginnings_.contains(actions_); }

void PlanSearch::leave() {
  states_[std::size_t(path_.back().state)].on_path = false;
  path_.pop_back();
  if (actions_.empty()) return;
  used_ -= costs_[std::size_t(actions_.back())];
  actions_.pop_back();
}

/// Advances to the next plan of the current length; false if there is none.
bool PlanSearch::advance() {
  while (!path_.empty()) {
    const int state = path_.back().state;
    const std::vector<Edge>& list = edges(state);
    if (states_[std::size_t(state)].is_goal || path_.back().next >= list.size()) {
      leave();
      continue;
    }
    const Edge edge = list[path_.back().next++];
    if (states_[std::size_t(edge.to)].on_path || isForbidden(edge.action, states_[std::size_t(state)].facts)) continue;
    const Cost cost = costs_[std::size_t(edge.action)];
    Cost total = used_ + cost + bound(edge.to);
    if (total <= length_) total = used_ + cost + exactDistance(edge.to);
    if (total > length_) {
      next_length_ = std::min(next_length_, total);
      continue;
    }
    actions_.push_back(edge.action);
    if (beginsForbidden()) {
      actions_.pop_back();
      continue;
    }
    used_ += cost;
    path_.push_back({edge.to, 0});
    states_[std::size_t(edge.to)].on_path = true;
    if (states_[std::size_t(edge.to)].is_goal && used_ == length_ && returned_.insert(actions_).second) return true;
  }
  return false;
}

/// The plan along states whose distances are exact, as after exactDistance(0).
std::vector<int> PlanSearch::planOfDistances() {
  std::vector<int> plan;
  for (int state = 0; !states_[std::size_t(state)].is_goal;) {
    const Cost rest = states_[std::size_t(state)].bound;
    const std::vector<Edge>& list = edges(state);
    const auto next = std::ranges::find_if(list, [&](const Edge& edge) {
      const StateInfo& to = states_[std::size_t(edge.to)];
      return to.exact && costs_[std::size_t(edge.action)] + to.bound == rest &&
             !isForbidden(edge.action, states_[std::size_t(state)].facts);
    });
    if (next == list.end()) return {};
    plan.push_back(next->action);
    state = next->to;
  }
  return plan;
}

/// Advances to the first plan in the order of actions. If that would cost more than the plan itself, `actions_` becomes
/// the plan that A* found, and the enumeration begins again behind it.
bool PlanSearch::advanceToFirst() {
  std::vector<int> plan = beginnings_.empty() ? planOfDistances() : std::vector<int>();
  most_to_order_ = 0;
  if (!plan.empty() && !returned_.contains(plan)) {
    const long most = expansions_ + std::max(options_.order_expansions, expansions_ / 4);
    most_to_order_ = std::min(most, options_.max_expansions);  // the plan is known: no limit hides it
  }
  try {
    const bool found = advance();
    most_to_order_ = 0;
    return found;
  } catch (Unresolved) {
    most_to_order_ = 0;
    for (StateInfo& info : states_) info.on_path = false;
    path_.clear();
    used_ = 0;
    actions_ = std::move(plan);
    returned_.insert(actions_);
    return true;
  }
}

/// Leaves the path, so that the next call finds what was not returned yet.
void PlanSearch::beginAgain() {
  for (StateInfo& info : states_) info.on_path = false;
  path_.clear();
  actions_.clear();
  used_ = 0;
  most_to_order_ = 0;
}

std::optional<std::vector<int>> PlanSearch::next() {
  status_ = Status::found;
  try {
    if (path_.empty()) {
      actions_.clear();
      length_ = next_length_ = exactDistance(0);
    } else if (advance()) {
      return actions_;
    }
    while (next_length_ < kNever) {
      length_ = next_length_;
      next_length_ = kNever;
      path_ = {{0, 0}};
      states_[0].on_path = true;
      if (states_[0].is_goal && returned_.insert(actions_).second) return actions_;
      if (advanceToFirst()) return actions_;
    }
    status_ = Status::exhausted;
  } catch (Stopped) {
    beginAgain();
  } catch (...) {  // of the cancellation: the next call goes on, too
    beginAgain();
    throw;
  }
  return std::nullopt;
}

}  // namespace kinegraph
