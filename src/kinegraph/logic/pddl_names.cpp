#include "kinegraph/logic/pddl_names.h"

#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/known_words.h"

namespace kinegraph::inline logic_internal {

namespace {

constexpr std::string_view kObject = "object";  ///< the type of everything

template <typename Map>
std::vector<std::string> keysOf(const Map& map) {
  std::vector<std::string> keys;
  for (const auto& entry : map) keys.push_back(entry.first);
  return keys;
}

void addUnique(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

}  // namespace

PddlNames::PddlNames(LogicDomain& domain) : domain_(domain) {
  const auto know = [&](const std::string& word) {
    exact_.insert(word);
    spelling_.try_emplace(lowerCase(word), word);
  };
  const auto see = [&](const Literal& literal) {
    know(literal.predicate);
    for (const std::string& word : literal.arguments) know(word);
    predicates_[literal.predicate].insert(literal.arguments.size());
  };
  for (const std::string& symbol : domain.symbols) know(symbol);
  for (const Signature& predicate : domain.predicates) addSignature(predicate, false);
  for (const Signature& function : domain.functions) addSignature(function, true);
  for (const auto& [type, above] : domain.types) {
    predicates_[type] = {1};
    if (type.starts_with(kTypePrefix)) predicate_names_.insert(type.substr(kTypePrefix.size()));
  }
  for (const LogicRule& rule : domain.rules) {
    for (const Literal& literal : rule.pre) see(literal);
    for (const Literal& literal : rule.eff) see(literal);
    for (const ConditionalEffect& effect : rule.conditional) {
      for (const Literal& literal : effect.eff) see(literal);
    }
  }
  for (const Literal& fact : domain.start) {
    see(fact);
    constants_.insert(fact.arguments.begin(), fact.arguments.end());
  }
  constants_.insert(domain.constants.begin(), domain.constants.end());
}

std::string PddlNames::spell(const std::string& word) {
  if (exact_.contains(word)) return word;
  return spelling_.try_emplace(lowerCase(word), word).first->second;
}

std::string PddlNames::internalType(const std::string& word) {
  const std::string name = spell(word);
  return predicate_names_.contains(name) ? cat(kTypePrefix, name) : name;
}

bool PddlNames::isType(const std::string& type) const {
  return std::ranges::any_of(domain_.types, [&](const auto& entry) { return entry.first == type; });
}

void PddlNames::addType(const std::string& type, const std::string& above) {
  const std::pair<std::string, std::string> entry = {type, above};
  if (std::ranges::find(domain_.types, entry) != domain_.types.end()) return;
  if (!isType(type)) {
    domain_.symbols.push_back(type);
    predicates_[type] = {1};
  } else if (above.empty()) {
    return;
  }
  std::erase(domain_.types, std::pair<std::string, std::string>(type, ""));
  domain_.types.push_back(entry);
}

void PddlNames::addTypes(const std::vector<PddlTyped>& types) {
  std::vector<std::string> above_all;
  for (const PddlTyped& type : types) {
    if (lowerCase(type.name) == kObject) continue;
    const std::string name = internalType(type.name);
    addType(name, "");
    for (const std::string& word : type.types) {
      if (lowerCase(word) == kObject) continue;
      const std::string above = internalType(word);
      if (above != name) addType(name, above);
      above_all.push_back(above);
    }
  }
  // A word that occurs only behind a '-' is a type, too.
  for (const std::string& above : above_all) addType(above, "");
}

void PddlNames::requireType(const std::string& type, const SourcePosition& where) const {
  if (isType(type)) return;
  throw ParseError(where, cat("unknown type '", type, "'", knownWords(type, keysOf(domain_.types))));
}

std::string PddlNames::typeOf(const PddlTyped& thing) {
  std::vector<std::string> types;
  for (const std::string& word : thing.types) {
    if (lowerCase(word) == kObject) return "";
    addUnique(types, internalType(word));
    requireType(types.back(), thing.where);
  }
  if (types.empty()) return "";
  if (types.size() == 1) return types.front();
  std::vector<std::string> plain;
  for (const std::string& type : types)
    plain.push_back(type.starts_with(kTypePrefix) ? type.substr(kTypePrefix.size()) : type);
  const std::string all = internalType(join(plain, "-or-"));
  addType(all, "");
  for (const std::string& type : types) addType(type, all);
  return all;
}

std::vector<Literal> PddlNames::typeFacts(const PddlTyped& constant) {
  std::vector<std::string> types;
  for (const std::string& word : constant.types) {
    if (lowerCase(word) != kObject) addUnique(types, internalType(word));
  }
  std::vector<Literal> facts;
  for (const std::string& type : types) {
    requireType(type, constant.where);
    facts.push_back({type, {spell(constant.name)}, false, constant.where});
  }
  addSupertypes(facts);
  return facts;
}

void PddlNames::addSupertypes(std::vector<Literal>& facts) const {
  std::set<std::pair<std::string, std::string>> known;  // type, constant
  std::multimap<std::string, std::string> above(domain_.types.begin(), domain_.types.end());
  for (const Literal& fact : facts) {
    if (fact.arguments.size() == 1 && above.contains(fact.predicate))
      known.emplace(fact.predicate, fact.arguments.front());
  }
  for (std::size_t i = 0; i < facts.size(); ++i) {  // grows
    if (facts[i].arguments.size() != 1) continue;
    const auto [begin, end] = above.equal_range(facts[i].predicate);
    for (auto type = begin; type != end; ++type) {
      if (type->second.empty() || !known.emplace(type->second, facts[i].arguments.front()).second) continue;
      Literal fact = facts[i];
      fact.predicate = type->second;
      facts.push_back(std::move(fact));
    }
  }
}

void PddlNames::addSignature(const Signature& signature, bool is_function) {
  (is_function ? functions_ : predicates_)[signature.name].insert(signature.variables.size());
}

std::string PddlNames::argumentOf(const PddlExpression& at, const std::vector<std::string>& variables) {
  const std::string word = spell(pddlWord(at, "an argument"));
  if (std::ranges::find(variables, word) != variables.end() || constants_.contains(word)) return word;
  std::vector<std::string> known = variables;
  known.insert(known.end(), constants_.begin(), constants_.end());
  throw ParseError(at.where,
                   cat("unknown ", word[0] == '?' ? "variable" : "object", " '", word, "'", knownWords(word, known)));
}

Literal PddlNames::literalOf(const PddlExpression& at, const std::vector<std::string>& variables, bool is_function) {
  if (!is_function && (!at.isList() || at.list.empty())) refusePddl(at, "a literal such as (on table cup)");
  if (is_function && !at.isList()) return {spell(at.word), {}, false, at.where};
  if (at.list.empty()) refusePddl(at, "a function such as (length ?a ?b)");
  Literal literal{spell(pddlWord(at.list[0], "a predicate")), {}, false, at.where};
  for (std::size_t i = 1; i < at.list.size(); ++i) literal.arguments.push_back(argumentOf(at.list[i], variables));
  requireArity(literal, is_function);
  return literal;
}

void PddlNames::requireArity(const Literal& literal, bool is_function) const {
  const std::string& name = literal.predicate;
  const std::size_t count = literal.arguments.size();
  if (name == kEqual) {
    if (count != 2) throw ParseError(literal.where, cat("'=' has 2 arguments, got ", count));
    return;
  }
  const auto& known = is_function ? functions_ : predicates_;
  const auto found = known.find(name);
  if (found == known.end()) {
    // A symbol of a .fol file that no rule has can have any arguments.
    const bool is_symbol = std::ranges::find(domain_.symbols, name) != domain_.symbols.end();
    if (!is_function && is_symbol && domain_.predicates.empty() && domain_.types.empty()) return;
    throw ParseError(literal.where, cat("unknown ", is_function ? "function" : "predicate", " '", name, "'",
                                        knownWords(name, keysOf(known))));
  }
  if (!found->second.contains(count)) {
    throw ParseError(literal.where, cat(is_function ? "function" : "predicate", " '", name, "' has ",
                                        *found->second.begin(), " arguments, got ", count));
  }
}

}  // namespace kinegraph::inline logic_internal
