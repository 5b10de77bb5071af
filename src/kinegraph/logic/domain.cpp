#include "kinegraph/logic/domain.h"

namespace kinegraph {

std::string Literal::str() const {
  std::string text = "(" + predicate;
  for (const std::string& argument : arguments) text += " " + argument;
  return text + (negated ? ")!" : ")");
}

std::string str(const std::vector<Literal>& literals) {
  std::string text;
  for (const Literal& literal : literals) text += (text.empty() ? "" : " ") + literal.str();
  return text;
}

}  // namespace kinegraph
