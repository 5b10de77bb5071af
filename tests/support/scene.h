#pragma once

#include <string>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Returns the scene of the text of a .g file.
inline Config scene(const std::string& text) {
  Config config;
  config.addText(text);
  return config;
}

}  // namespace kinegraph
