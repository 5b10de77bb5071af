#include "kinegraph/logic/landmark_cut.h"

#include <algorithm>

namespace kinegraph {

namespace {

/// Removes duplicates, because a cut would reduce the cost of an operator twice that needs a node twice.
void pushOnce(std::vector<int>& nodes, int node) {
  if (std::ranges::find(nodes, node) == nodes.end()) nodes.push_back(node);
}

}  // namespace

LandmarkCut::LandmarkCut(const GroundProblem& ground) : ground_(ground), negation_(ground.facts.size(), -1) {
  nodes_ = int(ground.facts.size());
  always_ = nodes_++;
  goal_ = nodes_++;
  for (const auto* list : {&ground.actions, &ground.rules}) {
    for (const GroundRule& rule : *list) {
      for (int fact : rule.pre_not) negation(fact);
    }
  }
  for (int fact : ground.goal_not) negation(fact);
  for (const GroundRule& action : ground.actions) addOperator(action, 1);
  for (const GroundRule& rule : ground.rules) addOperator(rule, 0);
  Operator end{ground.goal, {goal_}, 0};
  for (int fact : ground.goal_not) pushOnce(end.pre, negation(fact));
  if (end.pre.empty()) end.pre.push_back(always_);
  operators_.push_back(std::move(end));
}

int LandmarkCut::negation(int fact) {
  int& node = negation_[std::size_t(fact)];
  if (node < 0) {
    node = nodes_++;
    linked_ = false;
  }
  return node;
}

void LandmarkCut::addOperator(const GroundRule& rule, int cost) {
  Operator made{{}, rule.adds, cost};
  for (int fact : rule.pre) pushOnce(made.pre, fact);
  for (int fact : rule.pre_not) pushOnce(made.pre, negation(fact));
  if (made.pre.empty()) made.pre.push_back(always_);
  operators_.push_back(std::move(made));
}

void LandmarkCut::require(int action, int fact_not) {
  pushOnce(operators_[std::size_t(action)].pre, negation(fact_not));
  linked_ = false;
}

/// Lists the operators that need and add each node; deletes add a negation that is needed.
void LandmarkCut::link() {
  const std::size_t actions = ground_.actions.size();
  needed_by_.assign(std::size_t(nodes_), {});
  added_by_.assign(std::size_t(nodes_), {});
  for (std::size_t o = 0; o < operators_.size(); ++o) {
    Operator& op = operators_[o];
    if (o + 1 < operators_.size()) {
      const GroundRule& rule = o < actions ? ground_.actions[o] : ground_.rules[o - actions];
      op.adds = rule.adds;
      for (int fact : rule.deletes) {
        if (negation_[std::size_t(fact)] >= 0) op.adds.push_back(negation_[std::size_t(fact)]);
      }
    }
    for (int node : op.pre) needed_by_[std::size_t(node)].push_back(int(o));
    for (int node : op.adds) added_by_[std::size_t(node)].push_back(int(o));
  }
  linked_ = true;
}

/// Finds the supporter with the largest value of each operator; false if the goal is unreachable.
bool LandmarkCut::explore(const std::vector<int>& begin) {
  value_.assign(std::size_t(nodes_), kNever);
  supporter_.assign(operators_.size(), -1);
  missing_.resize(operators_.size());
  for (std::size_t o = 0; o < operators_.size(); ++o) missing_[o] = int(operators_[o].pre.size());
  for (auto& list : bucket_) list.clear();
  if (bucket_.empty()) bucket_.resize(1);
  for (int node : begin) {
    value_[std::size_t(node)] = 0;
    bucket_[0].push_back(node);
  }
  for (std::size_t c = 0; c < bucket_.size(); ++c) {
    for (std::size_t i = 0; i < bucket_[c].size(); ++i) {
      const int node = bucket_[c][i];
      if (value_[std::size_t(node)] != int(c)) continue;
      for (int o : needed_by_[std::size_t(node)]) {
        if (--missing_[std::size_t(o)] > 0) continue;
        supporter_[std::size_t(o)] = node;
        const int value = int(c) + cost_[std::size_t(o)];
        for (int add : operators_[std::size_t(o)].adds) {
          if (value >= value_[std::size_t(add)]) continue;
          value_[std::size_t(add)] = value;
          if (std::size_t(value) >= bucket_.size()) bucket_.resize(std::size_t(value) + 1);
          bucket_[std::size_t(value)].push_back(add);
        }
      }
    }
  }
  return value_[std::size_t(goal_)] < kNever;
}

/// Reduces the cost of the operators that enter the zone with free paths to the goal. Returns the reduction.
int LandmarkCut::cut(const std::vector<int>& begin) {
  zone_.assign(std::size_t(nodes_), 0);
  before_.assign(std::size_t(nodes_), 0);
  std::vector<int> stack = {goal_};
  zone_[std::size_t(goal_)] = 1;
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (int o : added_by_[std::size_t(node)]) {
      const int from = supporter_[std::size_t(o)];
      if (from < 0 || cost_[std::size_t(o)] > 0 || zone_[std::size_t(from)]) continue;
      zone_[std::size_t(from)] = 1;
      stack.push_back(from);
    }
  }
  std::vector<int> leading;
  stack = begin;
  for (int node : begin) before_[std::size_t(node)] = 1;
  while (!stack.empty()) {
    const int node = stack.back();
    stack.pop_back();
    for (int o : needed_by_[std::size_t(node)]) {
      if (supporter_[std::size_t(o)] != node) continue;
      const std::vector<int>& adds = operators_[std::size_t(o)].adds;
      if (std::ranges::any_of(adds, [&](int add) { return zone_[std::size_t(add)]; })) {
        leading.push_back(o);
        continue;
      }
      for (int add : adds) {
        if (before_[std::size_t(add)]) continue;
        before_[std::size_t(add)] = 1;
        stack.push_back(add);
      }
    }
  }
  int least = kNever;
  for (int o : leading) least = std::min(least, cost_[std::size_t(o)]);
  for (int o : leading) cost_[std::size_t(o)] -= least;
  return least;
}

int LandmarkCut::operator()(const FactSet& state) {
  if (!ground_.unreachable.empty()) return kNever;
  if (!linked_) link();
  std::vector<int> begin = {always_};
  for (std::size_t fact = 0; fact < negation_.size(); ++fact) {
    if (state.has(int(fact))) {
      begin.push_back(int(fact));
    } else if (negation_[fact] >= 0) {
      begin.push_back(negation_[fact]);
    }
  }
  cost_.resize(operators_.size());
  for (std::size_t o = 0; o < operators_.size(); ++o) cost_[o] = operators_[o].cost;
  int sum = 0;
  while (explore(begin)) {
    if (value_[std::size_t(goal_)] == 0) return sum;
    sum += cut(begin);
  }
  return kNever;
}

}  // namespace kinegraph
