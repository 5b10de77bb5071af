#include "kinegraph/logic/landmark_cut.h"

#include <algorithm>

namespace kinegraph::inline logic_internal {

namespace {

constexpr LandmarkCut::Cost kLargestBucket = 1000;

/// Removes duplicates, because an operator waits for each of its nodes once.
void pushOnce(std::vector<int>& nodes, int node) {
  if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
}

}  // namespace

NumberLists::NumberLists(const std::vector<std::vector<int>>& lists) {
  begin_.reserve(lists.size() + 1);
  for (const std::vector<int>& list : lists) {
    begin_.push_back(int(numbers_.size()));
    numbers_.insert(numbers_.end(), list.begin(), list.end());
  }
  begin_.push_back(int(numbers_.size()));
}

LandmarkCut::LandmarkCut(const GroundProblem& ground)
    : LandmarkCut(ground, std::vector<Cost>(ground.actions.size(), 1)) {}

LandmarkCut::LandmarkCut(const GroundProblem& ground, const std::vector<Cost>& costs)
    : ground_(ground), costs_(costs), negation_(ground.facts.size(), -1) {
  nodes_ = int(ground.facts.size() + ground.disjunctions.size());
  always_ = nodes_++;
  goal_ = nodes_++;
  is_derived_.assign(ground.facts.size(), 0);
  for (Cost cost : costs) small_ &= cost <= kLargestBucket;
  const GroundCondition end{ground.goal, ground.goal_not, ground.goal_any};
  for (const auto* list : {&ground.actions, &ground.rules}) {
    for (const GroundRule& rule : *list) {
      prepareNegations(rule);
      for (const GroundEffect& effect : rule.when) prepareNegations(effect.when);
    }
  }
  for (const auto& layer : ground.derived) {
    for (const GroundRule& rule : layer) {
      prepareNegations(rule);
      is_derived_[std::size_t(rule.adds.front())] = 1;
    }
  }
  for (const auto& alternatives : ground.disjunctions) {
    for (const GroundCondition& one : alternatives) prepareNegations(one);
  }
  prepareNegations(end);
  for (std::size_t a = 0; a < ground.actions.size(); ++a) addOperators(ground.actions[a], int(a));
  for (const GroundRule& rule : ground.rules) addOperators(rule, -1);
  for (const auto& layer : ground.derived) {
    for (const GroundRule& rule : layer) addOperators(rule, -1);
  }
  for (std::size_t d = 0; d < ground.disjunctions.size(); ++d) {
    for (const GroundCondition& one : ground.disjunctions[d]) addOperator({&one}, {disjunctionNode(int(d))}, {}, -1);
  }
  addOperator({&end}, {goal_}, {}, -1);
}

int LandmarkCut::negation(int fact) {
  int& node = negation_[std::size_t(fact)];
  if (node < 0) {
    node = nodes_++;
    linked_ = false;
  }
  return node;
}

void LandmarkCut::prepareNegations(const GroundCondition& condition) {
  for (int fact : condition.pre_not) negation(fact);
}

void LandmarkCut::addOperator(const std::vector<const GroundCondition*>& conditions, const std::vector<int>& adds,
                              const std::vector<int>& deletes, int owner) {
  Operator made{{}, adds, deletes, owner};
  for (const GroundCondition* condition : conditions) {
    for (int fact : condition->pre) pushOnce(made.pre, fact);
    for (int fact : condition->pre_not) pushOnce(made.pre, negation(fact));
    for (int number : condition->any) pushOnce(made.pre, disjunctionNode(number));
  }
  if (made.pre.empty()) made.pre.push_back(always_);
  operators_.push_back(std::move(made));
}

void LandmarkCut::addOperators(const GroundRule& rule, int owner) {
  addOperator({&rule}, rule.adds, rule.deletes, owner);
  for (const GroundEffect& effect : rule.when) addOperator({&rule, &effect.when}, effect.adds, effect.deletes, owner);
}

void LandmarkCut::require(int action, int fact_not) {
  const int node = negation(fact_not);
  for (Operator& op : operators_) {
    if (op.owner == action) pushOnce(op.pre, node);
  }
  linked_ = false;
}

/// Lists the operators of each node and action; deletes add a negation that is needed. Preconditions that few operators
/// add come first: of those with the largest value, they become supporters, because their landmarks are small.
void LandmarkCut::link() {
  std::vector<std::vector<int>> pre, adds;
  std::vector<std::vector<int>> needed_by, owned_by;
  needed_by.resize(std::size_t(nodes_));
  owned_by.resize(costs_.size());
  std::vector<int> added_by(std::size_t(nodes_), 0);
  owner_.clear();
  always_free_.clear();
  for (std::size_t o = 0; o < operators_.size(); ++o) {
    Operator& op = operators_[o];
    for (int fact : op.deletes) {
      if (negation_[std::size_t(fact)] >= 0) pushOnce(op.adds, negation_[std::size_t(fact)]);
    }
    for (int node : op.pre) needed_by[std::size_t(node)].push_back(int(o));
    if (op.owner >= 0) owned_by[std::size_t(op.owner)].push_back(int(o));
    if (op.owner < 0 || costs_[std::size_t(op.owner)] == 0) always_free_.push_back(int(o));
    owner_.push_back(op.owner);
    for (int node : op.adds) ++added_by[std::size_t(node)];
    adds.push_back(op.adds);
  }
  for (Operator& op : operators_) {
    std::ranges::stable_sort(op.pre, {}, [&](int node) { return added_by[std::size_t(node)]; });
    pre.push_back(op.pre);
  }
  pre_ = NumberLists(pre);
  adds_ = NumberLists(adds);
  needed_by_ = NumberLists(needed_by);
  owned_by_ = NumberLists(owned_by);
  linked_ = true;
}

/// Lowers the value of a node.
void LandmarkCut::reach(int node, Cost value) {
  if (value >= value_[std::size_t(node)]) return;
  value_[std::size_t(node)] = value;
  if (!small_) {
    heap_.emplace_back(-value, node);
    std::ranges::push_heap(heap_);
    return;
  }
  if (std::size_t(value) >= bucket_.size()) bucket_.resize(std::size_t(value) + 1);
  bucket_[std::size_t(value)].push_back(node);
  at_ = std::min(at_, std::size_t(value));
}

/// Removes the entry with the least value and returns the value; kNever if there is none.
LandmarkCut::Cost LandmarkCut::popped(int& node) {
  if (!small_) {
    if (heap_.empty()) return kNever;
    std::ranges::pop_heap(heap_);
    const Cost value = -heap_.back().first;
    node = heap_.back().second;
    heap_.pop_back();
    return value;
  }
  while (at_ < bucket_.size() && bucket_[at_].empty()) ++at_;
  if (at_ >= bucket_.size()) return kNever;
  node = bucket_[at_].back();
  bucket_[at_].pop_back();
  return Cost(at_);
}

/// Computes the values of all nodes and the supporter of each operator, its precondition with the largest value.
void LandmarkCut::explore(const std::vector<int>& begin) {
  value_.assign(std::size_t(nodes_), kNever);
  supporter_.assign(operators_.size(), -1);
  supporter_value_.assign(operators_.size(), kNever);
  missing_.resize(operators_.size());
  for (std::size_t o = 0; o < operators_.size(); ++o) missing_[o] = int(pre_[int(o)].size());
  at_ = 0;
  for (int node : begin) reach(node, 0);
  int node = 0;
  for (Cost value = popped(node); value < kNever; value = popped(node)) {
    if (value_[std::size_t(node)] != value) continue;
    for (int o : needed_by_[node]) {
      if (--missing_[std::size_t(o)] > 0) continue;
      findSupporter(o);
      const Cost next = value + costOf(o);
      for (int add : adds_[o]) reach(add, next);
    }
  }
}

void LandmarkCut::findSupporter(int op) {
  Cost most = -1;
  for (int node : pre_[op]) {
    if (value_[std::size_t(node)] <= most) continue;
    most = value_[std::size_t(node)];
    supporter_[std::size_t(op)] = node;
  }
  supporter_value_[std::size_t(op)] = most;
}

/// Updates values and supporters after the costs of some operators fell.
void LandmarkCut::exploreAgain(const std::vector<int>& changed) {
  at_ = bucket_.size();
  for (int o : changed) {
    if (supporter_[std::size_t(o)] < 0) continue;
    const Cost next = supporter_value_[std::size_t(o)] + costOf(o);
    for (int add : adds_[o]) reach(add, next);
  }
  int node = 0;
  for (Cost value = popped(node); value < kNever; value = popped(node)) {
    if (value_[std::size_t(node)] != value) continue;
    for (int o : needed_by_[node]) {
      if (supporter_[std::size_t(o)] != node || supporter_value_[std::size_t(o)] <= value) continue;
      const Cost before = supporter_value_[std::size_t(o)];
      findSupporter(o);
      if (supporter_value_[std::size_t(o)] == before) continue;
      const Cost next = supporter_value_[std::size_t(o)] + costOf(o);
      for (int add : adds_[o]) reach(add, next);
    }
  }
}

/// Lists an operator that costs nothing at the nodes that it adds.
void LandmarkCut::addFree(int op) {
  for (int add : adds_[op]) {
    free_.push_back({op, free_by_[std::size_t(add)]});
    free_by_[std::size_t(add)] = int(free_.size()) - 1;
  }
}

/// Marks the nodes with free paths to the goal.
void LandmarkCut::markZone() {
  zone_.assign(std::size_t(nodes_), 0);
  std::vector<int> stack = {goal_};
  zone_[std::size_t(goal_)] = 1;
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (int i = free_by_[std::size_t(node)]; i >= 0; i = free_[std::size_t(i)].next) {
      const int from = supporter_[std::size_t(free_[std::size_t(i)].op)];
      if (from < 0 || zone_[std::size_t(from)]) continue;
      zone_[std::size_t(from)] = 1;
      stack.push_back(from);
    }
  }
}

/// Reduces the cost of the actions that enter the zone. Returns the reduction.
LandmarkCut::Cost LandmarkCut::cut(const std::vector<int>& begin, std::vector<int>& changed) {
  markZone();
  before_.assign(std::size_t(nodes_), 0);
  std::vector<int> leading, stack = begin;
  for (int node : begin) before_[std::size_t(node)] = 1;
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (int o : needed_by_[node]) {
      if (supporter_[std::size_t(o)] != node) continue;
      const std::span<const int> adds = adds_[o];
      if (std::ranges::any_of(adds, [&](int add) { return zone_[std::size_t(add)]; })) {
        leading.push_back(owner_[std::size_t(o)]);
        continue;
      }
      for (int add : adds) {
        if (before_[std::size_t(add)]) continue;
        before_[std::size_t(add)] = 1;
        stack.push_back(add);
      }
    }
  }
  return payFor(leading, changed);
}

/// Reduces the costs of actions by the least of them, and lists their operators.
LandmarkCut::Cost LandmarkCut::payFor(std::vector<int>& leading, std::vector<int>& changed) {
  std::ranges::sort(leading);
  leading.erase(std::unique(leading.begin(), leading.end()), leading.end());
  Cost least = kNever;
  for (int owner : leading) least = std::min(least, cost_[std::size_t(owner)]);
  changed.clear();
  for (int owner : leading) {
    Cost& cost = cost_[std::size_t(owner)];
    cost -= least;
    for (int o : owned_by_[owner]) {
      changed.push_back(o);
      if (cost == 0) addFree(o);
    }
  }
  return least;
}

LandmarkCut::Cost LandmarkCut::operator()(const FactSet& state) {
  if (!ground_.unreachable.empty() || !ground_.impossible.empty()) return kNever;
  if (!linked_) link();
  std::vector<int> begin = {always_}, changed;
  for (std::size_t fact = 0; fact < negation_.size(); ++fact) {
    if (state.has(int(fact))) begin.push_back(int(fact));
    if (negation_[fact] >= 0 && (is_derived_[fact] || !state.has(int(fact)))) begin.push_back(negation_[fact]);
  }
  cost_ = costs_;
  free_.clear();
  free_by_.assign(std::size_t(nodes_), -1);
  for (int o : always_free_) addFree(o);
  explore(begin);
  Cost sum = 0;
  while (value_[std::size_t(goal_)] < kNever) {
    if (value_[std::size_t(goal_)] == 0) return sum;
    sum += cut(begin, changed);
    exploreAgain(changed);
  }
  return kNever;
}

}  // namespace kinegraph::inline logic_internal
