#include "kinegraph/logic/domain.h"

namespace kinegraph {

std::string Literal::str() const {
  const bool valued = hasValue(predicate) && !arguments.empty();
  std::string text = "(" + (valued ? predicate.substr(0, predicate.size() - 1) : predicate);
  for (std::size_t i = 0; i + (valued ? 1 : 0) < arguments.size(); ++i) text += " " + arguments[i];
  text += ")";
  if (valued) text += "=" + arguments.back();
  return text + (negated ? "!" : "");
}

std::string Formula::str() const {
  if (kind == Kind::literal) {
    Literal fact = literal;
    fact.negated = false;
    return literal.negated ? "(not " + fact.str() + ")" : fact.str();
  }
  std::string text;
  if (kind == Kind::all || kind == Kind::any) {
    text = kind == Kind::all ? "(and" : "(or";
  } else {
    text = kind == Kind::forall ? "(forall (" : "(exists (";
    for (std::size_t i = 0; i < variables.size(); ++i) {
      text += (i ? " " : "") + variables[i];
      if (!types[i].empty()) text += " - " + types[i];
    }
    text += ")";
  }
  for (const Formula& part : parts) text += " " + part.str();
  return text + ")";
}

std::string str(const std::vector<Literal>& literals) {
  std::string text;
  for (const Literal& literal : literals) text += (text.empty() ? "" : " ") + literal.str();
  return text;
}

}  // namespace kinegraph
