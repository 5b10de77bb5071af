#pragma once

#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/parsers/urdf/srdf_reader.h"
#include "kinegraph/scene/loading/xacro.h"
#include "kinegraph/scene/tree/diagnostics.h"

namespace kinegraph::inline scene_internal {

/// One frame entry of a scene file.
struct SourceFrame {
  Node node;
  std::string folder;  ///< base folder of its relative file names
  std::string prefix;  ///< prefix of its name; parents may be written without it
};

/// The frames of a scene file and its includes, in order, after the special keys (Include, Prefix, Edit, Delete, ...)
/// have been applied.
struct SceneSource {
  std::vector<SourceFrame> frames;
  std::vector<Node> joint_states;  ///< `q: [...]`
  std::vector<RobotSemantics> semantics;
};

/// Reads as much as possible and adds errors to `diagnostics`. `arguments` are those of a .xacro file. Throws FileError
/// if `path` itself cannot be read.
SceneSource readSource(const std::string& path, SceneDiagnostics& diagnostics, const XacroArguments& arguments = {});
SceneSource readSource(std::string_view text, const std::string& name, const std::string& folder,
                       SceneDiagnostics& diagnostics);

/// Paths of the scene file and of all files it includes, with or without errors, existing or not.
std::vector<std::string> sourceFiles(const std::string& path);

}  // namespace kinegraph::inline scene_internal
