#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/pddl_expression.h"

namespace kinegraph {

namespace {

using Names = std::vector<std::string>;
using Shape = std::pair<std::string, std::size_t>;  ///< predicate, number of arguments

std::string named(const std::string& variable) { return variable[0] == '?' ? variable : "?" + variable; }

std::string writtenType(const std::string& type) {
  return type.empty() ? "object" : type.starts_with(kTypePrefix) ? type.substr(kTypePrefix.size()) : type;
}

/// Names of a list with their types; without types, names alone.
std::string typedList(const Names& names, const Names& types) {
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i) {
    text += (i ? " " : "") + named(names[i]);
    if (!types.empty()) text += " - " + writtenType(types[i]);
  }
  return text;
}

/// Writes conditions and effects of a domain. In PDDL a predicate has one number of arguments: others get a suffix.
class PddlWords {
 public:
  explicit PddlWords(const LogicDomain& domain) : domain_(domain) {
    for (const auto& [type, above] : domain.types) types_.insert(type);
    for (const Signature& predicate : domain.predicates) {
      declared_.push_back(predicate);
      see({predicate.name, predicate.variables});
    }
    for (const LogicRule& rule : domain.rules) {
      for (const Literal& literal : rule.pre) see(literal);
      for (const Literal& literal : rule.eff) see(literal);
    }
    for (const Literal& fact : domain.start) see(fact);
    requireOneCase();
  }

  bool isType(const Literal& literal) const {
    return literal.arguments.size() == 1 && types_.contains(literal.predicate);
  }
  bool knows(const Literal& literal) const {
    return literal.predicate == kEqual || isType(literal) ||
           names_.contains({literal.predicate, literal.arguments.size()});
  }

  std::string predicates() const {
    std::string text = "  (:predicates";
    std::set<Shape> written;
    for (const Signature& predicate : declared_) {
      const bool typed = std::ranges::any_of(predicate.types, [](const std::string& type) { return !type.empty(); });
      const std::string list = typedList(predicate.variables, typed ? predicate.types : Names());
      text += cat(" (", predicate.name, list.empty() ? "" : " ", list, ")");
      written.insert({predicate.name, predicate.variables.size()});
    }
    for (const auto& [shape, name] : names_) {
      if (written.contains(shape)) continue;
      text += " (" + name;
      for (std::size_t i = 0; i < shape.second; ++i) text += cat(" ?", char('a' + i % 26), i < 26 ? "" : cat(i / 26));
      text += ")";
    }
    return text + ")\n";
  }

  /// Writes a literal; variables are those of a rule. ANY in a condition is quantified.
  std::string literal(const Literal& literal, const Names& variables, bool is_effect) const {
    std::string text = "(" + nameOf(literal), own;
    int count = 0;
    for (const std::string& word : literal.arguments) {
      std::string name = word;
      if (word == kAny) {
        do name = cat("?any", ++count);
        while (std::ranges::find(variables, name) != variables.end());
        own += (own.empty() ? "" : " ") + name;
      } else if (std::ranges::find(variables, word) != variables.end()) {
        name = named(word);
      }
      text += " " + name;
    }
    text += ")";
    if (own.empty()) return literal.negated ? "(not " + text + ")" : text;
    if (is_effect) return cat("(forall (", own, ") ", literal.negated ? "(not " + text + ")" : text, ")");
    text = cat("(exists (", own, ") ", text, ")");
    return literal.negated ? "(not " + text + ")" : text;
  }

  /// The name of a predicate.
  const std::string& nameOf(const Literal& literal) const {
    const auto found = names_.find({literal.predicate, literal.arguments.size()});
    if (found != names_.end()) return found->second;
    if (isType(literal) && literal.predicate.starts_with(kTypePrefix)) {
      throw ValueError(cat("writePddl: the type '", writtenType(literal.predicate),
                           "' has the name of a predicate and cannot be a condition"));
    }
    return literal.predicate;
  }

  std::string formula(const Formula& formula, const Names& variables) const {
    if (formula.kind == Formula::Kind::literal) return literal(formula.literal, variables, false);
    Names all = variables;
    all.insert(all.end(), formula.variables.begin(), formula.variables.end());
    std::string text;
    if (formula.kind == Formula::Kind::all || formula.kind == Formula::Kind::any) {
      text = formula.kind == Formula::Kind::all ? "(and" : "(or";
    } else {
      text = cat(formula.kind == Formula::Kind::forall ? "(forall (" : "(exists (",
                 typedList(formula.variables, formula.types), ")");
    }
    for (const Formula& part : formula.parts) text += " " + this->formula(part, all);
    return text + ")";
  }

 private:
  void see(const Literal& literal) {
    const Shape shape{literal.predicate, literal.arguments.size()};
    if (literal.predicate == kEqual || isType(literal) || names_.contains(shape)) return;
    // `=` of a value is no letter of a name.
    std::string base = hasValue(literal.predicate) ? literal.predicate.substr(0, literal.predicate.size() - 1) + "-is"
                                                   : literal.predicate;
    std::string name = base;
    for (std::size_t i = literal.arguments.size(); taken_.contains(lowerCase(name)); ++i) name = cat(base, "-", i);
    taken_.insert(lowerCase(name));
    names_[shape] = name;
  }

  /// PDDL has one case: names that differ in it alone would become one.
  void requireOneCase() const {
    std::map<std::string, std::string> seen;
    const auto require = [&](const std::string& word) {
      const auto [known, fresh] = seen.try_emplace(lowerCase(word), word);
      if (!fresh && known->second != word)
        throw ValueError(
            cat("writePddl: '", known->second, "' and '", word, "' differ in case alone; PDDL has one case"));
    };
    for (const std::string& symbol : domain_.symbols) require(symbol);
    for (const LogicRule& rule : domain_.rules) {
      const auto words = seen;
      for (const std::string& variable : rule.variables) require(named(variable));
      seen = words;
    }
  }

  const LogicDomain& domain_;
  std::set<std::string> types_, taken_;
  std::vector<Signature> declared_;
  std::map<Shape, std::string> names_;
};

/// Whether the list of parameters already implies a literal.
bool impliedByType(const LogicRule& rule, const Literal& literal) {
  for (std::size_t i = 0; i < rule.types.size(); ++i) {
    if (literal == Literal{rule.types[i], {rule.variables[i]}}) return true;
  }
  return false;
}

/// Whether a later effect undoes an effect: later effects of a rule win, effects of PDDL are simultaneous.
bool isUndone(const LogicRule& rule, std::size_t i) {
  const Literal& effect = rule.eff[i];
  return std::any_of(rule.eff.begin() + std::ptrdiff_t(i) + 1, rule.eff.end(), [&](const Literal& later) {
    return later.predicate == effect.predicate && later.negated != effect.negated &&
           std::ranges::equal(later.arguments, effect.arguments,
                              [](const std::string& a, const std::string& b) { return a == b || a == kAny; });
  });
}

std::string writeCost(const LogicRule& rule) {
  if (rule.cost <= 0 && rule.cost_functions.empty()) return "";
  Names terms;
  if (rule.cost > 0) terms.push_back(exact(rule.cost));
  for (const Literal& function : rule.cost_functions) {
    std::string text = "(" + function.predicate;
    for (const std::string& word : function.arguments) {
      const bool is_variable = std::ranges::find(rule.variables, word) != rule.variables.end();
      text += " " + (is_variable ? named(word) : word);
    }
    terms.push_back(text + ")");
  }
  return cat(" (increase (total-cost) ", terms.size() == 1 ? terms.front() : "(+ " + join(terms, " ") + ")", ")");
}

std::string writeConditional(const ConditionalEffect& effect, const LogicRule& rule, const PddlWords& words) {
  Names all = rule.variables;
  all.insert(all.end(), effect.variables.begin(), effect.variables.end());
  std::string text;
  for (const Literal& literal : effect.eff) text += (text.empty() ? "" : " ") + words.literal(literal, all, true);
  if (effect.eff.size() > 1) text = "(and " + text + ")";
  if (effect.when != Formula()) text = cat("(when ", words.formula(effect.when, all), " ", text, ")");
  if (!effect.variables.empty()) text = cat("(forall (", typedList(effect.variables, effect.types), ") ", text, ")");
  return "\n      " + text;
}

/// The precondition of an action, the condition of a derived predicate.
std::string writeCondition(const LogicDomain& domain, const LogicRule& rule, const PddlWords& words) {
  std::string text = "(and";
  for (const Literal& literal : rule.pre) {
    if (!impliedByType(rule, literal)) text += " " + words.literal(literal, rule.variables, false);
  }
  for (const Formula& formula : rule.conditions) text += " " + words.formula(formula, rule.variables);
  for (std::size_t i = 0; domain.distinct_variables && i < rule.variables.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      text += cat(" (not (= ", named(rule.variables[k]), " ", named(rule.variables[i]), "))");
  }
  return text + ")";
}

std::string writeDerived(const LogicDomain& domain, const LogicRule& rule, const PddlWords& words) {
  const std::string list = typedList(rule.variables, rule.types);
  return cat("  (:derived (", words.nameOf(rule.eff.front()), list.empty() ? "" : " ", list, ")\n    ",
             writeCondition(domain, rule, words), ")\n");
}

std::string writeAction(const LogicDomain& domain, const LogicRule& rule, const PddlWords& words) {
  if (rule.is_derived) return writeDerived(domain, rule, words);
  if (!rule.is_decision)
    throw ValueError(cat("writePddl: rule '", rule.name, "' fires automatically; PDDL has actions only"));
  std::string text = cat("  (:action ", rule.name, "\n    :parameters (", typedList(rule.variables, rule.types),
                         ")\n    :precondition ", writeCondition(domain, rule, words), "\n    :effect (and");
  for (std::size_t i = 0; i < rule.eff.size(); ++i) {
    if (!isUndone(rule, i)) text += " " + words.literal(rule.eff[i], rule.variables, true);
  }
  for (const ConditionalEffect& effect : rule.conditional) text += writeConditional(effect, rule, words);
  return text + writeCost(rule) + "))\n";
}

std::string writeTypes(const LogicDomain& domain) {
  if (domain.types.empty()) return "";
  std::string text = "  (:types";
  for (const auto& [type, above] : domain.types) text += cat(" ", writtenType(type), " - ", writtenType(above));
  return text + ")\n";
}

/// All supertypes of a type.
Names supertypes(const LogicDomain& domain, const std::string& type) {
  Names above = {type};
  for (std::size_t i = 0; i < above.size(); ++i) {  // grows
    for (const auto& [name, next] : domain.types) {
      if (name == above[i] && !next.empty() && std::ranges::find(above, next) == above.end()) above.push_back(next);
    }
  }
  above.erase(above.begin());
  return above;
}

/// ` a - t`; of several types those that no other one implies.
std::string writeObject(const std::string& object, const LogicDomain& domain, const Names& types) {
  if (domain.types.empty()) return " " + object;
  std::set<std::string> implied;
  for (const std::string& type : types) {
    for (const std::string& above : supertypes(domain, type)) implied.insert(above);
  }
  Names least;
  for (const std::string& type : types) {
    if (!implied.contains(type) && std::ranges::find(least, writtenType(type)) == least.end())
      least.push_back(writtenType(type));
  }
  if (least.empty()) least = {types.empty() ? "object" : writtenType(types.front())};
  return cat(" ", object, " - ", least.size() == 1 ? least.front() : "(either " + join(least, " ") + ")");
}

/// The types of all constants in a list of facts.
std::map<std::string, Names> typesIn(const std::vector<Literal>& facts, const PddlWords& words) {
  std::map<std::string, Names> types;
  for (const Literal& fact : facts) {
    if (words.isType(fact)) types[fact.arguments.front()].push_back(fact.predicate);
  }
  return types;
}

void addConstants(const Literal& literal, const Names& variables, std::set<std::string>& names) {
  for (const std::string& word : literal.arguments) {
    if (word != kAny && std::ranges::find(variables, word) == variables.end()) names.insert(word);
  }
}

/// Constants that are declared, or stand in rules and in the facts of the domain.
Names constantsOf(const LogicDomain& domain) {
  std::set<std::string> names;
  for (const LogicRule& rule : domain.rules) {
    for (const auto* list : {&rule.pre, &rule.eff}) {
      for (const Literal& literal : *list) addConstants(literal, rule.variables, names);
    }
  }
  for (const std::string& name : domain.constants) names.erase(name);
  Names all = domain.constants;
  all.insert(all.end(), names.begin(), names.end());
  return all;
}

std::string writeFunctions(const LogicDomain& domain) {
  const bool has_costs = std::ranges::any_of(
      domain.rules, [](const LogicRule& rule) { return rule.cost > 0 || !rule.cost_functions.empty(); });
  const bool has_total = std::ranges::any_of(
      domain.functions, [](const Signature& function) { return lowerCase(function.name) == "total-cost"; });
  if (!has_costs && domain.functions.empty()) return "";
  std::string text = cat("  (:functions", has_costs && !has_total ? " (total-cost) - number" : "");
  for (const Signature& function : domain.functions) {
    const bool typed = std::ranges::any_of(function.types, [](const std::string& type) { return !type.empty(); });
    const std::string list = typedList(function.variables, typed ? function.types : Names());
    text += cat(" (", function.name, list.empty() ? "" : " ", list, ") - number");
  }
  return text + ")\n";
}

}  // namespace

std::string writePddlDomain(const LogicDomain& domain) {
  const PddlWords words(domain);
  std::string requirements = ":strips :typing :negative-preconditions :equality";
  std::string actions;
  for (const LogicRule& rule : domain.rules) actions += writeAction(domain, rule, words);
  if (actions.find("(:derived ") != std::string::npos) requirements += " :derived-predicates";
  if (actions.find("(or ") != std::string::npos) requirements += " :disjunctive-preconditions";
  if (actions.find("(exists ") != std::string::npos) requirements += " :existential-preconditions";
  if (actions.find("(forall ") != std::string::npos) requirements += " :universal-preconditions";
  if (actions.find("(when ") != std::string::npos || actions.find("(forall ") != std::string::npos)
    requirements += " :conditional-effects";
  const std::string functions = writeFunctions(domain);
  if (!functions.empty()) requirements += " :action-costs";
  std::string text = cat("(define (domain ", domain.name, ")\n  (:requirements ", requirements, ")\n");
  const Names constants = constantsOf(domain);
  std::string listed;
  std::map<std::string, Names> types = typesIn(domain.start, words);
  for (const std::string& name : constants) listed += writeObject(name, domain, types[name]);
  text += writeTypes(domain) + (listed.empty() ? "" : "  (:constants" + listed + ")\n");
  return text + words.predicates() + functions + actions + ")\n";
}

std::string writePddlProblem(const LogicProblem& problem) {
  const LogicDomain& domain = problem.domain;
  const PddlWords words(domain);
  // Facts with words that the domain does not declare matter to no action. In the goal they hold, or nothing helps.
  std::vector<Literal> start, goal;
  std::ranges::copy_if(problem.start, std::back_inserter(start),
                       [&](const Literal& fact) { return words.knows(fact) && !fact.negated; });
  for (const Literal& literal : problem.goal) {
    const Literal fact{literal.predicate, literal.arguments};
    const bool holds = std::ranges::find(problem.start, fact) != problem.start.end();
    if (!words.knows(literal) && holds == literal.negated)
      throw ValueError(cat("writePddl: no action has the predicate of ", literal.str(), " in the goal"));
    if (words.knows(literal)) goal.push_back(literal);
  }
  Names objects;
  std::set<std::string> known;
  for (const std::string& name : constantsOf(domain)) known.insert(name);
  for (const std::string& name : problem.constants) {
    if (known.insert(name).second) objects.push_back(name);
  }
  std::set<std::string> others;
  for (const auto* list : {&start, &goal}) {
    for (const Literal& literal : *list) addConstants(literal, {}, others);
  }
  for (const FunctionValue& value : problem.values) addConstants(value.function, {}, others);
  for (const std::string& name : others) {
    if (known.insert(name).second) objects.push_back(name);
  }
  std::map<std::string, Names> types = typesIn(start, words);
  std::string text = cat("(define (problem ", problem.name, ")\n  (:domain ", domain.name, ")\n  (:objects");
  for (const std::string& object : objects) text += writeObject(object, domain, types[object]);
  text += ")\n  (:init";
  for (const Literal& fact : start) {
    if (!words.isType(fact)) text += "\n    " + words.literal(fact, {}, true);
  }
  if (problem.minimize_cost) text += "\n    (= (total-cost) 0)";
  for (const FunctionValue& value : problem.values)
    text += cat("\n    (= ", words.literal(value.function, {}, true), " ", exact(value.value), ")");
  text += ")\n  (:goal (and";
  for (const Literal& literal : goal) text += " " + words.literal(literal, {}, false);
  for (const Formula& formula : problem.goal_conditions) text += " " + words.formula(formula, {});
  return text + cat("))", problem.minimize_cost ? "\n  (:metric minimize (total-cost))" : "", ")\n");
}

}  // namespace kinegraph
