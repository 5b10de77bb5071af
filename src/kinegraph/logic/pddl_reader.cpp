#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/pddl_conditions.h"
#include "kinegraph/logic/pddl_names.h"

namespace kinegraph {

namespace {

/// Returns the definition of a kind, `domain` or `problem`: one file may have one of each.
PddlExpression definitionOf(std::string_view text, const std::string& file, const char* kind) {
  const std::vector<PddlExpression> all = readPddlDefinitions(text, file);
  const auto isOne = [&](const PddlExpression& definition) {
    return definition.list.size() > 1 && definition.list[1].head() == kind;
  };
  const auto first = std::ranges::find_if(all, isOne);
  if (first == all.end()) throw ParseError(all.front().where, cat("expected (define (", kind, " ...) ...)"));
  const auto second = std::find_if(first + 1, all.end(), isOne);
  if (second != all.end())
    throw ParseError(second->where, cat("a second ", kind, " in one file; the first is at ", first->where.str()));
  return *first;
}

[[noreturn]] void refusePart(const PddlExpression& part, const char* of, const std::vector<std::string>& known) {
  if (!part.isList()) refusePddl(part, cat("a list, as (", known.back(), " ...)"));
  static const std::vector<std::string> beyond = {":durative-action", ":constraints", ":process", ":event"};
  const std::string head = part.head();
  if (std::ranges::find(beyond, head) != beyond.end())
    throw ParseError(part.where, cat("'", head, "' is not supported; expected one of ", join(known)));
  throw ParseError(part.where, cat("unknown part '", head, "' of a ", of, "; expected one of ", join(known),
                                   similarHint(head, known)));
}

Signature signatureOf(const PddlExpression& at, PddlNames& names) {
  if (!at.isList() || at.list.empty()) refusePddl(at, "a predicate such as (on ?place ?thing)");
  Signature made{names.spell(pddlWord(at.list[0], "the predicate's name"))};
  for (const PddlTyped& argument : pddlTypedNames(at, 1, "an argument")) {
    made.variables.push_back(names.spell(argument.name));
    // Types of arguments restrict nothing; unknown ones are left out.
    try {
      made.types.push_back(names.typeOf(argument));
    } catch (const ParseError&) {
      made.types.emplace_back();
    }
  }
  return made;
}

bool isDerived(const LogicDomain& domain, const Literal& literal) {
  return std::ranges::any_of(domain.rules, [&](const LogicRule& rule) {
    return rule.is_derived && rule.name == literal.predicate && rule.variables.size() == literal.arguments.size();
  });
}

class DomainReader {
 public:
  DomainReader() : names_(domain_), conditions_(names_) { domain_.distinct_variables = false; }

  LogicDomain read(const PddlExpression& all) {
    const std::vector<std::string> known = {"domain",      ":requirements", ":types",   ":constants",
                                            ":predicates", ":functions",    ":derived", ":action"};
    for (std::size_t i = 1; i < all.list.size(); ++i) {
      const std::string head = all.list[i].head();
      if (std::ranges::find(known, head) == known.end()) refusePart(all.list[i], "domain", known);
      if (head != ":predicates") continue;
      for (std::size_t k = 1; k < all.list[i].list.size(); ++k) {
        const PddlExpression& predicate = all.list[i].list[k];
        if (predicate.isList() && !predicate.list.empty()) names_.addPredicateName(predicate.list[0].word);
      }
    }
    // The order of the parts has no meaning. Requirements are not needed: each construct is read or refused.
    for (const std::string& part : known) {
      for (std::size_t i = 1; i < all.list.size(); ++i) {
        if (all.list[i].head() == part) readPart(part, all.list[i]);
      }
    }
    names_.addSupertypes(domain_.start);
    requireDerivedWithoutEffects();
    return std::move(domain_);
  }

 private:
  void readPart(const std::string& head, const PddlExpression& part) {
    if (head == "domain") {
      if (part.list.size() == 2) domain_.name = pddlWord(part.list[1], "the domain's name");
    } else if (head == ":types") {
      names_.addTypes(pddlTypedNames(part, 1, "a type"));
    } else if (head == ":constants") {
      readConstants(part);
    } else if (head == ":predicates") {
      for (std::size_t i = 1; i < part.list.size(); ++i) addSignature(part.list[i], domain_.predicates, false);
    } else if (head == ":functions") {
      for (std::size_t i = 1; i < part.list.size(); ++i) readFunction(part, i);
    } else if (head == ":derived") {
      readDerived(part);
    } else if (head == ":action") {
      readAction(part);
    }
  }

  void readConstants(const PddlExpression& part) {
    for (const PddlTyped& constant : pddlTypedNames(part, 1, "a constant")) {
      const std::string name = names_.spell(constant.name);
      if (std::ranges::find(domain_.constants, name) == domain_.constants.end()) {
        domain_.symbols.push_back(name);
        domain_.constants.push_back(name);
      }
      names_.addConstant(name);
      for (const Literal& fact : names_.typeFacts(constant)) domain_.start.push_back(fact);
    }
  }

  void addSignature(const PddlExpression& at, std::vector<Signature>& list, bool is_function) {
    list.push_back(signatureOf(at, names_));
    const Signature& made = list.back();
    const auto same = std::ranges::find(list, made.name, &Signature::name);
    if (same->variables.size() != made.variables.size()) {
      throw ParseError(at.where, cat("'", made.name, "' is declared with ", same->variables.size(), " and ",
                                     made.variables.size(), " arguments"));
    }
    names_.addSignature(made, is_function);
    if (same + 1 != list.end()) {  // declared twice
      list.pop_back();
    } else if (!is_function) {
      domain_.symbols.push_back(made.name);
    }
  }

  /// `(length ?a ?b) - number`
  void readFunction(const PddlExpression& part, std::size_t& i) {
    if (part.list[i].isList()) return addSignature(part.list[i], domain_.functions, true);
    if (part.list[i].word != "-" || i + 1 >= part.list.size()) refusePddl(part.list[i], "(length ?a ?b) - number");
    if (part.list[++i].key() != "number")
      throw ParseError(part.list[i].where, "functions with objects as values are not supported; expected number");
  }

  void readAction(const PddlExpression& part) {
    if (part.list.size() < 2) throw ParseError(part.where, "expected the action's name");
    LogicRule rule;
    rule.where = part.where;
    rule.name = names_.spell(pddlWord(part.list[1], "the action's name"));
    const PddlExpression *pre = nullptr, *eff = nullptr;
    for (std::size_t i = 2; i < part.list.size(); i += 2) {
      const std::string key = lowerCase(pddlWord(part.list[i], ":parameters, :precondition or :effect"));
      if (i + 1 >= part.list.size()) throw ParseError(part.list[i].where, cat("expected a list behind ", key));
      const PddlExpression& value = part.list[i + 1];
      if (key == ":parameters") {
        if (!value.isList()) refusePddl(value, "a list of parameters");
        readParameters(rule, value, 0);
      } else if (key == ":precondition") {
        pre = &value;
      } else if (key == ":effect") {
        eff = &value;
      } else {
        refusePddl(part.list[i], ":parameters, :precondition or :effect");
      }
    }
    if (pre) PddlConditions::split(conditions_.read(*pre, rule.variables), rule.pre, rule.conditions);
    if (!eff) throw ParseError(part.where, cat("action '", rule.name, "' has no :effect"));
    conditions_.readEffects(*eff, rule);
    domain_.rules.push_back(std::move(rule));
  }

  /// `(:derived (above ?a ?b) (or (on ?a ?b) ...))`
  void readDerived(const PddlExpression& part) {
    if (part.list.size() != 3 || !part.list[1].isList() || part.list[1].list.empty())
      refusePddl(part, "(:derived (above ?a ?b) (on ?a ?b))");
    const PddlExpression& head = part.list[1];
    LogicRule rule;
    rule.is_decision = false;
    rule.is_derived = true;
    rule.where = part.where;
    rule.name = names_.spell(pddlWord(head.list[0], "the predicate's name"));
    readParameters(rule, head, 1);
    PddlExpression fact = head;  // without types
    fact.list.resize(1);
    for (const std::string& variable : rule.variables) fact.list.push_back({variable, {}, head.where});
    rule.eff = {names_.literalOf(fact, rule.variables)};
    PddlConditions::split(conditions_.read(part.list[2], rule.variables), rule.pre, rule.conditions);
    domain_.rules.push_back(std::move(rule));
  }

  void requireDerivedWithoutEffects() const {
    const auto require = [&](const std::vector<Literal>& effects) {
      for (const Literal& effect : effects) {
        if (isDerived(domain_, effect))
          throw ParseError(effect.where, cat("'", effect.predicate, "' is derived and cannot be an effect"));
      }
    };
    for (const LogicRule& rule : domain_.rules) {
      if (rule.is_derived) continue;
      require(rule.eff);
      for (const ConditionalEffect& conditional : rule.conditional) require(conditional.eff);
    }
  }

  /// Reads the variables of a list from an index on.
  void readParameters(LogicRule& rule, const PddlExpression& list, std::size_t from) {
    readPddlVariables(list, from, names_, rule.variables, rule.types);
    for (std::size_t i = 0; i < rule.variables.size(); ++i) {
      if (!rule.types[i].empty()) rule.pre.push_back({rule.types[i], {rule.variables[i]}, false, list.where});
    }
    if (std::ranges::all_of(rule.types, &std::string::empty)) rule.types.clear();
  }

  LogicDomain domain_;
  PddlNames names_;
  PddlConditions conditions_;
};

class ProblemReader {
 public:
  explicit ProblemReader(const LogicDomain& domain)
      : problem_{"problem", domain, domain.constants, domain.start, {}}, names_(problem_.domain), conditions_(names_) {}

  LogicProblem read(const PddlExpression& all) {
    const std::vector<std::string> known = {"problem", ":requirements", ":domain", ":objects",
                                            ":init",   ":goal",         ":metric"};
    for (std::size_t i = 1; i < all.list.size(); ++i) {
      const std::string head = all.list[i].head();
      if (std::ranges::find(known, head) == known.end()) refusePart(all.list[i], "problem", known);
    }
    for (const std::string& part : known) {
      for (std::size_t i = 1; i < all.list.size(); ++i) {
        if (all.list[i].head() == part) readPart(part, all.list[i]);
      }
    }
    if (!has_goal_) throw ParseError(all.where, cat("problem '", problem_.name, "' has no (:goal ...)"));
    names_.addSupertypes(problem_.start);
    return std::move(problem_);
  }

 private:
  void readPart(const std::string& head, const PddlExpression& part) {
    if (head == "problem") {
      if (part.list.size() == 2) problem_.name = pddlWord(part.list[1], "the problem's name");
    } else if (head == ":domain") {
      if (part.list.size() != 2 || part.list[1].key() != lowerCase(problem_.domain.name))
        throw ParseError(part.where,
                         cat("the problem is of the domain '", part.list.size() > 1 ? part.list[1].word : std::string(),
                             "'; expected '", problem_.domain.name, "'"));
    } else if (head == ":objects") {
      readObjects(part);
    } else if (head == ":init") {
      for (std::size_t k = 1; k < part.list.size(); ++k) readFact(part.list[k]);
    } else if (head == ":goal") {
      if (part.list.size() != 2) throw ParseError(part.where, "expected (:goal (and ...))");
      has_goal_ = true;
      PddlConditions::split(conditions_.read(part.list[1], {}), problem_.goal, problem_.goal_conditions);
    } else if (head == ":metric") {
      readMetric(part);
    }
  }

  void readObjects(const PddlExpression& part) {
    for (const PddlTyped& object : pddlTypedNames(part, 1, "an object")) {
      const std::string name = names_.spell(object.name);
      if (std::ranges::find(problem_.constants, name) == problem_.constants.end()) problem_.constants.push_back(name);
      names_.addConstant(name);
      for (const Literal& fact : names_.typeFacts(object)) problem_.start.push_back(fact);
    }
  }

  void readFact(const PddlExpression& at) {
    const std::string head = at.head();
    if (head == "and") {
      for (std::size_t i = 1; i < at.list.size(); ++i) readFact(at.list[i]);
    } else if (head == "not") {  // facts that are not listed do not hold
      if (at.list.size() != 2) refusePddl(at, "(not (p a))");
      const Literal fact = names_.literalOf(at.list[1], {});
      denied_.push_back(fact);
      requireConsistent(fact, at);
    } else if (head == "=" && at.list.size() == 3 && (at.list[1].isList() || !at.list[2].isList())) {
      const std::string name = at.list[1].isList() ? at.list[1].head() : at.list[1].key();
      if (name == "total-cost") return void(PddlConditions::numberOf(at.list[2]));
      const Literal function = names_.literalOf(at.list[1], {}, true);
      problem_.values.push_back({function, PddlConditions::numberOf(at.list[2])});
    } else if (head == "at" && at.list.size() == 3 && at.list[2].isList()) {
      throw ParseError(at.where, "facts at a later time are not supported; expected facts of the start");
    } else {
      problem_.start.push_back(names_.literalOf(at, {}));
      if (isDerived(problem_.domain, problem_.start.back()))
        throw ParseError(at.where, cat("'", problem_.start.back().predicate, "' is derived and cannot be in :init"));
      requireConsistent(problem_.start.back(), at);
    }
  }

  void requireConsistent(const Literal& fact, const PddlExpression& at) const {
    if (std::ranges::find(denied_, fact) != denied_.end() &&
        std::ranges::find(problem_.start, fact) != problem_.start.end())
      throw ParseError(at.where, cat(fact.str(), " holds and does not hold in :init"));
  }

  void readMetric(const PddlExpression& part) {
    const bool is_pair = part.list.size() == 3;
    const std::string what = !is_pair ? "" : part.list[2].isList() ? part.list[2].head() : part.list[2].key();
    if (!is_pair || part.list[1].key() != "minimize" || what != "total-cost")
      throw ParseError(part.where, "expected (:metric minimize (total-cost)); other metrics are not supported");
    problem_.minimize_cost = true;
  }

  LogicProblem problem_;
  PddlNames names_;
  PddlConditions conditions_;
  std::vector<Literal> denied_;
  bool has_goal_ = false;
};

}  // namespace

LogicDomain readPddlDomain(std::string_view text, const std::string& file) {
  return DomainReader().read(definitionOf(text, file, "domain"));
}

LogicProblem readPddlProblem(std::string_view text, const LogicDomain& domain, const std::string& file) {
  return ProblemReader(domain).read(definitionOf(text, file, "problem"));
}

}  // namespace kinegraph
