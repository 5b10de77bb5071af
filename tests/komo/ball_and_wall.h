#pragma once

#include <string>

#include "kinegraph/common/text.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A ball that moves, and a wall that does not; both with the attributes that are given, in the words of .g files.
inline Config ballAndWall(const std::string& ball, const std::string& wall) {
  Config scene;
  scene.addText(cat("base: {} ball (base): { shape: sphere, contact: 1, ", ball,
                    " } wall (base): { shape: box, contact: 1, ", wall, " }"));
  return scene;
}

}  // namespace kinegraph
