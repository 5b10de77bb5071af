#include "kinegraph/logic/ground_conditions.h"

#include <algorithm>

namespace kinegraph::inline logic_internal {

namespace {

using Kind = Formula::Kind;
using Atom = FactJoin::Atom;

int constantOrVariable(int argument, const std::vector<int>& binding) {
  return argument == FactJoin::kAnyConstant ? -1 : argument >= 0 ? binding[std::size_t(argument)] : -1 - argument;
}

FactTuple tupleOf(const Atom& atom, const std::vector<int>& binding) {
  FactTuple tuple;
  for (int argument : atom.arguments) tuple.push_back(constantOrVariable(argument, binding));
  return tuple;
}

void append(std::vector<int>& to, const std::vector<int>& from) {
  for (int value : from) {
    if (std::ranges::find(to, value) == to.end()) to.push_back(value);
  }
}

void appendCondition(GroundCondition& to, const GroundCondition& from) {
  append(to.pre, from.pre);
  append(to.pre_not, from.pre_not);
  append(to.any, from.any);
}

}  // namespace

int GroundNames::constant(const std::string& name) {
  const auto [place, fresh] = constant_numbers.try_emplace(name, int(constants.size()));
  if (fresh) constants.push_back(name);
  return place->second;
}

int GroundNames::predicate(const std::string& name, std::size_t arguments) {
  const auto [place, fresh] = predicates.try_emplace({name, arguments}, 0);
  if (fresh) place->second = join.addPredicate(arguments, !changing.contains({name, arguments}));
  return place->second;
}

Atom GroundNames::atom(const Literal& literal, const std::vector<std::string>& scope) {
  Atom made;
  if (literal.predicate != kEqual) made.predicate = predicate(literal.predicate, literal.arguments.size());
  for (const std::string& word : literal.arguments) {
    const auto variable = std::find(scope.rbegin(), scope.rend(), word);
    made.arguments.push_back(variable != scope.rend() ? int(scope.rend() - variable) - 1
                             : word == kAny           ? FactJoin::kAnyConstant
                                                      : -1 - constant(word));
  }
  return made;
}

IndexedFormula indexed(const Formula& formula, std::vector<std::string>& scope, GroundNames& names) {
  IndexedFormula made;
  made.kind = formula.kind;
  if (formula.kind == Kind::literal) {
    made.atom = names.atom(formula.literal, scope);
    made.is_equality = formula.literal.predicate == kEqual;
    made.negated = formula.literal.negated;
    return made;
  }
  made.first = int(scope.size());
  scope.insert(scope.end(), formula.variables.begin(), formula.variables.end());
  for (const std::string& type : formula.types) made.types.push_back(type.empty() ? -1 : names.predicate(type, 1));
  for (const Formula& part : formula.parts) made.parts.push_back(indexed(part, scope, names));
  scope.resize(std::size_t(made.first));
  return made;
}

std::vector<int> ConditionGrounder::matching(const Atom& atom, const std::vector<int>& binding, bool& holds) const {
  std::vector<int> list;
  const FactTuple pattern = tupleOf(atom, binding);
  const bool is_static = names_.join.isStatic(atom.predicate);
  const auto& numbers = names_.fact_numbers[std::size_t(atom.predicate)];
  if (std::ranges::find(pattern, -1) == pattern.end()) {  // without ANY there is at most one
    if (is_static) {
      holds |= names_.join.has(atom.predicate, pattern);
    } else if (const auto found = numbers.find(pattern); found != numbers.end()) {
      list.push_back(found->second);
    }
    return list;
  }
  for (const FactTuple& fact : names_.join.facts(atom.predicate)) {
    bool matches = true;
    for (std::size_t i = 0; i < pattern.size() && matches; ++i) matches = pattern[i] < 0 || pattern[i] == fact[i];
    if (!matches) continue;
    if (is_static) {
      holds = true;
    } else {
      list.push_back(numbers.at(fact));
    }
  }
  std::ranges::sort(list);
  return list;
}

bool ConditionGrounder::isReachable(const Atom& atom, const std::vector<int>& binding) const {
  const FactTuple tuple = tupleOf(atom, binding);
  return std::ranges::find(tuple, -1) != tuple.end() || names_.join.has(atom.predicate, tuple);
}

bool ConditionGrounder::addLiteral(const IndexedFormula& formula, const std::vector<int>& binding,
                                   GroundCondition& to) {
  if (formula.is_equality) {
    const FactTuple pair = tupleOf(formula.atom, binding);
    return (pair.at(0) == pair.at(1)) != formula.negated;
  }
  bool holds = false;
  const std::vector<int> facts = matching(formula.atom, binding, holds);
  if (formula.negated) {
    if (holds) return false;
    to.pre_not.insert(to.pre_not.end(), facts.begin(), facts.end());
    return true;
  }
  if (holds) return true;
  std::vector<GroundCondition> alternatives;
  for (int fact : facts) alternatives.push_back({{fact}, {}, {}});
  return addAlternatives(std::move(alternatives), to);
}

bool ConditionGrounder::addAlternatives(std::vector<GroundCondition> alternatives, GroundCondition& to) {
  std::vector<GroundCondition> different;
  for (GroundCondition& one : alternatives) {
    if (one.isTrue()) return true;
    if (std::ranges::find(different, one) == different.end()) different.push_back(std::move(one));
  }
  if (different.empty()) return false;
  if (different.size() == 1) {
    appendCondition(to, different.front());
    return true;
  }
  std::vector<int> content;
  for (const GroundCondition& one : different) {
    for (const auto* list : {&one.pre, &one.pre_not, &one.any}) {
      content.push_back(int(list->size()));
      content.insert(content.end(), list->begin(), list->end());
    }
  }
  const auto [known, fresh] = disjunctions_.try_emplace(std::move(content), int(out_.disjunctions.size()));
  if (fresh) out_.disjunctions.push_back(std::move(different));
  append(to.any, {known->second});
  return true;
}

void ConditionGrounder::collectGuards(const IndexedFormula& formula, bool negated, std::vector<const Atom*>& guards) {
  if (formula.kind == Kind::literal && !formula.is_equality && formula.negated == negated)
    guards.push_back(&formula.atom);
  if (formula.kind != (negated ? Kind::any : Kind::all)) return;
  for (const IndexedFormula& part : formula.parts) collectGuards(part, negated, guards);
}

void ConditionGrounder::forInstances(int first, const std::vector<int>& types, const std::vector<const Atom*>& guards,
                                     std::vector<int>& binding, const std::function<bool()>& found) const {
  // A guard is tested as soon as its last variable has a value.
  std::vector<std::vector<const Atom*>> tests(types.size());
  for (const Atom* guard : guards) {
    int last = -1;
    for (int argument : guard->arguments) last = std::max(last, argument);
    if (last >= first && last < first + int(types.size())) tests[std::size_t(last - first)].push_back(guard);
  }
  binding.resize(std::size_t(first), -1);
  std::vector<int> everything;
  for (std::size_t i = 0; i < names_.constants.size(); ++i) everything.push_back(int(i));
  std::vector<std::vector<int>> values;
  for (int type : types) {
    std::vector<int> list;
    if (type >= 0) {
      for (const FactTuple& fact : names_.join.facts(type)) list.push_back(fact[0]);
      std::ranges::sort(list);
    }
    values.push_back(type >= 0 ? list : everything);
  }
  const std::function<bool(std::size_t)> choose = [&](std::size_t i) {
    if (i == types.size()) return found();
    for (int value : values[i]) {
      binding.resize(std::size_t(first) + i);
      binding.push_back(value);
      if (!std::ranges::all_of(tests[i], [&](const Atom* guard) { return isReachable(*guard, binding); })) continue;
      if (!choose(i + 1)) return false;
    }
    return true;
  };
  choose(0);
  binding.resize(std::size_t(first));
}

bool ConditionGrounder::addExists(const IndexedFormula& formula, std::vector<int>& binding, GroundCondition& to) {
  std::vector<const Atom*> guards;
  collectGuards(formula.parts.front(), false, guards);
  std::vector<GroundCondition> alternatives;
  bool is_true = false;
  forInstances(formula.first, formula.types, guards, binding, [&] {
    GroundCondition one;
    if (add(formula.parts.front(), binding, one)) {
      is_true |= one.isTrue();
      alternatives.push_back(std::move(one));
    }
    return !is_true;
  });
  return is_true || addAlternatives(std::move(alternatives), to);
}

bool ConditionGrounder::add(const IndexedFormula& formula, std::vector<int>& binding, GroundCondition& to) {
  switch (formula.kind) {
    case Kind::literal:
      return addLiteral(formula, binding, to);
    case Kind::all:
      return std::ranges::all_of(formula.parts, [&](const IndexedFormula& part) { return add(part, binding, to); });
    case Kind::any: {
      std::vector<GroundCondition> alternatives;
      for (const IndexedFormula& part : formula.parts) {
        GroundCondition one;
        if (!add(part, binding, one)) continue;
        if (one.isTrue()) return true;
        alternatives.push_back(std::move(one));
      }
      return addAlternatives(std::move(alternatives), to);
    }
    case Kind::exists:
      return addExists(formula, binding, to);
    case Kind::forall: {
      std::vector<const Atom*> guards;
      collectGuards(formula.parts.front(), true, guards);
      bool possible = true;
      forInstances(formula.first, formula.types, guards, binding,
                   [&] { return possible = add(formula.parts.front(), binding, to); });
      return possible;
    }
  }
  return false;
}

}  // namespace kinegraph::inline logic_internal
