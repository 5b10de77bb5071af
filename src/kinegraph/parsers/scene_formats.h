#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/parser.h"

namespace kinegraph::inline parsers_internal {

/// A scene file format other than `.g`. It is read as if it were a `.g` file with the same frames, so Include, Prefix
/// and Edit work with it, and errors are reported at their positions in the file. Readers depend on texts and values
/// only, not on scenes: they lie below the scene, which selects them by file name.
struct SceneFormat {
  const char* extension;  ///< with the dot, lower case: ".urdf"

  /// Reads the frames of a text, with diagnostics. `file` names it in messages; file names inside it are relative to
  /// `folder`.
  ParseResult (*read)(std::string_view text, const std::string& file, const std::string& folder);
};

/// All supported formats.
const std::vector<SceneFormat>& sceneFormats();

/// The format of a file name, or null for the .g language.
const SceneFormat* sceneFormatOf(const std::string& file);

}  // namespace kinegraph::inline parsers_internal
