#pragma once

#include "kinegraph/parsers/findings.h"
#include "kinegraph/parsers/mjcf_document.h"

namespace kinegraph {

/// Complains of sections that MJCF does not have, and tells in one warning what is there that is not read.
void checkMjcfSections(const MjcfDocument& document, Findings& findings);

/// Complains of elements that a body cannot hold, and warns of those that are not read.
void checkMjcfBody(const XmlElement& body, Findings& findings);

/// Complains of attributes that look misspelt.
void checkMjcfAttributes(const XmlElement& element, Findings& findings);

}  // namespace kinegraph
