#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

/// Returns the client's page with embedded messages, which it shows from a file without a program.
std::string recordedPage(const std::vector<Outgoing>& messages);

/// Returns the page with an embedded configuration and, optionally, a motion of it and the content of a program. Needs
/// no server.
std::string recordedScene(const Config& config, const ShownMotion* motion = nullptr,
                          const std::string& title = "Kinegraph", std::shared_ptr<PageContent> content = nullptr);

}  // namespace kinegraph
