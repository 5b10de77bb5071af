#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Adds the frames of a scene file as Config::addFile does. A frame whose parent is unknown gets no parent and a warning
/// instead of an error, as in files of the reference that were written for a place below an existing frame.
std::optional<Frame> addFileWithOrphans(Config& config, const std::string& path, const std::string& prefix,
                                        std::vector<std::string>& warnings);

}  // namespace kinegraph
