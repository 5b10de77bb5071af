#include "kinegraph/logic/grounding.h"

#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/derived_facts.h"
#include "kinegraph/logic/ground_conditions.h"
#include "kinegraph/logic/ground_costs.h"
#include "kinegraph/logic/known_words.h"

namespace kinegraph {

namespace {

using Kind = Formula::Kind;
using Atom = FactJoin::Atom;
using Shape = GroundNames::Shape;

/// Maximum number of matches of facts with preconditions, per allowed action.
constexpr std::size_t kTriesPerAction = 200;

Shape shapeOf(const Literal& literal) { return {literal.predicate, literal.arguments.size()}; }

/// An effect with indices instead of names.
struct IndexedEffect {
  Atom atom;
  bool negated = false;
};
struct IndexedConditional {
  IndexedFormula when;
  int first = 0;
  std::vector<int> types;
  std::vector<IndexedEffect> effects;
};
struct IndexedRule {
  int bindings = 0;  ///< the predicate of the values of its variables
  IndexedFormula condition;
  std::vector<IndexedEffect> effects;
  std::vector<IndexedConditional> conditional;
  std::vector<Atom> order;  ///< preconditions whose facts give the order of actions
};

/// Finds the facts that can hold, by firing all rules without deletes, and the rules that can fire then.
class Grounder {
 public:
  Grounder(LogicProblem problem, std::size_t most) : most_(most) { out_.problem = std::move(problem); }

  GroundProblem run() {
    requireWords();
    collectChanging();
    collectConstants();
    for (std::size_t r = 0; r < rules().size(); ++r) index(int(r));
    indexGoal();
    for (int i = 0; i < int(names_.constants.size()); ++i) names_.join.addFact(everything_, {i});
    for (const Literal& fact : out_.problem.start) {
      const Atom atom = names_.atom(fact, {});
      FactTuple tuple;
      for (int argument : atom.arguments) tuple.push_back(-1 - argument);
      if (!fact.negated) names_.join.addFact(atom.predicate, std::move(tuple));
    }
    reach();
    numberFacts();
    for (std::size_t r = 0; r < rules().size(); ++r) makeRules(int(r));
    setDerivedRules(out_, std::move(derived_));
    if (out_.problem.minimize_cost) setActionCosts(out_);
    makeGoal();
    for (const Literal& fact : out_.problem.start) {
      if (const int number = out_.factNumber(fact); number >= 0 && !fact.negated) out_.start.insert(number);
    }
    out_.fireRules(out_.start);
    return std::move(out_);
  }

 private:
  const std::vector<LogicRule>& rules() const { return out_.problem.domain.rules; }

  /// Checks the words of the goal and the numbers of its arguments.
  void requireWords() {
    const LogicProblem& problem = out_.problem;
    std::map<std::string, std::map<std::size_t, std::string>> arity;
    std::set<std::string> words(problem.domain.symbols.begin(), problem.domain.symbols.end());
    const std::set<std::string> reserved = {
        "QUIT", "WAIT", "Terminate", "INFEASIBLE", std::string(kAny), std::string(kEqual)};
    words.insert(reserved.begin(), reserved.end());
    words.insert(problem.constants.begin(), problem.constants.end());
    const auto see = [&](const Literal& literal) {
      arity[literal.predicate].try_emplace(literal.arguments.size(), literal.str());
      words.insert(literal.predicate);
    };
    const auto require = [&](const Literal& literal) {
      const auto known = arity.find(literal.predicate);
      if (known == arity.end() || known->second.contains(literal.arguments.size())) return;
      const auto& [count, example] = *known->second.begin();
      throw ParseError(literal.where, cat("predicate '", literal.predicate, "' has ", literal.arguments.size(),
                                          " arguments in ", literal.str(), " and ", count, " in ", example));
    };
    for (const Signature& predicate : problem.domain.predicates) see({predicate.name, predicate.variables});
    for (const Literal& literal : problem.start) {
      if (!problem.domain.predicates.empty()) require(literal);
      words.insert(literal.arguments.begin(), literal.arguments.end());
    }
    for (const LogicRule& rule : problem.domain.rules) {
      for (const Literal& literal : rule.pre) see(literal);
      for (const Literal& literal : rule.eff) see(literal);
    }
    for (const Literal& literal : problem.start) see(literal);
    std::vector<std::string> predicates, constants;
    for (const auto& [name, arguments] : arity) predicates.push_back(name);
    for (const std::string& word : words) {
      if (!arity.contains(word) && !reserved.contains(word)) constants.push_back(word);
    }
    for (const Literal& literal : problem.goal) {
      std::vector<std::string> all = literal.arguments;
      all.insert(all.begin(), literal.predicate);
      if (hasValue(literal.predicate)) all = {literal.arguments.begin(), std::prev(literal.arguments.end())};
      for (const std::string& word : all) {
        if (words.contains(word)) continue;
        throw ParseError(literal.where, cat("unknown symbol '", word, "' in the goal ", literal.str(),
                                            knownWords(word, &word == &all.front() ? predicates : constants)));
      }
      require(literal);
    }
  }

  void collectChanging() {
    for (const LogicRule& rule : rules()) {
      for (const Literal& effect : rule.eff) names_.changing.insert(shapeOf(effect));
      for (const ConditionalEffect& conditional : rule.conditional) {
        for (const Literal& effect : conditional.eff) names_.changing.insert(shapeOf(effect));
      }
    }
    everything_ = names_.join.addPredicate(1, true);
  }

  /// Constants are numbered in the order in which the problem names them.
  void collectConstants() {
    for (const std::string& name : out_.problem.constants) names_.constant(name);
    for (const Literal& fact : out_.problem.start) {
      for (const std::string& name : fact.arguments) names_.constant(name);
    }
  }

  void index(int number) {
    const LogicRule& rule = rules()[std::size_t(number)];
    std::vector<std::string> scope = rule.variables;
    IndexedRule made;
    made.bindings = names_.join.addPredicate(rule.variables.size(), false);
    Formula condition;
    for (const Literal& literal : rule.pre) condition.parts.push_back({Kind::literal, literal});
    condition.parts.insert(condition.parts.end(), rule.conditions.begin(), rule.conditions.end());
    made.condition = indexed(condition, scope, names_);
    for (const Literal& effect : rule.eff) made.effects.push_back(indexedEffect(effect, scope));
    for (const ConditionalEffect& conditional : rule.conditional) {
      IndexedConditional one;
      one.first = int(scope.size());
      scope.insert(scope.end(), conditional.variables.begin(), conditional.variables.end());
      for (const std::string& type : conditional.types)
        one.types.push_back(type.empty() ? -1 : names_.predicate(type, 1));
      one.when = indexed(conditional.when, scope, names_);
      for (const Literal& effect : conditional.eff) one.effects.push_back(indexedEffect(effect, scope));
      scope.resize(rule.variables.size());
      made.conditional.push_back(std::move(one));
    }
    for (const Literal& literal : rule.pre) {
      if (!literal.negated && literal.predicate != kEqual) made.order.push_back(names_.atom(literal, scope));
    }
    // Facts that never change come first.
    std::ranges::stable_sort(made.order, {}, [&](const Atom& atom) { return !names_.join.isStatic(atom.predicate); });
    indexed_.push_back(std::move(made));
  }

  IndexedEffect indexedEffect(const Literal& effect, const std::vector<std::string>& scope) {
    IndexedEffect made{names_.atom(effect, scope), effect.negated};
    if (!effect.negated && std::ranges::find(effect.arguments, kAny) != effect.arguments.end())
      throw ParseError(effect.where, cat("the effect ", effect.str(), " has ANY; expected a constant or a variable"));
    return made;
  }

  void indexGoal() {
    std::vector<std::string> scope;
    for (const Literal& literal : out_.problem.goal) goal_.push_back(indexed({Kind::literal, literal}, scope, names_));
    for (const Formula& formula : out_.problem.goal_conditions) goal_.push_back(indexed(formula, scope, names_));
  }

  /// Adds rules for the facts that can hold: negative literals and `forall` exclude nothing.
  void addJoinRules(int number) {
    const IndexedRule& rule = indexed_[std::size_t(number)];
    FactJoin::Rule fires;
    fires.owner = number;
    fires.variables = int(rules()[std::size_t(number)].variables.size());
    fires.distinct = out_.problem.domain.distinct_variables;
    addBody(rule.condition, fires);
    addHeads(rule.effects, fires);
    Atom bindings{rule.bindings, {}};
    for (int i = 0; i < fires.variables; ++i) bindings.arguments.push_back(i);
    fires.heads.push_back(bindings);
    addJoinRule(std::move(fires));
    for (const IndexedConditional& conditional : rule.conditional) {
      FactJoin::Rule effect;
      effect.owner = number;
      effect.variables = conditional.first + int(conditional.types.size());
      effect.body = {bindings};
      addTypes(conditional.first, conditional.types, effect);
      addBody(conditional.when, effect);
      addHeads(conditional.effects, effect);
      if (!effect.heads.empty()) addJoinRule(std::move(effect));
    }
  }

  void addTypes(int first, const std::vector<int>& types, FactJoin::Rule& rule) const {
    for (std::size_t i = 0; i < types.size(); ++i) {
      if (types[i] >= 0) rule.body.push_back({types[i], {first + int(i)}});
    }
  }

  static void addHeads(const std::vector<IndexedEffect>& effects, FactJoin::Rule& rule) {
    for (const IndexedEffect& effect : effects) {
      if (!effect.negated) rule.heads.push_back(effect.atom);
    }
  }

  /// Binds the variables that nothing else binds to any constant.
  void addJoinRule(FactJoin::Rule rule) {
    std::vector<char> bound(std::size_t(rule.variables), 0);
    for (const Atom& atom : rule.body) {
      for (int argument : atom.arguments) {
        if (argument >= 0) bound[std::size_t(argument)] = 1;
      }
    }
    for (int i = 0; i < rule.variables; ++i) {
      if (!bound[std::size_t(i)]) rule.body.push_back({everything_, {i}});
    }
    names_.join.addRule(std::move(rule));
  }

  /// Whether a formula restricts the bindings of a join.
  static bool isPositive(const IndexedFormula& formula) {
    if (formula.kind == Kind::literal) return !formula.negated && !formula.is_equality;
    if (formula.kind == Kind::forall) return false;
    if (formula.kind == Kind::any)
      return !formula.parts.empty() &&
             std::ranges::all_of(formula.parts, [](const auto& part) { return isPositive(part); });
    return std::ranges::any_of(formula.parts, [](const auto& part) { return isPositive(part); });
  }

  static void collectFree(const IndexedFormula& formula, int limit, std::set<int>& free) {
    for (int argument : formula.atom.arguments) {
      if (argument >= 0 && argument < limit) free.insert(argument);
    }
    for (const IndexedFormula& part : formula.parts) collectFree(part, limit, free);
  }

  /// Adds the literals of a formula to a body; `or` and `exists` become predicates with rules of their own.
  void addBody(const IndexedFormula& formula, FactJoin::Rule& rule) {
    if (formula.kind == Kind::literal && formula.is_equality) {
      const int a = formula.atom.arguments.at(0), b = formula.atom.arguments.at(1);
      if (std::max(a, b) < rule.variables) rule.equalities.push_back({a, b, !formula.negated});
    } else if (formula.kind == Kind::literal) {
      if (!formula.negated) rule.body.push_back(formula.atom);
    } else if (formula.kind == Kind::all) {
      for (const IndexedFormula& part : formula.parts) addBody(part, rule);
    } else if (isPositive(formula)) {
      std::set<int> free;
      collectFree(formula, formula.first, free);
      Atom holds{0, {free.begin(), free.end()}};
      holds.predicate = names_.join.addPredicate(free.size(), false);
      // Variables of the surroundings keep their indices; those that do not occur are any constant: renumber.
      for (const IndexedFormula& part : formula.parts) {
        FactJoin::Rule inner;
        inner.owner = rule.owner;
        inner.variables = formula.first + int(formula.types.size());
        addTypes(formula.first, formula.types, inner);
        addBody(part, inner);
        inner.heads = {holds};
        renumber(inner);
        addJoinRule(std::move(inner));
      }
      rule.body.push_back(holds);
    }
  }

  /// Leaves out the variables of a rule that do not occur.
  static void renumber(FactJoin::Rule& rule) {
    std::map<int, int> numbers;
    const auto use = [&](int& argument) {
      if (argument >= 0) argument = numbers.try_emplace(argument, int(numbers.size())).first->second;
    };
    for (auto* list : {&rule.heads, &rule.body}) {
      for (Atom& atom : *list) std::ranges::for_each(atom.arguments, use);
    }
    for (FactJoin::Equality& equality : rule.equalities) use(equality.a), use(equality.b);
    rule.variables = int(numbers.size());
  }

  void reach() {
    for (int r = 0; r < int(rules().size()); ++r) addJoinRules(r);
    std::vector<std::size_t> facts(rules().size(), 0), bindings(rules().size(), 0);
    names_.join.run(
        [&](int owner, std::size_t tries) {
          tries_ += tries;
          if (tries_ > kTriesPerAction * most_) refuseJoins(owner);
        },
        [&](int owner, int predicate) {
          const bool binds = predicate == indexed_[std::size_t(owner)].bindings;
          if (++(binds ? bindings : facts)[std::size_t(owner)] <= most_) return;
          if (binds) refuseJoins(owner);
          const LogicRule& rule = rules()[std::size_t(owner)];
          throw ValueError(cat("ground: ", rule.where.str(), ": rule '", rule.name, "' can make more than ", most_,
                               " facts true; the problem is too large"));
        });
  }

  /// n^k matches in the worst case, for k preconditions and n facts.
  [[noreturn]] void refuseJoins(int owner) const {
    const LogicRule& rule = rules()[std::size_t(owner)];
    throw ValueError(cat("ground: ", rule.where.str(), ": rule '", rule.name,
                         "' is one too many: facts were held against preconditions ", tries_,
                         " times; preconditions that tie its variables to one another would leave fewer"));
  }

  /// Facts are numbered by predicate, then by constants.
  void numberFacts() {
    names_.fact_numbers.resize(names_.join.predicates());
    for (const auto& [shape, predicate] : names_.predicates) {
      if (names_.join.isStatic(predicate)) continue;
      std::vector<FactTuple> tuples = names_.join.facts(predicate);
      std::ranges::sort(tuples);
      for (const FactTuple& tuple : tuples) {
        names_.fact_numbers[std::size_t(predicate)][tuple] = int(out_.facts.size());
        Literal literal{shape.first};
        for (int value : tuple) literal.arguments.push_back(names_.constants[std::size_t(value)]);
        out_.numbers.emplace(GroundProblem::keyOf(literal), int(out_.facts.size()));
        out_.facts.push_back(std::move(literal));
      }
    }
    out_.start = FactSet(out_.facts.size());
  }

  void makeRules(int number) {
    const IndexedRule& rule = indexed_[std::size_t(number)];
    std::vector<std::pair<std::vector<int>, FactTuple>> ordered;
    for (const FactTuple& binding : names_.join.facts(rule.bindings)) {
      std::vector<int> key;
      for (const Atom& atom : rule.order) {
        for (int argument : atom.arguments) {
          if (argument >= 0) key.push_back(binding[std::size_t(argument)]);
        }
      }
      key.insert(key.end(), binding.begin(), binding.end());
      ordered.emplace_back(std::move(key), binding);
    }
    std::ranges::sort(ordered);
    for (auto& [key, binding] : ordered) makeRule(number, rule, binding);
  }

  void makeRule(int number, const IndexedRule& rule, std::vector<int> binding) {
    GroundRule made;
    made.rule = number;
    for (int value : binding) made.arguments.push_back(names_.constants[std::size_t(value)]);
    if (!conditions_.add(rule.condition, binding, made)) return;
    for (const IndexedEffect& effect : rule.effects) addEffect(effect, binding, made.adds, made.deletes, true);
    for (const IndexedConditional& conditional : rule.conditional) addConditional(conditional, binding, made);
    const LogicRule& of = rules()[std::size_t(number)];
    auto& list = of.is_decision ? out_.actions : of.is_derived ? derived_ : out_.rules;
    if (list.size() >= most_) throw ValueError(cat("ground: more than ", most_, " actions; the problem is too large"));
    list.push_back(std::move(made));
  }

  void addConditional(const IndexedConditional& conditional, std::vector<int>& binding, GroundRule& made) {
    std::vector<const Atom*> guards;
    ConditionGrounder::collectGuards(conditional.when, false, guards);
    conditions_.forInstances(conditional.first, conditional.types, guards, binding, [&] {
      GroundEffect effect;
      if (!conditions_.add(conditional.when, binding, effect.when)) return true;
      const bool always = effect.when.isTrue();
      auto &adds = always ? made.adds : effect.adds, &deletes = always ? made.deletes : effect.deletes;
      for (const IndexedEffect& one : conditional.effects) addEffect(one, binding, adds, deletes, false);
      if (!always && !(effect.adds.empty() && effect.deletes.empty())) made.when.push_back(std::move(effect));
      return true;
    });
  }

  /// Adds an effect. In sequence the last effect on a fact counts, otherwise an added fact is not deleted.
  void addEffect(const IndexedEffect& effect, const std::vector<int>& binding, std::vector<int>& adds,
                 std::vector<int>& deletes, bool in_sequence) const {
    bool holds = false;
    for (int fact : conditions_.matching(effect.atom, binding, holds)) {
      auto &to = effect.negated ? deletes : adds, &from = effect.negated ? adds : deletes;
      const bool opposed = std::ranges::find(from, fact) != from.end();
      if (opposed && effect.negated && !in_sequence) continue;
      std::erase(from, fact);
      if (std::ranges::find(to, fact) == to.end()) to.push_back(fact);
    }
  }

  void makeGoal() {
    std::vector<int> binding;
    GroundCondition goal;
    for (std::size_t i = 0; i < goal_.size(); ++i) {
      if (conditions_.add(goal_[i], binding, goal)) continue;
      const std::size_t literals = out_.problem.goal.size();
      if (i < literals) {
        out_.unreachable.push_back(out_.problem.goal[i]);
      } else {
        out_.impossible.push_back(out_.problem.goal_conditions[i - literals]);
      }
    }
    out_.goal = goal.pre;
    out_.goal_not = goal.pre_not;
    out_.goal_any = goal.any;
  }

  GroundProblem out_;
  GroundNames names_;
  ConditionGrounder conditions_{names_, out_};
  std::size_t most_, tries_ = 0;
  int everything_ = 0;  ///< the predicate that all constants have
  std::vector<IndexedRule> indexed_;
  std::vector<GroundRule> derived_;
  std::vector<IndexedFormula> goal_;
};

}  // namespace

GroundProblem ground(LogicProblem problem, std::size_t most) { return Grounder(std::move(problem), most).run(); }

}  // namespace kinegraph
