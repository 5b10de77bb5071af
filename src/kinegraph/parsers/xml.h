#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph {

struct XmlAttribute {
  std::string name, value;
  SourcePosition where;  ///< of the name
};

/// An element of an XML text, with the places where things stand. Text between elements, comments and processing
/// instructions are left out.
struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  SourcePosition where;  ///< of its '<'

  const XmlAttribute* attribute(std::string_view name) const;       ///< null if there is none
  const XmlElement* child(std::string_view name) const;             ///< the first of that name, or null
  std::vector<const XmlElement*> all(std::string_view name) const;  ///< all children of that name
};

/// Parses an XML text and returns its root element. Throws ParseError, whose message has no excerpt.
XmlElement parseXml(std::string_view text, const std::string& file);

/// The name of the root element of a text that looks like XML, or "".
std::string xmlRootName(std::string_view text);

/// The numbers in a text, separated by blanks; nothing if there is anything else in it, or a number that is not finite.
std::optional<std::vector<double>> numbersIn(std::string_view text);

/// `text` with the characters that XML reserves written as entities.
std::string xmlEscaped(std::string_view text);

}  // namespace kinegraph
