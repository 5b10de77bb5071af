#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/pddl.h"

namespace kinegraph {

namespace {

bool isVariable(const LogicRule& rule, const std::string& word) {
  return std::ranges::find(rule.variables, word) != rule.variables.end();
}

std::string named(const std::string& variable) { return variable[0] == '?' ? variable : "?" + variable; }

std::string written(const Literal& literal, const LogicRule* rule) {
  std::string text = "(" + literal.predicate;
  for (const std::string& word : literal.arguments) {
    if (word == kAny) throw ValueError(cat("writePddl: ", literal.str(), ": PDDL has no ANY"));
    text += " " + (rule && isVariable(*rule, word) ? named(word) : word);
  }
  text += ")";
  return literal.negated ? "(not " + text + ")" : text;
}

/// Whether the list of parameters already implies a literal.
bool saidByType(const LogicRule& rule, const Literal& literal) {
  for (std::size_t i = 0; i < rule.types.size(); ++i) {
    if (literal == Literal{rule.types[i], {rule.variables[i]}}) return true;
  }
  return false;
}

std::string writeAction(const LogicDomain& domain, const LogicRule& rule) {
  if (!rule.is_decision)
    throw ValueError(cat("writePddl: rule '", rule.name, "' fires automatically; PDDL has actions only"));
  std::string text = cat("  (:action ", rule.name, "\n    :parameters (");
  for (std::size_t i = 0; i < rule.variables.size(); ++i) {
    text += (i ? " " : "") + named(rule.variables[i]);
    if (!rule.types.empty()) text += " - " + (rule.types[i].empty() ? std::string("object") : rule.types[i]);
  }
  text += ")\n    :precondition (and";
  for (const Literal& literal : rule.pre) {
    if (!saidByType(rule, literal)) text += " " + written(literal, &rule);
  }
  for (std::size_t i = 0; domain.distinct_variables && i < rule.variables.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      text += cat(" (not (= ", named(rule.variables[k]), " ", named(rule.variables[i]), "))");
  }
  text += ")\n    :effect (and";
  // Later effects win; effects of PDDL are simultaneous.
  for (std::size_t i = 0; i < rule.eff.size(); ++i) {
    const bool undone =
        std::any_of(rule.eff.begin() + std::ptrdiff_t(i) + 1, rule.eff.end(), [&](const Literal& later) {
          return later.predicate == rule.eff[i].predicate && later.arguments == rule.eff[i].arguments;
        });
    if (!undone) text += " " + written(rule.eff[i], &rule);
  }
  return text + "))\n";
}

std::string writePredicates(const LogicDomain& domain) {
  std::map<std::string, std::size_t> arity;
  std::set<std::string> types;
  for (const auto& [type, above] : domain.types) types.insert(type);
  const auto see = [&](const Literal& literal) {
    if (literal.predicate != kEqual && !types.contains(literal.predicate))
      arity[literal.predicate] = literal.arguments.size();
  };
  for (const LogicRule& rule : domain.rules) {
    for (const Literal& literal : rule.pre) see(literal);
    for (const Literal& literal : rule.eff) see(literal);
  }
  for (const Literal& fact : domain.start) see(fact);
  std::string text = "  (:predicates";
  for (const auto& [name, arguments] : arity) {
    text += " (" + name;
    for (std::size_t i = 0; i < arguments; ++i) text += cat(" ?", char('a' + i % 26));
    text += ")";
  }
  return text + ")\n";
}

std::string writeTypes(const LogicDomain& domain) {
  if (domain.types.empty()) return "";
  std::string text = "  (:types";
  for (const auto& [type, above] : domain.types)
    text += cat(" ", type, above.empty() ? std::string(" - object") : " - " + above);
  return text + ")\n";
}

/// Constants in rules.
std::string writeConstants(const LogicDomain& domain) {
  std::set<std::string> names;
  for (const LogicRule& rule : domain.rules) {
    for (const auto* list : {&rule.pre, &rule.eff}) {
      for (const Literal& literal : *list) {
        for (const std::string& word : literal.arguments) {
          if (!isVariable(rule, word) && word != kAny) names.insert(word);
        }
      }
    }
  }
  if (names.empty()) return "";
  return "  (:constants " + join({names.begin(), names.end()}, " ") + ")\n";
}

}  // namespace

std::string writePddlDomain(const LogicDomain& domain) {
  std::string text =
      cat("(define (domain ", domain.name, ")\n  (:requirements :strips :typing :negative-preconditions :equality)\n");
  text += writeTypes(domain) + writeConstants(domain) + writePredicates(domain);
  for (const LogicRule& rule : domain.rules) text += writeAction(domain, rule);
  return text + ")\n";
}

std::string writePddlProblem(const LogicProblem& problem) {
  std::set<std::string> objects(problem.constants.begin(), problem.constants.end());
  std::set<std::string> types;
  for (const auto& [type, above] : problem.domain.types) types.insert(type);
  std::map<std::string, std::string> type_of;
  for (const auto* list : {&problem.start, &problem.goal}) {
    for (const Literal& literal : *list) objects.insert(literal.arguments.begin(), literal.arguments.end());
  }
  for (const Literal& fact : problem.start) {
    if (types.contains(fact.predicate) && !type_of.contains(fact.arguments.front()))
      type_of[fact.arguments.front()] = fact.predicate;
  }
  std::string text = cat("(define (problem ", problem.name, ")\n  (:domain ", problem.domain.name, ")\n  (:objects");
  for (const std::string& object : objects) {
    text += " " + object;
    if (!types.empty()) text += " - " + (type_of.contains(object) ? type_of[object] : std::string("object"));
  }
  text += ")\n  (:init";
  for (const Literal& fact : problem.start) {
    if (!types.contains(fact.predicate) && !fact.negated) text += "\n    " + written(fact, nullptr);
  }
  text += ")\n  (:goal (and";
  for (const Literal& literal : problem.goal) text += " " + written(literal, nullptr);
  return text + ")))\n";
}

}  // namespace kinegraph
