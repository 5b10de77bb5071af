#include "kinegraph/logic/pddl_conditions.h"

#include <algorithm>
#include <charconv>

#include "kinegraph/common/text.h"

namespace kinegraph::inline logic_internal {

namespace {

using Kind = Formula::Kind;

/// Adds a part to `all` or `any`; parts of the same kind are merged.
void addPart(Formula& to, Formula part) {
  if (part.kind == to.kind) {
    for (Formula& inner : part.parts) addPart(to, std::move(inner));
  } else {
    to.parts.push_back(std::move(part));
  }
}

Formula unwrapped(Formula formula) { return formula.parts.size() == 1 ? formula.parts.front() : formula; }

const std::vector<std::string> kArithmetic = {"<", ">", "<=", ">="};
const std::vector<std::string> kNumeric = {"decrease", "assign", "scale-up", "scale-down"};

bool isOneOf(const std::string& word, const std::vector<std::string>& list) {
  return std::ranges::find(list, word) != list.end();
}

void renameVariable(const PddlExpression& from, PddlExpression& in, const std::string& key, const std::string& fresh) {
  if (!from.isList() && from.key() == key) in.word = fresh;
  for (std::size_t i = 0; i < from.list.size(); ++i) renameVariable(from.list[i], in.list[i], key, fresh);
}

/// Renames variables of a quantifier that the surroundings have, too: (forall (?x) ...) within an action of ?x.
PddlExpression withOwnVariables(const PddlExpression& at, const std::vector<std::string>& taken) {
  PddlExpression own = at;
  std::vector<std::string> keys;
  for (const std::string& name : taken) keys.push_back(lowerCase(name));
  for (const PddlTyped& variable : pddlTypedNames(at.list[1], 0, "a variable such as ?x")) {
    const std::string key = lowerCase(variable.name);
    if (!isOneOf(key, keys)) continue;
    std::string fresh = key;
    for (int i = 2; isOneOf(fresh, keys); ++i) fresh = cat(key, "-", i);
    renameVariable(PddlExpression(own), own, key, fresh);
  }
  return own;
}

void requireQuantifier(const PddlExpression& at) {
  if (at.list.size() != 3 || !at.list[1].isList()) refusePddl(at, cat("(", at.head(), " (?x - type) (p ?x))"));
}

}  // namespace

void readPddlVariables(const PddlExpression& list, std::size_t from, PddlNames& names,
                       std::vector<std::string>& variables, std::vector<std::string>& types) {
  for (const PddlTyped& variable : pddlTypedNames(list, from, "a variable such as ?x")) {
    if (variable.name[0] != '?')
      throw ParseError(variable.where, cat("parameter '", variable.name, "' does not begin with '?'"));
    const std::string name = names.spell(variable.name);
    if (isOneOf(name, variables)) throw ParseError(variable.where, cat("variable '", name, "' occurs twice"));
    variables.push_back(name);
    types.push_back(names.typeOf(variable));
  }
}

void PddlConditions::addVariables(const PddlExpression& list, std::vector<std::string>& all,
                                  std::vector<std::string>& variables, std::vector<std::string>& types) {
  std::vector<std::string> own;
  readPddlVariables(list, 0, names_, own, types);
  variables.insert(variables.end(), own.begin(), own.end());
  all.insert(all.end(), own.begin(), own.end());
}

Formula PddlConditions::read(const PddlExpression& at, const std::vector<std::string>& variables, bool negated) {
  if (!at.isList()) refusePddl(at, "a list such as (and (p ?x) (not (q ?x)))");
  const std::string head = at.head();
  Formula made;
  if (at.list.empty() || head == "and" || head == "or") {
    made.kind = (head == "or") != negated ? Kind::any : Kind::all;
    for (std::size_t i = 1; i < at.list.size(); ++i) addPart(made, read(at.list[i], variables, negated));
    return unwrapped(std::move(made));
  }
  if (head == "not") {
    if (at.list.size() != 2 || !at.list[1].isList()) refusePddl(at, "(not (p ?x))");
    return read(at.list[1], variables, !negated);
  }
  if (head == "imply") {
    if (at.list.size() != 3) refusePddl(at, "(imply (p ?x) (q ?x))");
    made.kind = negated ? Kind::all : Kind::any;
    addPart(made, read(at.list[1], variables, !negated));
    addPart(made, read(at.list[2], variables, negated));
    return unwrapped(std::move(made));
  }
  if (head == "forall" || head == "exists") {
    requireQuantifier(at);
    const PddlExpression own = withOwnVariables(at, variables);
    made.kind = (head == "exists") != negated ? Kind::exists : Kind::forall;
    std::vector<std::string> all = variables;
    addVariables(own.list[1], all, made.variables, made.types);
    made.parts.push_back(read(own.list[2], all, negated));
    return made.variables.empty() ? made.parts.front() : made;
  }
  if (isOneOf(head, kArithmetic) || (head == "=" && at.list.size() == 3 && at.list[1].isList()))
    throw ParseError(at.where, cat("'", head, "' compares numbers, which is not supported; expected a predicate"));
  if (head == "preference") throw ParseError(at.where, "preferences are not supported; expected a condition");
  made.kind = Kind::literal;
  made.literal = names_.literalOf(at, variables);
  made.literal.negated = negated;
  return made;
}

void PddlConditions::split(Formula formula, std::vector<Literal>& literals, std::vector<Formula>& rest) {
  if (formula.kind == Kind::literal) {
    if (std::ranges::find(literals, formula.literal) == literals.end()) literals.push_back(formula.literal);
  } else if (formula.kind == Kind::all) {
    for (Formula& part : formula.parts) split(std::move(part), literals, rest);
  } else {
    rest.push_back(std::move(formula));
  }
}

void PddlConditions::readEffects(const PddlExpression& at, LogicRule& rule) {
  readEffect(at, rule, {rule.variables, {}, {}, {}});
  // Effects of PDDL are simultaneous: an added fact is not deleted, and twice is once.
  std::vector<Literal> all;
  for (Literal& effect : rule.eff) {
    Literal added = effect;
    added.negated = false;
    const bool is_known = std::ranges::find(all, effect) != all.end();
    const bool is_undone = effect.negated && std::ranges::find(rule.eff, added) != rule.eff.end();
    if (!is_known && !is_undone) all.push_back(effect);
  }
  std::ranges::stable_sort(all, {}, [](const Literal& effect) { return !effect.negated; });
  rule.eff = std::move(all);
}

void PddlConditions::readEffect(const PddlExpression& at, LogicRule& rule, const Within& within) {
  if (!at.isList()) refusePddl(at, "a list such as (and (p ?x) (not (q ?x)))");
  if (at.list.empty()) return;
  const std::string head = at.head();
  if (head == "and") {
    for (std::size_t i = 1; i < at.list.size(); ++i) readEffect(at.list[i], rule, within);
  } else if (head == "forall") {
    requireQuantifier(at);
    const PddlExpression own = withOwnVariables(at, within.all);
    Within inner = within;
    addVariables(own.list[1], inner.all, inner.variables, inner.types);
    readEffect(own.list[2], rule, inner);
  } else if (head == "when") {
    if (at.list.size() != 3) refusePddl(at, "(when (p ?x) (q ?x))");
    Within inner = within;
    inner.when.push_back(read(at.list[1], within.all));
    readEffect(at.list[2], rule, inner);
  } else if (head == "increase") {
    readCost(at, rule, within);
  } else if (isOneOf(head, kNumeric)) {
    throw ParseError(at.where, cat("'", head, "' is not supported; expected (increase (total-cost) ...)"));
  } else {
    const bool negated = head == "not";
    if (negated && (at.list.size() != 2 || !at.list[1].isList())) refusePddl(at, "(not (p ?x))");
    Literal literal = names_.literalOf(negated ? at.list[1] : at, within.all);
    literal.negated = negated;
    if (literal.predicate == kEqual) throw ParseError(at.where, "'=' cannot be an effect");
    Formula when;
    for (const Formula& part : within.when) addPart(when, part);
    when = unwrapped(std::move(when));
    if (within.variables.empty() && when == Formula()) {
      rule.eff.push_back(std::move(literal));
      return;
    }
    // Effects under the same condition are one entry.
    ConditionalEffect effect{within.variables, within.types, std::move(when), {}};
    if (!rule.conditional.empty()) {
      ConditionalEffect& last = rule.conditional.back();
      effect.eff = last.eff;
      if (last == effect) return last.eff.push_back(std::move(literal));
    }
    effect.eff = {std::move(literal)};
    rule.conditional.push_back(std::move(effect));
  }
}

void PddlConditions::readCost(const PddlExpression& at, LogicRule& rule, const Within& within) {
  if (at.list.size() != 3) refusePddl(at, "(increase (total-cost) 2)");
  const PddlExpression& what = at.list[1];
  const std::string name = what.isList() ? what.head() : what.key();
  if (name != "total-cost")
    throw ParseError(at.where, cat("'", name, "' increases; only (increase (total-cost) ...) is supported"));
  if (!within.variables.empty() || !within.when.empty())
    throw ParseError(at.where, "a cost within forall or when is not supported; expected one that always counts");
  addCost(at.list[2], rule);
}

void PddlConditions::addCost(const PddlExpression& at, LogicRule& rule) {
  if (at.head() == "+") {
    for (std::size_t i = 1; i < at.list.size(); ++i) addCost(at.list[i], rule);
  } else if (isOneOf(at.head(), {"*", "-", "/"})) {
    throw ParseError(at.where,
                     cat("'", at.head(), "' in a cost is not supported; expected a number, a function or a sum"));
  } else if (at.isList() ||
             !(std::isdigit(static_cast<unsigned char>(at.word[0])) || at.word[0] == '-' || at.word[0] == '.')) {
    rule.cost_functions.push_back(names_.literalOf(at, rule.variables, true));
  } else {
    const double value = numberOf(at);
    if (value < 0) throw ParseError(at.where, cat("expected a cost of at least 0, got ", at.word));
    rule.cost += value;
  }
}

double PddlConditions::numberOf(const PddlExpression& at) {
  const std::string& word = pddlWord(at, "a number");
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size()) refusePddl(at, "a number");
  return value;
}

}  // namespace kinegraph::inline logic_internal
