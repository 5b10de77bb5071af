#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Reads a scene file (`.g`) into `scene`, which must be empty. Files that it includes are relative to the file that
/// names them; $NAME is expanded from the environment. Throws FileError or ParseError (with file:line:column, the
/// source line and a caret); `scene` is then to be thrown away. What is odd but not wrong is appended to `warnings`
/// ("file:line:column: ...").
void readSceneFile(const std::string& path, SceneTree& scene, std::vector<std::string>& warnings);

/// The same for text. `name` stands for the file in messages; included files are relative to `folder`.
void readSceneText(std::string_view text, const std::string& name, const std::string& folder, SceneTree& scene,
                   std::vector<std::string>& warnings);

/// Enters what an SRDF file says into a scene whose frames are there already, named with `prefix` in front. Throws
/// FileError or ParseError; the scene is then unchanged.
void readSemanticsFile(const std::string& path, const std::string& prefix, SceneTree& scene,
                       std::vector<std::string>& warnings);

/// What is wrong and what is odd about a scene file, all that can be found at once. Throws FileError if it cannot be
/// read.
struct SceneCheck {
  std::vector<std::string> messages;  ///< "file:line:column: error: ..." or "... warning: ...", the line and a caret
  int errors = 0, warnings = 0, frames = 0;
};
SceneCheck checkSceneFile(const std::string& path);

/// Interprets attributes (pose, joint, shape, mass ...) of one frame that is in a scene already, as for
/// Config::addFrame. `folder` is where its files are. The frame may get an extra frame "<name>_origin" or "|<name>"
/// (pre, post). If this throws ParseError, the frame itself is to be thrown away, but nothing else has changed.
void readAttributes(std::string_view text, const std::string& folder, FrameData& frame,
                    std::vector<std::string>& warnings);

/// A pose written in the turtle language: "t(1 0 0) d(90 0 0 1) ...", or 3, 4 or 7 bare numbers.
Pose parsePose(std::string_view text, const SourcePosition& where = {});

}  // namespace kinegraph
