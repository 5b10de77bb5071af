#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph {

/// A kind of file, other than `.g`, that describes a scene. It is read as if it were a `.g` file with the same frames,
/// so that Include, Prefix and Edit work with it, and mistakes in values are reported at their places in the file.
/// Readers know texts and values, not scenes: they lie below the scene, which asks for them by the name of a file.
struct SceneFormat {
  const char* extension;  ///< with the dot, lower case: ".urdf"

  /// The frames of a text, and what is to be said about it. `file` names it in messages; files that it names are
  /// relative to `folder`.
  ParseResult (*read)(std::string_view text, const std::string& file, const std::string& folder);
};

/// All of them.
const std::vector<SceneFormat>& sceneFormats();

/// The format of a file of that name, or null for the .g language.
const SceneFormat* sceneFormatOf(const std::string& file);

}  // namespace kinegraph
