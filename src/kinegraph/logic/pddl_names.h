#pragma once

#include <map>
#include <set>
#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/pddl_expression.h"

namespace kinegraph::inline logic_internal {

/// The names of a domain while PDDL is read: their spelling, the types, and the numbers of arguments.
///
/// PDDL has one case. A word keeps the spelling of its first occurrence.
class PddlNames {
 public:
  /// Begins with the names of a domain; types that are read are added to it.
  explicit PddlNames(LogicDomain& domain);

  /// Returns a word in the spelling of its first occurrence.
  std::string spell(const std::string& word);

  /// A name that is both a predicate and a type is two things. Predicates are told before types.
  void addPredicateName(const std::string& name) { predicate_names_.insert(spell(name)); }

  void addTypes(const std::vector<PddlTyped>& types);

  /// Returns the name of a type in the domain, "" for any object. `(either a b)` becomes a supertype `a-or-b`.
  std::string typeOf(const PddlTyped& thing);

  /// Returns the literals that a constant has its types.
  std::vector<Literal> typeFacts(const PddlTyped& constant);

  /// Adds the supertypes of all types in a list of facts, also those that conditions introduced, `a-or-b`.
  void addSupertypes(std::vector<Literal>& facts) const;

  void addSignature(const Signature& signature, bool is_function);
  void addConstant(const std::string& name) { constants_.insert(name); }

  /// Reads `(on table cup)`; arguments are among the variables, or constants. Checks their number.
  Literal literalOf(const PddlExpression& at, const std::vector<std::string>& variables, bool is_function = false);

 private:
  std::string internalType(const std::string& word);
  void addType(const std::string& type, const std::string& above);
  bool isType(const std::string& type) const;
  void requireType(const std::string& type, const SourcePosition& where) const;
  void requireArity(const Literal& literal, bool is_function) const;
  std::string argumentOf(const PddlExpression& at, const std::vector<std::string>& variables);

  LogicDomain& domain_;
  std::map<std::string, std::string> spelling_;  ///< by the word in small letters
  std::set<std::string> exact_;                  ///< words of the domain
  std::set<std::string> predicate_names_, constants_;
  std::map<std::string, std::set<std::size_t>> predicates_, functions_;  ///< numbers of arguments
};

}  // namespace kinegraph::inline logic_internal
