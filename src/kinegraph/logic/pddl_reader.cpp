#include <algorithm>
#include <map>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/logic_scanner.h"
#include "kinegraph/logic/pddl.h"

namespace kinegraph {

namespace {

using Token = LogicScanner::Token;

constexpr int kDeepest = 50;  ///< lists in lists

/// A word, or a list of words and lists.
struct Expression {
  std::string word;  ///< empty: a list
  std::vector<Expression> list;
  SourcePosition where;

  bool isList() const { return word.empty(); }
  /// The first word of a list, empty if there is none.
  const std::string& head() const {
    static const std::string none;
    return list.empty() ? none : list.front().word;
  }
};

Expression readExpression(LogicScanner& scan, int depth = 0) {
  if (depth > kDeepest) throw ParseError(scan.peek().where, cat("lists are nested more than ", kDeepest, " deep"));
  Expression made;
  made.where = scan.peek().where;
  if (scan.takeIf('(')) {
    while (!scan.takeIf(')')) made.list.push_back(readExpression(scan, depth + 1));
    return made;
  }
  if (scan.takeIf('=')) {
    made.word = "=";
  } else if (scan.takeIf(':')) {
    made.word = ":" + scan.expectWord("a keyword such as :action").text;
  } else if (scan.peek().kind == Token::Kind::number) {
    made.word = scan.take().text;
  } else {
    made.word = scan.expectWord("a word, '(' or ')'").text;
  }
  return made;
}

Expression readDefinition(std::string_view text, const std::string& file) {
  LogicScanner scan(text, file, ';');
  if (!scan.peek().is('(')) scan.fail("(define ...)");
  Expression all = readExpression(scan);
  if (scan.peek().kind != Token::Kind::end) scan.fail("the end");
  if (all.head() != "define") throw ParseError(all.where, "expected (define ...)");
  return all;
}

[[noreturn]] void refuse(const Expression& at, const std::string& expected) {
  throw ParseError(at.where,
                   cat("expected ", expected, at.isList() ? ", found a list" : cat(", found '", at.word, "'")));
}

const std::string& wordOf(const Expression& at, const char* expected) {
  if (at.isList()) refuse(at, expected);
  return at.word;
}

struct Typed {
  std::string name, type;  ///< type may be empty
  SourcePosition where;
};

/// `a b - t c`: names with the type that follows them.
std::vector<Typed> typedNames(const Expression& list, std::size_t from, const char* what) {
  std::vector<Typed> names;
  std::size_t untyped = 0;
  for (std::size_t i = from; i < list.list.size(); ++i) {
    const std::string& word = wordOf(list.list[i], what);
    if (word != "-") {
      names.push_back({word, "", list.list[i].where});
      continue;
    }
    if (++i >= list.list.size()) throw ParseError(list.where, "a type is missing behind '-'");
    if (list.list[i].isList()) throw ParseError(list.list[i].where, "(either ...) is not supported; expected a type");
    for (; untyped < names.size(); ++untyped) names[untyped].type = list.list[i].word;
  }
  return names;
}

class DomainReader {
 public:
  LogicDomain read(const Expression& all) {
    domain_.distinct_variables = false;
    for (std::size_t i = 1; i < all.list.size(); ++i) readPart(all.list[i]);
    return std::move(domain_);
  }

 private:
  void readPart(const Expression& part) {
    const std::string& head = part.head();
    if (head == "domain") {
      domain_.name = part.list.size() == 2 ? wordOf(part.list[1], "the domain's name") : "domain";
    } else if (head == ":requirements") {
      requireLanguage(part);
    } else if (head == ":types") {
      for (const Typed& type : typedNames(part, 1, "a type")) domain_.types.emplace_back(type.name, type.type);
      addSupertypes();
      for (const auto& [type, above] : domain_.types) {
        domain_.symbols.push_back(type);
        arity_[type] = 1;
      }
    } else if (head == ":constants") {
      for (const Typed& constant : typedNames(part, 1, "a constant")) {
        domain_.symbols.push_back(constant.name);
        constants_.push_back(constant.name);
        addType(constant, domain_.start);
      }
    } else if (head == ":predicates") {
      for (std::size_t i = 1; i < part.list.size(); ++i) readPredicate(part.list[i]);
    } else if (head == ":action") {
      readAction(part);
    } else {
      throw ParseError(
          part.where,
          cat("unknown part '", head,
              "' of a domain; expected one of domain, :requirements, :types, :constants, :predicates, :action",
              similarHint(head, {":requirements", ":types", ":constants", ":predicates", ":action"})));
    }
  }

  /// A word that occurs only behind a '-' is a type, too.
  void addSupertypes() {
    const auto types = domain_.types;
    for (const auto& [type, above] : types) {
      const bool known =
          std::ranges::find(domain_.types, above, &std::pair<std::string, std::string>::first) != domain_.types.end();
      if (!known && !above.empty() && above != "object") domain_.types.emplace_back(above, "");
    }
  }

  static void requireLanguage(const Expression& part) {
    static const std::vector<std::string> known = {":strips", ":typing", ":negative-preconditions", ":equality"};
    for (std::size_t i = 1; i < part.list.size(); ++i) {
      const std::string& word = wordOf(part.list[i], "a requirement");
      if (std::ranges::find(known, word) == known.end())
        throw ParseError(part.list[i].where,
                         cat("requirement '", word, "' is not supported; these are: ", join(known)));
    }
  }

  void readPredicate(const Expression& predicate) {
    if (!predicate.isList() || predicate.list.empty()) refuse(predicate, "a predicate such as (on ?place ?thing)");
    const std::string& name = wordOf(predicate.list[0], "the predicate's name");
    arity_[name] = typedNames(predicate, 1, "an argument").size();
    domain_.symbols.push_back(name);
  }

  /// Literals that an object has a type and its supertypes.
  void addType(const Typed& thing, std::vector<Literal>& facts) const {
    std::string type = thing.type;
    for (std::size_t above = 0; !type.empty() && type != "object" && above <= domain_.types.size(); ++above) {
      facts.push_back({type, {thing.name}, false, thing.where});
      const auto found = std::ranges::find(domain_.types, type, &std::pair<std::string, std::string>::first);
      if (found == domain_.types.end()) {
        std::vector<std::string> names;
        for (const auto& [name, supertype] : domain_.types) names.push_back(name);
        throw ParseError(thing.where, cat("unknown type '", type, "'", similarHint(type, names)));
      }
      type = found->second;
    }
  }

  void readAction(const Expression& part) {
    if (part.list.size() < 2) throw ParseError(part.where, "expected the action's name");
    LogicRule rule;
    rule.where = part.where;
    rule.name = wordOf(part.list[1], "the action's name");
    const Expression *pre = nullptr, *eff = nullptr;
    for (std::size_t i = 2; i + 1 < part.list.size(); i += 2) {
      const std::string& key = wordOf(part.list[i], ":parameters, :precondition or :effect");
      const Expression& value = part.list[i + 1];
      if (key == ":parameters") {
        readParameters(rule, value);
      } else if (key == ":precondition") {
        pre = &value;
      } else if (key == ":effect") {
        eff = &value;
      } else {
        refuse(part.list[i], ":parameters, :precondition or :effect");
      }
    }
    if (pre) readConjunction(*pre, rule, rule.pre, true);
    if (!eff) throw ParseError(part.where, cat("action '", rule.name, "' has no :effect"));
    readConjunction(*eff, rule, rule.eff, false);
    // Effects of PDDL are simultaneous: an added fact is not deleted.
    std::ranges::stable_sort(rule.eff, {}, [](const Literal& effect) { return !effect.negated; });
    requireBound(rule);
    domain_.rules.push_back(std::move(rule));
  }

  void readParameters(LogicRule& rule, const Expression& list) {
    bool typed = false;
    for (const Typed& parameter : typedNames(list, 0, "a parameter such as ?x")) {
      if (parameter.name[0] != '?')
        throw ParseError(parameter.where, cat("parameter '", parameter.name, "' does not begin with '?'"));
      rule.variables.push_back(parameter.name);
      rule.types.push_back(parameter.type == "object" ? "" : parameter.type);
      typed |= !rule.types.back().empty();
      std::vector<Literal> of_type;
      addType(parameter, of_type);
      if (!of_type.empty()) rule.pre.push_back(of_type.front());
    }
    if (!typed) rule.types.clear();
  }

  void readConjunction(const Expression& at, const LogicRule& rule, std::vector<Literal>& literals, bool is_pre) {
    if (!at.isList()) refuse(at, "a list such as (and (p ?x) (not (q ?x)))");
    if (at.list.empty()) return;
    if (at.head() == "and") {
      for (std::size_t i = 1; i < at.list.size(); ++i) readConjunction(at.list[i], rule, literals, is_pre);
      return;
    }
    const bool negated = at.head() == "not";
    if (negated && (at.list.size() != 2 || !at.list[1].isList())) refuse(at, "(not (p ?x))");
    literals.push_back(literalOf(negated ? at.list[1] : at, rule.variables));
    literals.back().negated = negated;
    if (!is_pre && literals.back().predicate == kEqual) throw ParseError(at.where, "'=' cannot be an effect");
  }

 public:
  /// `(on table cup)`; arguments are among `names`, or constants.
  Literal literalOf(const Expression& at, const std::vector<std::string>& names) const {
    if (!at.isList() || at.list.empty()) refuse(at, "a literal such as (on table cup)");
    Literal literal{wordOf(at.list[0], "a predicate"), {}, false, at.where};
    static const std::vector<std::string> beyond = {"or",    "forall",   "exists",   "when",
                                                    "imply", "increase", "decrease", "assign"};
    if (std::ranges::find(beyond, literal.predicate) != beyond.end())
      throw ParseError(at.where, cat("'", literal.predicate, "' is not supported; expected and, not, or a predicate"));
    for (std::size_t i = 1; i < at.list.size(); ++i) {
      const std::string& word = wordOf(at.list[i], "an argument");
      if (std::ranges::find(names, word) == names.end() && std::ranges::find(constants_, word) == constants_.end()) {
        std::vector<std::string> known = names;
        known.insert(known.end(), constants_.begin(), constants_.end());
        throw ParseError(at.list[i].where, cat("unknown ", word[0] == '?' ? "variable" : "object", " '", word, "'",
                                               similarHint(word, known)));
      }
      literal.arguments.push_back(word);
    }
    requireArity(literal);
    return literal;
  }

  void takeFrom(const LogicDomain& domain) {
    domain_ = domain;
    const auto see = [&](const Literal& literal) { arity_[literal.predicate] = literal.arguments.size(); };
    for (const LogicRule& rule : domain.rules) {
      for (const Literal& literal : rule.pre) see(literal);
      for (const Literal& literal : rule.eff) see(literal);
    }
    for (const auto& [type, above] : domain.types) arity_[type] = 1;
    any_predicate_ = true;
  }

  void readObjects(const Expression& part, LogicProblem& problem) {
    for (const Typed& object : typedNames(part, 1, "an object")) {
      problem.constants.push_back(object.name);
      constants_.push_back(object.name);
      addType(object, problem.start);
    }
  }

  void addConstants(const std::vector<std::string>& names) {
    constants_.insert(constants_.end(), names.begin(), names.end());
  }

 private:
  void requireArity(const Literal& literal) const {
    const auto known = arity_.find(literal.predicate);
    const std::size_t count = literal.arguments.size();
    if (literal.predicate == kEqual) {
      if (count != 2) throw ParseError(literal.where, cat("'=' has 2 arguments, got ", count));
    } else if (known == arity_.end()) {
      std::vector<std::string> names;
      for (const auto& [name, arguments] : arity_) names.push_back(name);
      const bool declared = std::ranges::find(domain_.symbols, literal.predicate) != domain_.symbols.end();
      if (any_predicate_ && declared) return;  // no rule uses it
      throw ParseError(literal.where,
                       cat("unknown predicate '", literal.predicate, "'", similarHint(literal.predicate, names)));
    } else if (known->second != count) {
      throw ParseError(literal.where,
                       cat("predicate '", literal.predicate, "' has ", known->second, " arguments, got ", count));
    }
  }

  /// A parameter that no positive literal binds can be any object: untyped parameters of PDDL are objects.
  void requireBound(LogicRule& rule) {
    for (const std::string& variable : rule.variables) {
      const bool bound = std::ranges::any_of(rule.pre, [&](const Literal& literal) {
        return !literal.negated && literal.predicate != kEqual &&
               std::ranges::find(literal.arguments, variable) != literal.arguments.end();
      });
      if (!bound) {
        throw ParseError(rule.where, cat("action '", rule.name, "': nothing that has to hold has the parameter '",
                                         variable, "'; give it a type or a precondition"));
      }
    }
  }

  LogicDomain domain_;
  std::map<std::string, std::size_t> arity_;
  std::vector<std::string> constants_;
  bool any_predicate_ = false;
};

}  // namespace

LogicDomain readPddlDomain(std::string_view text, const std::string& file) {
  return DomainReader().read(readDefinition(text, file));
}

LogicProblem readPddlProblem(std::string_view text, const LogicDomain& domain, const std::string& file) {
  const Expression all = readDefinition(text, file);
  LogicProblem problem;
  problem.domain = domain;
  problem.start = domain.start;
  DomainReader reader;
  reader.takeFrom(domain);
  for (const Literal& fact : domain.start) reader.addConstants(fact.arguments);
  for (std::size_t i = 1; i < all.list.size(); ++i) {
    const Expression& part = all.list[i];
    const std::string& head = part.head();
    if (head == "problem") {
      if (part.list.size() == 2) problem.name = wordOf(part.list[1], "the problem's name");
    } else if (head == ":domain") {
      if (part.list.size() != 2 || part.list[1].word != domain.name)
        throw ParseError(part.where, cat("the problem is of another domain than '", domain.name, "'"));
    } else if (head == ":objects") {
      reader.readObjects(part, problem);
    } else if (head == ":init") {
      for (std::size_t k = 1; k < part.list.size(); ++k) problem.start.push_back(reader.literalOf(part.list[k], {}));
    } else if (head == ":goal") {
      if (part.list.size() != 2) throw ParseError(part.where, "expected (:goal (and ...))");
      const Expression& goal = part.list[1];
      const std::size_t from = goal.head() == "and" ? 1 : 0;
      const std::vector<Expression> single = {goal};
      const std::vector<Expression>& list = from == 1 ? goal.list : single;
      for (std::size_t k = from; k < list.size(); ++k) {
        const bool negated = list[k].head() == "not" && list[k].list.size() == 2;
        problem.goal.push_back(reader.literalOf(negated ? list[k].list[1] : list[k], {}));
        problem.goal.back().negated = negated;
      }
    } else {
      throw ParseError(part.where, cat("unknown part '", head,
                                       "' of a problem; expected one of problem, :domain, :objects, :init, :goal",
                                       similarHint(head, {":domain", ":objects", ":init", ":goal"})));
    }
  }
  return problem;
}

}  // namespace kinegraph
