#include "kinegraph/logic/fact_join.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline logic_internal {

namespace {

int valueOf(int argument, const std::vector<int>& binding) {
  return argument >= 0 ? binding[std::size_t(argument)] : -1 - argument;
}

}  // namespace

int FactJoin::addPredicate(std::size_t arguments, bool is_static) {
  facts_.emplace_back();
  facts_.back().arity = arguments;
  facts_.back().is_static = is_static;
  return int(facts_.size()) - 1;
}

bool FactJoin::addFact(int predicate, FactTuple tuple) {
  Facts& facts = facts_[std::size_t(predicate)];
  if (!facts.known.insert(tuple).second) return false;
  facts.list.push_back(std::move(tuple));
  if (!facts.is_static) queue_.emplace_back(predicate, int(facts.list.size()) - 1);
  return true;
}

/// Estimates the number of facts that match an atom if some variables are bound.
double FactJoin::costOf(const Atom& atom, const std::vector<char>& bound) const {
  const Facts& facts = facts_[std::size_t(atom.predicate)];
  double free = 0;
  for (int argument : atom.arguments)
    free += argument == kAnyConstant || (argument >= 0 && !bound[std::size_t(argument)]) ? 1 : 0;
  const double arity = std::max(1., double(atom.arguments.size()));
  const double count = facts.is_static ? double(facts.list.size()) : 1e3 * arity;
  return free == 0 ? 0 : std::pow(count + 1, free / arity);
}

FactJoin::Plan FactJoin::planOf(int number, int trigger) const {
  const Rule& rule = rules_[std::size_t(number)];
  Plan plan{number, trigger, {}};
  std::vector<char> bound(std::size_t(rule.variables), 0), used(rule.body.size(), 0);
  const auto use = [&](std::size_t i) {
    used[i] = 1;
    for (int argument : rule.body[i].arguments) {
      if (argument >= 0) bound[std::size_t(argument)] = 1;
    }
  };
  if (trigger >= 0) use(std::size_t(trigger));
  for (std::size_t left = rule.body.size() - (trigger >= 0 ? 1 : 0); left > 0; --left) {
    std::size_t best = rule.body.size();
    double best_cost = 0;
    for (std::size_t i = 0; i < rule.body.size(); ++i) {
      if (used[i]) continue;
      const double cost = costOf(rule.body[i], bound);
      if (best == rule.body.size() || cost < best_cost) best = i, best_cost = cost;
    }
    Step step{int(best), 0};
    const std::vector<int>& arguments = rule.body[best].arguments;
    for (std::size_t k = 0; k < arguments.size() && k < 64; ++k) {
      if (arguments[k] == kAnyConstant) continue;
      if (arguments[k] < 0 || bound[std::size_t(arguments[k])]) step.bound |= std::uint64_t(1) << k;
    }
    use(best);
    plan.steps.push_back(step);
  }
  return plan;
}

/// A rule is triggered by facts that can follow; a rule without such literals is joined once.
void FactJoin::makePlans() {
  plans_.assign(facts_.size() + 1, {});
  for (std::size_t r = 0; r < rules_.size(); ++r) {
    bool triggered = false;
    for (std::size_t i = 0; i < rules_[r].body.size(); ++i) {
      const int predicate = rules_[r].body[i].predicate;
      if (facts_[std::size_t(predicate)].is_static) continue;
      plans_[std::size_t(predicate)].push_back(planOf(int(r), int(i)));
      triggered = true;
    }
    if (!triggered) plans_.back().push_back(planOf(int(r), -1));
  }
  for (auto& plans : plans_) {
    for (const Plan& plan : plans) {
      for (const Step& step : plan.steps) {
        const Atom& atom = rules_[std::size_t(plan.rule)].body[std::size_t(step.atom)];
        facts_[std::size_t(atom.predicate)].indices[step.bound];
      }
    }
  }
}

/// Lets the next fact of a list take part in joins.
void FactJoin::joinNext(Facts& facts) {
  const int number = int(facts.joined++);
  const FactTuple& fact = facts.list[std::size_t(number)];
  FactTuple key;
  for (auto& [bound, index] : facts.indices) {
    key.clear();
    for (std::size_t k = 0; k < fact.size() && k < 64; ++k) {
      if (bound >> k & 1) key.push_back(fact[k]);
    }
    index[key].push_back(number);
  }
}

bool FactJoin::bind(const Rule& rule, const Atom& atom, const FactTuple& fact, std::vector<int>& binding) const {
  for (std::size_t i = 0; i < fact.size(); ++i) {
    const int argument = atom.arguments[i];
    if (argument == kAnyConstant) continue;
    if (argument < 0) {
      if (-1 - argument != fact[i]) return false;
      continue;
    }
    int& value = binding[std::size_t(argument)];
    if (value >= 0) {
      if (value != fact[i]) return false;
      continue;
    }
    if (rule.distinct && std::ranges::find(binding, fact[i]) != binding.end()) return false;
    value = fact[i];
  }
  return true;
}

void FactJoin::join(const Plan& plan, std::size_t number, std::vector<int>& binding) {
  const Rule& rule = rules_[std::size_t(plan.rule)];
  if (number == plan.steps.size()) return finish(rule, binding);
  const Step& step = plan.steps[number];
  const Atom& atom = rule.body[std::size_t(step.atom)];
  const Facts& facts = facts_[std::size_t(atom.predicate)];
  FactTuple key;
  for (std::size_t k = 0; k < atom.arguments.size() && k < 64; ++k) {
    if (step.bound >> k & 1) key.push_back(valueOf(atom.arguments[k], binding));
  }
  const Index& index = facts.indices.at(step.bound);
  const auto matching = index.find(key);
  if (matching == index.end()) return;
  spend_(rule.owner, matching->second.size());
  const std::vector<int> before = binding;
  for (int fact : matching->second) {
    if (bind(rule, atom, facts.list[std::size_t(fact)], binding)) join(plan, number + 1, binding);
    binding = before;
  }
}

void FactJoin::finish(const Rule& rule, const std::vector<int>& binding) {
  for (const Equality& equality : rule.equalities) {
    if ((valueOf(equality.a, binding) == valueOf(equality.b, binding)) != equality.equal) return;
  }
  for (const Atom& head : rule.heads) {
    FactTuple tuple;
    for (int argument : head.arguments) tuple.push_back(valueOf(argument, binding));
    if (addFact(head.predicate, std::move(tuple))) report_(rule.owner, head.predicate);
  }
}

void FactJoin::run(std::function<void(int, std::size_t)> spend, std::function<void(int, int)> found) {
  spend_ = std::move(spend);
  report_ = std::move(found);
  makePlans();
  for (Facts& facts : facts_) {
    while (facts.is_static && facts.joined < facts.list.size()) joinNext(facts);
  }
  std::vector<int> binding;
  for (const Plan& plan : plans_.back()) {
    binding.assign(std::size_t(rules_[std::size_t(plan.rule)].variables), -1);
    join(plan, 0, binding);
  }
  for (std::size_t next = 0; next < queue_.size(); ++next) {  // grows
    const auto [predicate, number] = queue_[next];
    joinNext(facts_[std::size_t(predicate)]);
    for (const Plan& plan : plans_[std::size_t(predicate)]) {
      const Rule& rule = rules_[std::size_t(plan.rule)];
      binding.assign(std::size_t(rule.variables), -1);
      const FactTuple fact = facts_[std::size_t(predicate)].list[std::size_t(number)];
      if (bind(rule, rule.body[std::size_t(plan.trigger)], fact, binding)) join(plan, 0, binding);
    }
  }
}

}  // namespace kinegraph::inline logic_internal
