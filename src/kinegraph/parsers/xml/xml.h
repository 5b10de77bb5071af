#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"

namespace kinegraph::inline parsers_internal {

struct XmlAttribute {
  std::string name, value;
  SourcePosition where;  ///< of the name
};

/// An element of an XML text with its source positions. Text between elements, comments and processing instructions are
/// skipped.
struct XmlElement {
  std::string name;
  std::vector<XmlAttribute> attributes;
  std::vector<XmlElement> children;
  SourcePosition where;  ///< of its '<'

  const XmlAttribute* attribute(std::string_view name) const;       ///< null if there is none
  const XmlElement* child(std::string_view name) const;             ///< the first of that name, or null
  std::vector<const XmlElement*> all(std::string_view name) const;  ///< all children of that name
};

/// Parses an XML text and returns its root element. Throws ParseError with a message without excerpt.
XmlElement parseXml(std::string_view text, const std::string& file);

/// The name of the root element of a text that looks like XML, or "".
std::string xmlRootName(std::string_view text);

/// Parses blank-separated numbers; nullopt if the text contains anything else or a non-finite number.
std::optional<std::vector<double>> numbersIn(std::string_view text);

/// The same for numbers with commas between them; nullopt if there is no comma.
std::optional<std::vector<double>> numbersBetweenCommas(std::string_view text);

/// As numbersIn, but the words inf and infinity are numbers, with a sign and in any capitals.
std::optional<std::vector<double>> limitsIn(std::string_view text);

/// `text` with XML's reserved characters replaced by entities.
std::string xmlEscaped(std::string_view text);

}  // namespace kinegraph::inline parsers_internal
