#pragma once

#include "kinegraph/viewer/messages/look.h"

namespace kinegraph {

/// Draws a quad, where pages show it, on top of a picture with `width` columns, whose `rgb` are rows from top to
/// bottom. What is outside is cut off.
void drawQuad(std::vector<std::uint8_t>& rgb, int width, const Quad& quad);

}  // namespace kinegraph
