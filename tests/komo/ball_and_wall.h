#pragma once

#include <string>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A moving ball and a fixed wall, both with additional attributes in the syntax of .g files.
inline Config ballAndWall(const std::string& ball, const std::string& wall) {
  Config scene;
  scene.addText(cat("base: {} ball (base): { shape: sphere, contact: 1, ", ball,
                    " } wall (base): { shape: box, contact: 1, ", wall, " }"));
  return scene;
}

}  // namespace kinegraph
