#pragma once

#include <vector>

#include "kinegraph/gfile/parser.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

/// Adds a warning for each attribute and element of a `<robot>` that URDF does not know, if its name resembles a known
/// one that is missing there: `<origin xzy="...">`. Others are extensions of programs, except for unread macros.
void askAboutSpelling(const XmlElement& robot, std::vector<Diagnostic>& found);

}  // namespace kinegraph::inline parsers_internal
