#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/pddl_expression.h"
#include "kinegraph/logic/pddl_names.h"

namespace kinegraph::inline logic_internal {

/// Reads conditions and effects of PDDL. Throws ParseError with file:line:column.
class PddlConditions {
 public:
  explicit PddlConditions(PddlNames& names) : names_(names) {}

  /// Reads a condition into negation normal form: and, or, not, imply, forall, exists, =.
  Formula read(const PddlExpression& at, const std::vector<std::string>& variables, bool negated = false);

  /// Splits a condition into literals and the rest.
  static void split(Formula formula, std::vector<Literal>& literals, std::vector<Formula>& rest);

  /// Reads the effects of an action into it: and, not, when, forall, increase.
  void readEffects(const PddlExpression& at, LogicRule& rule);

  /// Reads a number; throws ParseError for anything else.
  static double numberOf(const PddlExpression& at);

 private:
  /// Effects within (when ...) and (forall ...).
  struct Within {
    std::vector<std::string> all;               ///< variables of the action and of quantifiers
    std::vector<std::string> variables, types;  ///< of quantifiers
    std::vector<Formula> when;
  };
  void readEffect(const PddlExpression& at, LogicRule& rule, const Within& within);
  void readCost(const PddlExpression& at, LogicRule& rule, const Within& within);
  void addCost(const PddlExpression& at, LogicRule& rule);
  /// Appends the variables of a quantifier.
  void addVariables(const PddlExpression& list, std::vector<std::string>& all, std::vector<std::string>& variables,
                    std::vector<std::string>& types);

  PddlNames& names_;
};

/// Reads the names of variables and their types; throws ParseError for a name that occurs twice.
void readPddlVariables(const PddlExpression& list, std::size_t from, PddlNames& names,
                       std::vector<std::string>& variables, std::vector<std::string>& types);

}  // namespace kinegraph::inline logic_internal
