#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/loading/file_options.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Reads a scene file into `scene`, which must be empty. Included files are relative to the including file; $NAME is
/// expanded from the environment. Throws FileError or ParseError (with file:line:column, the source line and a
/// caret);
/// `scene` must then be discarded. Appends warnings ("file:line:column: ...") to `warnings`.
void readSceneFile(const std::string& path, SceneTree& scene, std::vector<std::string>& warnings,
                   const FileOptions& options = {});

/// Reads scene text. `name` stands for the file in messages; included files are relative to `folder`.
void readSceneText(std::string_view text, const std::string& name, const std::string& folder, SceneTree& scene,
                   std::vector<std::string>& warnings, bool strict = false);

/// Applies an SRDF file to a scene that already contains the robot; `prefix` is put before the file's names. Throws
/// FileError or ParseError; the scene is then unchanged.
void readSemanticsFile(const std::string& path, const std::string& prefix, SceneTree& scene,
                       std::vector<std::string>& warnings, const FileOptions& options = {});

/// Errors and warnings of a scene file, collected in one pass. checkSceneFile throws FileError for an unreadable
/// file.
struct SceneCheck {
  std::vector<std::string> messages;  ///< "file:line:column: error: ..." or "... warning: ...", the line and a caret
  int errors = 0, warnings = 0, frames = 0;
};
SceneCheck checkSceneFile(const std::string& path);

/// Interprets attributes (pose, joint, shape, mass ...) of one existing frame, as for Config::addFrame. File names are
/// relative to `folder`. May add a frame "<name>_origin" or "|<name>" (pre, post). After a ParseError the frame itself
/// must be discarded; nothing else has changed.
void readAttributes(std::string_view text, const std::string& folder, FrameData& frame,
                    std::vector<std::string>& warnings);

/// Parses a pose in the turtle language: "t(1 0 0) d(90 0 0 1) ...", or 3, 4 or 7 bare numbers.
Pose parsePose(std::string_view text, const SourcePosition& where = {});

}  // namespace kinegraph::inline scene_internal
