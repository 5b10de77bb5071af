#pragma once

#include <string>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/frame.h"

namespace kinegraph {

/// Sets attributes of a frame with the effect that they have in a .g file: `contact`, `mass`, `color`, `q` and `limits`
/// change the frame; words that the library reads when they are needed (`friction`, `logical`, `ctrl_limits`, ...), and
/// unknown words, are stored. Throws ValueError, before anything changes, for words that only a file can interpret
/// (`joint`, `shape`, `pose`, ...); the message names the method instead.
void setAttributes(Frame& frame, const Graph& attributes);

/// The same for attributes as a .g file writes them:
///
///     setAttributes(drawer, "logical: { is_drawer }, friction: .5");
///
/// Throws ParseError.
void setAttributes(Frame& frame, const std::string& text);

}  // namespace kinegraph
