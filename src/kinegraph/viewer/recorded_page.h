#pragma once

#include <string>
#include <vector>

#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

/// The client's page with the messages inside: shows them without a program, from a file.
std::string recordedPage(const std::vector<Outgoing>& messages);

}  // namespace kinegraph
