#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"
#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph {

/// The client's page with the messages inside: shows them without a program, from a file.
std::string recordedPage(const std::vector<Outgoing>& messages);

/// The page with a configuration inside, and a motion of it if there is one. Needs no server.
std::string recordedScene(const Config& config, const ShownMotion* motion = nullptr,
                          const std::string& title = "Kinegraph");

}  // namespace kinegraph
