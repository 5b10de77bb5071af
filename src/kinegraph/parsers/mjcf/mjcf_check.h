#pragma once

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/xml/findings.h"

namespace kinegraph::inline parsers_internal {

/// Reports unknown sections as errors, and lists the ignored elements in one warning.
void checkMjcfSections(const MjcfDocument& document, Findings& findings);

/// Reports elements that a body cannot contain as errors, and ignored ones as warnings.
void checkMjcfBody(const XmlElement& body, Findings& findings);

/// Reports misspelled attributes as errors.
void checkMjcfAttributes(const XmlElement& element, Findings& findings);

}  // namespace kinegraph::inline parsers_internal
