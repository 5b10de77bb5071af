#pragma once

#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline viewer_internal {

/// Draws a quad on a picture with `width` columns, at its place on pages. `rgb` has rows from top to bottom. Parts
/// outside are clipped.
void drawQuad(std::vector<std::uint8_t>& rgb, int width, const Quad& quad);

}  // namespace kinegraph::inline viewer_internal
