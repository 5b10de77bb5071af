#pragma once

#include <string>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::python {

/// Returns a page below a notebook's cell, with a text, that shows a scene or plays a motion of it without a running
/// program. Slices of long motions are left out, so that it has at most about 600 kB.
std::string notebookPage(const Config& config, const ShownMotion* motion, const std::string& title,
                         const std::string& text);

}  // namespace kinegraph::python
