#include "kinegraph/logic/grounding.h"

#include <algorithm>
#include <functional>
#include <map>
#include <set>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using Tuple = std::vector<int>;  ///< indices of constants

/// Maximum number of matches of facts with preconditions, per allowed action.
constexpr std::size_t kTriesPerAction = 200;

/// The facts that can hold, found by firing all rules without deletes.
class Grounder {
 public:
  Grounder(LogicProblem problem, std::size_t most) : most_(most) { out_.problem = std::move(problem); }

  GroundProblem run() {
    requireWords();
    collectConstants();
    for (const LogicRule& rule : out_.problem.domain.rules) {
      for (const Literal& effect : rule.eff) changing_.insert(effect.predicate);
    }
    for (const Literal& fact : out_.problem.start) reached_[fact.predicate].insert(tupleOf(fact, nullptr, {}));
    reach();
    numberFacts();
    makeRules();
    makeGoal();
    for (const Literal& fact : out_.problem.start) {
      if (const int number = out_.factNumber(fact); number >= 0) out_.start.insert(number);
    }
    out_.fireRules(out_.start);
    return std::move(out_);
  }

 private:
  using Binding = std::vector<int>;  ///< per variable, -1: unbound

  /// Checks the numbers of arguments of predicates, and the words of the goal.
  void requireWords() {
    const LogicProblem& problem = out_.problem;
    std::map<std::string, std::pair<std::size_t, std::string>> arity;
    std::set<std::string> words(problem.domain.symbols.begin(), problem.domain.symbols.end());
    words.insert({"QUIT", "WAIT", "Terminate", "INFEASIBLE", std::string(kAny), std::string(kEqual)});
    const auto see = [&](const Literal& literal) {
      const auto [known, fresh] = arity.try_emplace(literal.predicate, literal.arguments.size(), literal.str());
      if (!fresh && known->second.first != literal.arguments.size()) {
        throw ParseError(literal.where,
                         cat("predicate '", literal.predicate, "' has ", literal.arguments.size(), " arguments in ",
                             literal.str(), " and ", known->second.first, " in ", known->second.second));
      }
      words.insert(literal.predicate);
    };
    for (const Literal& literal : problem.start) {
      see(literal);
      words.insert(literal.arguments.begin(), literal.arguments.end());
    }
    for (const LogicRule& rule : problem.domain.rules) {
      for (const Literal& literal : rule.pre) see(literal);
      for (const Literal& literal : rule.eff) see(literal);
    }
    words.insert(problem.constants.begin(), problem.constants.end());
    for (const Literal& literal : problem.goal) {
      std::vector<std::string> all = literal.arguments;
      all.insert(all.begin(), literal.predicate);
      for (const std::string& word : all) {
        if (words.contains(word)) continue;
        throw ParseError(literal.where, cat("unknown symbol '", word, "' in the goal ", literal.str(),
                                            similarHint(word, {words.begin(), words.end()})));
      }
      see(literal);
    }
  }

  int constant(const std::string& name) {
    const auto [place, fresh] = numbers_.try_emplace(name, int(names_.size()));
    if (fresh) names_.push_back(name);
    return place->second;
  }

  void collectConstants() {
    LogicProblem& problem = out_.problem;
    for (const std::string& name : problem.constants) constant(name);
    for (const Literal& fact : problem.start) {
      for (const std::string& name : fact.arguments) constant(name);
    }
    for (const LogicRule& rule : problem.domain.rules) {
      for (const auto* list : {&rule.pre, &rule.eff}) {
        for (const Literal& literal : *list) {
          for (const std::string& word : literal.arguments) {
            if (word != kAny && std::ranges::find(rule.variables, word) == rule.variables.end()) constant(word);
          }
        }
      }
    }
    for (const Literal& literal : problem.goal) {
      for (const std::string& word : literal.arguments) {
        if (word != kAny) constant(word);
      }
    }
  }

  static int variableOf(const LogicRule* rule, const std::string& word) {
    if (!rule) return -1;
    const auto found = std::ranges::find(rule->variables, word);
    return found == rule->variables.end() ? -1 : int(found - rule->variables.begin());
  }

  /// -1 for ANY.
  Tuple tupleOf(const Literal& literal, const LogicRule* rule, const Binding& binding) {
    Tuple tuple;
    for (const std::string& word : literal.arguments) {
      const int variable = variableOf(rule, word);
      tuple.push_back(variable >= 0 ? binding[std::size_t(variable)] : word == kAny ? -1 : constant(word));
    }
    return tuple;
  }

  static bool matches(const Tuple& pattern, const Tuple& fact) {
    for (std::size_t i = 0; i < pattern.size(); ++i) {
      if (pattern[i] >= 0 && pattern[i] != fact[i]) return false;
    }
    return true;
  }

  /// Binds the variables of a literal to those of a fact; false if they do not match.
  bool bind(const LogicRule& rule, const Literal& literal, const Tuple& fact, Binding& binding) {
    for (std::size_t i = 0; i < fact.size(); ++i) {
      const std::string& word = literal.arguments[i];
      if (word == kAny) continue;
      const int variable = variableOf(&rule, word);
      if (variable < 0) {
        if (constant(word) != fact[i]) return false;
        continue;
      }
      int& value = binding[std::size_t(variable)];
      if (value >= 0) {
        if (value != fact[i]) return false;
        continue;
      }
      if (out_.problem.domain.distinct_variables && std::ranges::find(binding, fact[i]) != binding.end()) return false;
      value = fact[i];
    }
    return true;
  }

  /// Calls `found` for all bindings with which the positive literals can hold, in the order of the constants.
  void match(const LogicRule& rule, const std::function<void(const Binding&)>& found) {
    std::vector<const Literal*> order;
    for (const Literal& literal : rule.pre) {
      if (!literal.negated && literal.predicate != kEqual) order.push_back(&literal);
    }
    // Facts that never change restrict bindings most.
    std::ranges::stable_sort(order, {}, [&](const Literal* literal) { return changing_.contains(literal->predicate); });
    Binding binding(rule.variables.size(), -1);
    matchFrom(rule, order, 0, binding, found);
  }

  void matchFrom(const LogicRule& rule, const std::vector<const Literal*>& order, std::size_t i, Binding& binding,
                 const std::function<void(const Binding&)>& found) {
    if (i == order.size()) {
      if (equalitiesHold(rule, binding)) found(binding);
      return;
    }
    const auto facts = reached_.find(order[i]->predicate);
    if (facts == reached_.end()) return;
    spend(facts->second.size(), rule);
    for (const Tuple& fact : facts->second) {
      Binding next = binding;
      if (bind(rule, *order[i], fact, next)) matchFrom(rule, order, i + 1, next, found);
    }
  }

  bool equalitiesHold(const LogicRule& rule, const Binding& binding) {
    for (const Literal& literal : rule.pre) {
      if (literal.predicate != kEqual) continue;
      const Tuple pair = tupleOf(literal, &rule, binding);
      if ((pair.at(0) == pair.at(1)) == literal.negated) return false;
    }
    return true;
  }

  /// Counts matches of facts with preconditions: n^k in the worst case, for k preconditions and n facts.
  void spend(std::size_t tries, const LogicRule& rule) {
    tries_ += tries;
    if (tries_ <= kTriesPerAction * most_) return;
    throw ValueError(cat("ground: ", rule.where.str(), ": rule '", rule.name,
                         "' is one too many: facts were held against preconditions ", kTriesPerAction * most_,
                         " times; preconditions that tie its variables to one another would leave fewer"));
  }

  void reach() {
    for (bool grown = true; grown;) {
      grown = false;
      for (const LogicRule& rule : out_.problem.domain.rules) {
        std::set<std::pair<std::string, Tuple>> fresh;
        match(rule, [&](const Binding& binding) {
          for (const Literal& effect : rule.eff) {
            if (effect.negated) continue;
            Tuple tuple = tupleOf(effect, &rule, binding);
            if (!reached_[effect.predicate].contains(tuple)) fresh.emplace(effect.predicate, std::move(tuple));
            if (fresh.size() > most_)
              throw ValueError(cat("ground: ", rule.where.str(), ": rule '", rule.name, "' can make more than ", most_,
                                   " facts true; the problem is too large"));
          }
        });
        for (const auto& [predicate, tuple] : fresh) grown |= reached_[predicate].insert(tuple).second;
      }
    }
  }

  Literal literalOf(const std::string& predicate, const Tuple& tuple) const {
    Literal literal{predicate};
    for (int number : tuple) literal.arguments.push_back(names_[std::size_t(number)]);
    return literal;
  }

  void numberFacts() {
    for (const auto& [predicate, tuples] : reached_) {
      if (!changing_.contains(predicate)) continue;
      for (const Tuple& tuple : tuples) {
        number_[{predicate, tuple}] = int(out_.facts.size());
        out_.facts.push_back(literalOf(predicate, tuple));
      }
    }
    out_.start = FactSet(out_.facts.size());
  }

  /// Indices of the facts that match; `holds`: a matching fact never changes.
  std::vector<int> matching(const std::string& predicate, const Tuple& pattern, bool& holds) const {
    std::vector<int> list;
    const auto facts = reached_.find(predicate);
    if (facts == reached_.end()) return list;
    const auto add = [&](const Tuple& tuple) {
      if (const auto known = number_.find({predicate, tuple}); known != number_.end()) {
        list.push_back(known->second);
      } else {
        holds = true;
      }
    };
    if (std::ranges::find(pattern, -1) == pattern.end()) {  // without ANY there is at most one
      if (facts->second.contains(pattern)) add(pattern);
      return list;
    }
    for (const Tuple& tuple : facts->second) {
      if (matches(pattern, tuple)) add(tuple);
    }
    return list;
  }

  void makeRules() {
    for (std::size_t r = 0; r < out_.problem.domain.rules.size(); ++r) {
      const LogicRule& rule = out_.problem.domain.rules[r];
      match(rule, [&](const Binding& binding) { makeRule(int(r), rule, binding); });
    }
  }

  void makeRule(int number, const LogicRule& rule, const Binding& binding) {
    GroundRule made{number, {}, {}, {}, {}, {}};
    for (int value : binding) made.arguments.push_back(names_[std::size_t(value)]);
    for (const Literal& literal : rule.pre) {
      if (literal.predicate == kEqual) continue;
      const Tuple pattern = tupleOf(literal, &rule, binding);
      bool holds = false;
      const std::vector<int> facts = matching(literal.predicate, pattern, holds);
      if (literal.negated) {
        if (holds) return;
        made.pre_not.insert(made.pre_not.end(), facts.begin(), facts.end());
      } else if (!holds) {
        if (facts.size() != 1)
          throw ParseError(literal.where, cat(literal.str(), " with ANY has to be about facts that never change"));
        made.pre.push_back(facts.front());
      }
    }
    for (const Literal& literal : rule.eff) addEffect(made, literal, tupleOf(literal, &rule, binding));
    auto& list = rule.is_decision ? out_.actions : out_.rules;
    if (list.size() >= most_) throw ValueError(cat("ground: more than ", most_, " actions; the problem is too large"));
    list.push_back(std::move(made));
  }

  void addEffect(GroundRule& rule, const Literal& effect, const Tuple& pattern) const {
    bool holds = false;
    for (int fact : matching(effect.predicate, pattern, holds)) {
      auto &to = effect.negated ? rule.deletes : rule.adds, &from = effect.negated ? rule.adds : rule.deletes;
      std::erase(from, fact);
      if (std::ranges::find(to, fact) == to.end()) to.push_back(fact);
    }
  }

  void makeGoal() {
    for (const Literal& literal : out_.problem.goal) {
      bool holds = false;
      const std::vector<int> facts = matching(literal.predicate, tupleOf(literal, nullptr, {}), holds);
      if (literal.negated) {
        if (holds) out_.unreachable.push_back(literal);
        out_.goal_not.insert(out_.goal_not.end(), facts.begin(), facts.end());
      } else if (!holds) {
        if (facts.empty()) out_.unreachable.push_back(literal);
        if (facts.size() > 1)
          throw ParseError(literal.where, cat("the goal ", literal.str(), " has ANY; expected a constant"));
        if (!facts.empty()) out_.goal.push_back(facts.front());
      }
    }
  }

  GroundProblem out_;
  std::size_t most_, tries_ = 0;
  std::vector<std::string> names_;
  std::map<std::string, int> numbers_;
  std::set<std::string> changing_;
  std::map<std::string, std::set<Tuple>> reached_;
  std::map<std::pair<std::string, Tuple>, int> number_;
};

}  // namespace

std::uint64_t FactSet::hash() const {
  std::uint64_t h = 0x9e3779b97f4a7c15ull;
  for (std::uint64_t word : words_) {
    h ^= word;
    h *= 0xff51afd7ed558ccdull;
    h ^= h >> 32;
  }
  return h;
}

std::vector<std::string> GroundProblem::action(int number) const {
  const GroundRule& rule = actions.at(std::size_t(number));
  std::vector<std::string> words = {problem.domain.rules[std::size_t(rule.rule)].name};
  words.insert(words.end(), rule.arguments.begin(), rule.arguments.end());
  return words;
}

int GroundProblem::factNumber(const Literal& literal) const {
  for (std::size_t i = 0; i < facts.size(); ++i) {
    if (facts[i].predicate == literal.predicate && facts[i].arguments == literal.arguments) return int(i);
  }
  return -1;
}

bool GroundProblem::isApplicable(const GroundRule& rule, const FactSet& state) const {
  for (int fact : rule.pre) {
    if (!state.has(fact)) return false;
  }
  for (int fact : rule.pre_not) {
    if (state.has(fact)) return false;
  }
  return true;
}

bool GroundProblem::isGoal(const FactSet& state) const {
  if (!unreachable.empty()) return false;
  for (int fact : goal) {
    if (!state.has(fact)) return false;
  }
  for (int fact : goal_not) {
    if (state.has(fact)) return false;
  }
  return true;
}

void GroundProblem::fireRules(FactSet& state) const {
  for (std::size_t round = 0; !rules.empty(); ++round) {
    const FactSet before = state;
    for (const GroundRule& rule : rules) {
      if (!isApplicable(rule, state)) continue;
      for (int fact : rule.deletes) state.erase(fact);
      for (int fact : rule.adds) state.insert(fact);
    }
    if (state == before) return;
    if (round > facts.size() + 1) throw ValueError("the rules undo one another and never end");
  }
}

FactSet GroundProblem::apply(int action, const FactSet& state) const {
  const GroundRule& rule = actions[std::size_t(action)];
  FactSet next = state;
  for (int fact : rule.deletes) next.erase(fact);
  for (int fact : rule.adds) next.insert(fact);
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

GroundProblem ground(LogicProblem problem, std::size_t most) { return Grounder(std::move(problem), most).run(); }

std::vector<std::string> diagnostics(const GroundProblem& ground) {
  std::set<std::string> true_somewhere;
  for (const Literal& fact : ground.facts) true_somewhere.insert(fact.predicate);
  for (const Literal& fact : ground.problem.start) true_somewhere.insert(fact.predicate);
  std::set<int> fires;
  for (const auto* list : {&ground.actions, &ground.rules}) {
    for (const GroundRule& rule : *list) fires.insert(rule.rule);
  }
  std::vector<std::string> told;
  const std::vector<LogicRule>& rules = ground.problem.domain.rules;
  for (std::size_t r = 0; r < rules.size(); ++r) {
    if (fires.contains(int(r))) continue;
    std::string why;
    for (const Literal& literal : rules[r].pre) {
      if (literal.negated || literal.predicate == kEqual || true_somewhere.contains(literal.predicate)) continue;
      why = cat("; no rule and no fact ever makes ", literal.str(), " true");
    }
    told.push_back(cat(rules[r].where.str(), ": rule '", rules[r].name, "' can never fire", why));
  }
  for (const Literal& literal : ground.unreachable)
    told.push_back(cat("nothing can make ", literal.str(), " of the goal true"));
  return told;
}

}  // namespace kinegraph
