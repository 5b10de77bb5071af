#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/derived_facts.h"
#include "kinegraph/logic/grounding.h"

namespace kinegraph {

namespace {

void applyEffects(const GroundProblem& ground, const GroundRule& rule, const FactSet& before, FactSet& state) {
  for (int fact : rule.deletes) state.erase(fact);
  std::vector<const GroundEffect*> active;
  for (const GroundEffect& effect : rule.when) {
    if (!ground.holds(effect.when, before)) continue;
    active.push_back(&effect);
    for (int fact : effect.deletes) state.erase(fact);
  }
  for (int fact : rule.adds) state.insert(fact);
  for (const GroundEffect* effect : active) {
    for (int fact : effect->adds) state.insert(fact);
  }
}

}  // namespace

void FactSet::growTo(int fact) {
  if (fact < 0) throw ValueError(cat("fact ", fact, " does not exist; the indices of facts start with 0"));
  words_.resize(std::size_t(fact) / 64 + 1, 0);
}

std::uint64_t FactSet::hash() const {
  std::uint64_t h = 0x9e3779b97f4a7c15ull;
  for (std::uint64_t word : words_) {
    h ^= word;
    h *= 0xff51afd7ed558ccdull;
    h ^= h >> 32;
  }
  return h;
}

const GroundRule& GroundProblem::actionAt(int number) const {
  if (number < 0 || std::size_t(number) >= actions.size())
    throw ValueError(cat("action ", number, " does not exist; the problem has ", actions.size(), " actions"));
  return actions[std::size_t(number)];
}

std::vector<std::string> GroundProblem::action(int number) const {
  const GroundRule& rule = actionAt(number);
  std::vector<std::string> words = {problem.domain.rules[std::size_t(rule.rule)].name};
  words.insert(words.end(), rule.arguments.begin(), rule.arguments.end());
  return words;
}

std::string GroundProblem::keyOf(const Literal& literal) {
  std::string key = literal.predicate;
  for (const std::string& word : literal.arguments) key += " " + word;
  return key;
}

int GroundProblem::factNumber(const Literal& literal) const {
  const auto found = numbers.find(keyOf(literal));
  return found == numbers.end() ? -1 : found->second;
}

double GroundProblem::cost(const std::vector<int>& plan) const {
  std::int64_t sum = 0;
  for (int action : plan) sum += actionAt(action).cost;
  return double(sum) * cost_unit;
}

bool GroundProblem::holds(const GroundCondition& condition, const FactSet& state) const {
  for (int fact : condition.pre) {
    if (!state.has(fact)) return false;
  }
  for (int fact : condition.pre_not) {
    if (state.has(fact)) return false;
  }
  for (int number : condition.any) {
    const auto& alternatives = disjunctions[std::size_t(number)];
    if (std::ranges::none_of(alternatives, [&](const GroundCondition& one) { return holds(one, state); })) return false;
  }
  return true;
}

bool GroundProblem::isGoal(const FactSet& state) const {
  return unreachable.empty() && impossible.empty() && holds({goal, goal_not, goal_any}, state);
}

void GroundProblem::fireRules(FactSet& state) const {
  deriveFacts(*this, state);
  for (std::size_t round = 0; !rules.empty(); ++round) {
    const FactSet before = state;
    for (const GroundRule& rule : rules) {
      if (!isApplicable(rule, state)) continue;
      applyEffects(*this, rule, FactSet(state), state);
    }
    if (state == before) return;
    if (round > facts.size() + 1) throw ValueError("the rules undo one another and never end");
  }
}

FactSet GroundProblem::apply(int action, const FactSet& state) const {
  const GroundRule& rule = actionAt(action);
  FactSet next = state;
  applyEffects(*this, rule, state, next);
  fireRules(next);
  return next;
}

std::vector<Literal> GroundProblem::literals(const FactSet& state) const {
  std::vector<Literal> list;
  for (const Literal& fact : problem.start) {
    if (!fact.negated && factNumber(fact) < 0) list.push_back(fact);
  }
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (state.has(int(i))) list.push_back(facts[i]);
  }
  return list;
}

namespace {

using Shape = std::pair<std::string, std::size_t>;  ///< predicate, number of arguments

std::string ruleName(const LogicRule& rule) { return cat(rule.where.str(), ": rule '", rule.name, "'"); }

/// Rules that can never fire.
void addUnfired(const GroundProblem& ground, std::vector<std::string>& told) {
  std::set<Shape> true_somewhere;
  for (const Literal& fact : ground.facts) true_somewhere.emplace(fact.predicate, fact.arguments.size());
  for (const Literal& fact : ground.problem.start) true_somewhere.emplace(fact.predicate, fact.arguments.size());
  std::set<int> fires;
  for (const auto* list : {&ground.actions, &ground.rules}) {
    for (const GroundRule& rule : *list) fires.insert(rule.rule);
  }
  for (const auto& layer : ground.derived) {
    for (const GroundRule& rule : layer) fires.insert(rule.rule);
  }
  const std::vector<LogicRule>& rules = ground.problem.domain.rules;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    if (fires.contains(int(r))) continue;
    std::string why;
    for (const Literal& literal : rules[r].pre) {
      if (literal.negated || literal.predicate == kEqual) continue;
      if (true_somewhere.contains({literal.predicate, literal.arguments.size()})) continue;
      why = cat("; no rule and no fact ever makes ", literal.str(), " true");
    }
    told.push_back(cat(ruleName(rules[r]), " can never fire", why));
  }
}

std::string placeOf(const Literal& literal) { return literal.where.known() ? literal.where.str() + ": " : ""; }

bool isDeclared(const LogicDomain& domain, const std::string& word) {
  const auto has = [&](const auto& pair) { return pair.first == word || pair.second == word; };
  return std::ranges::find(domain.symbols, word) != domain.symbols.end() || std::ranges::any_of(domain.types, has);
}

/// Facts of the start whose predicate no rule has, or not with their number of arguments.
void addOddFacts(const GroundProblem& ground, std::vector<std::string>& told) {
  std::map<std::string, std::map<std::size_t, std::string>> in_rules;
  for (const LogicRule& rule : ground.problem.domain.rules) {
    for (const auto* list : {&rule.pre, &rule.eff}) {
      for (const Literal& literal : *list)
        in_rules[literal.predicate].try_emplace(literal.arguments.size(), literal.str());
    }
  }
  std::set<Shape> seen;
  for (const Literal& fact : ground.problem.start) {
    const auto known = in_rules.find(fact.predicate);
    if (known != in_rules.end() && known->second.contains(fact.arguments.size())) continue;
    if (!seen.emplace(fact.predicate, fact.arguments.size()).second) continue;
    if (known == in_rules.end()) {
      if (isDeclared(ground.problem.domain, fact.predicate)) continue;
      std::vector<std::string> names;
      for (const auto& [name, arguments] : in_rules) names.push_back(name);
      const std::string hint = similarHint(fact.predicate, names);  // scenes have facts for other rules, too
      if (!hint.empty()) told.push_back(cat(placeOf(fact), "no rule has the predicate of ", fact.str(), hint));
      continue;
    }
    told.push_back(cat(placeOf(fact), "no rule has ", fact.str(), " with ", fact.arguments.size(),
                       " arguments; rules have ", known->second.begin()->second));
  }
}

/// Arguments of the start and the goal that do not have the type that PDDL declares for the predicate. The first one
/// of each kind is told: such a fact may have been meant otherwise, and no action matches it.
void addWrongTypes(const GroundProblem& ground, std::vector<std::string>& told) {
  const LogicProblem& problem = ground.problem;
  std::set<std::string> typed;
  for (const Literal& fact : problem.start) {
    if (fact.arguments.size() == 1) typed.insert(GroundProblem::keyOf(fact));
  }
  std::set<std::pair<std::string, std::size_t>> seen;
  const auto check = [&](const Literal& literal) {
    const auto& predicates = problem.domain.predicates;
    const auto declared = std::ranges::find(predicates, literal.predicate, &Signature::name);
    if (declared == predicates.end() || declared->types.size() != literal.arguments.size()) return;
    for (std::size_t i = 0; i < literal.arguments.size(); ++i) {
      const std::string &type = declared->types[i], &word = literal.arguments[i];
      if (type.empty() || typed.contains(cat(type, " ", word)) || !seen.emplace(literal.predicate, i).second) continue;
      told.push_back(cat(placeOf(literal), "'", word, "' in ", literal.str(), " is not of the type '", type, "'"));
    }
  };
  for (const Literal& fact : problem.start) check(fact);
  for (const Literal& literal : problem.goal) check(literal);
}

/// Constants of START_STATE that are neither declared nor in another fact.
void addUnknownConstants(const GroundProblem& ground, std::vector<std::string>& told) {
  const LogicDomain& domain = ground.problem.domain;
  if (!domain.distinct_variables) return;  // PDDL declares all
  std::set<std::string> known(domain.symbols.begin(), domain.symbols.end());
  known.insert(ground.problem.constants.begin(), ground.problem.constants.end());
  for (std::size_t i = domain.start.size(); i < ground.problem.start.size(); ++i)
    known.insert(ground.problem.start[i].arguments.begin(), ground.problem.start[i].arguments.end());
  std::set<std::string> seen;
  for (const Literal& fact : domain.start) {
    const std::size_t values = hasValue(fact.predicate) ? 1 : 0;
    for (std::size_t i = 0; i + values < fact.arguments.size(); ++i) {
      const std::string& word = fact.arguments[i];
      if (known.contains(word) || !seen.insert(word).second) continue;
      told.push_back(cat(fact.where.str(), ": '", word, "' in ", fact.str(),
                         " of START_STATE is neither declared nor in another fact",
                         similarHint(word, {known.begin(), known.end()})));
    }
  }
}

}  // namespace

std::vector<std::string> diagnostics(const GroundProblem& ground) {
  std::vector<std::string> told;
  addUnfired(ground, told);
  addOddFacts(ground, told);
  addWrongTypes(ground, told);
  addUnknownConstants(ground, told);
  for (const Literal& literal : ground.unreachable)
    told.push_back(cat("nothing can make ", literal.str(), " of the goal true"));
  for (const Formula& formula : ground.impossible)
    told.push_back(cat("nothing can make ", formula.str(), " of the goal true"));
  return told;
}

}  // namespace kinegraph
