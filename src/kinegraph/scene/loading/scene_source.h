#pragma once

#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"
#include "kinegraph/parsers/srdf_reader.h"
#include "kinegraph/scene/tree/diagnostics.h"

namespace kinegraph {

/// A frame as it stands in a scene file.
struct SourceFrame {
  Node node;
  std::string folder;  ///< that its own file names are relative to
  std::string prefix;  ///< that was put before its name; parents may be written without it
};

/// The frames of a scene file and of all that it includes, in order, after its special keys (Include, Prefix, Edit,
/// Delete, ...) have been carried out.
struct SceneSource {
  std::vector<SourceFrame> frames;
  std::vector<Node> joint_states;  ///< `q: [...]`
  std::vector<RobotSemantics> semantics;
};

/// Reads what it can; mistakes go to `diagnostics`. Throws FileError if `path` itself cannot be read.
SceneSource readSource(const std::string& path, SceneDiagnostics& diagnostics);
SceneSource readSource(std::string_view text, const std::string& name, const std::string& folder,
                       SceneDiagnostics& diagnostics);

/// The scene file and all files that it includes, as paths, mistakes in them or not, and also those that do not exist.
std::vector<std::string> sourceFiles(const std::string& path);

}  // namespace kinegraph
