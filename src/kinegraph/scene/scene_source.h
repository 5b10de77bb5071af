#pragma once

#include <map>
#include <string>
#include <vector>

#include "kinegraph/gfile/value.h"

namespace kinegraph {

/// A frame as it stands in a scene file, with the folder that its own file names are relative to.
struct SourceFrame {
  Node node;
  std::string folder;
};

/// The frames of a scene file and of all that it includes, in order, after its special keys (Include, Prefix, Edit,
/// Delete, ...) have been carried out.
struct SceneSource {
  std::vector<SourceFrame> frames;
  std::vector<Node> joint_states;            ///< `q: [...]`
  std::vector<std::string> files;            ///< asked for, in order, whether they exist or not
  std::map<std::string, std::string> texts;  ///< of every file read, for messages
  std::vector<std::string> warnings;
};

/// Throws FileError, ParseError.
SceneSource readSource(const std::string& path);
SceneSource readSource(std::string_view text, const std::string& name, const std::string& folder);

/// The scene file and all files that it includes, as paths: as many as are named before the first mistake, and also one that
/// does not exist.
std::vector<std::string> sourceFiles(const std::string& path);

/// An absolute path: `path` with $NAME expanded from the environment, relative to `folder`. A path package://NAME/rest is
/// looked up in the folders of KINEGRAPH_PACKAGE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; empty if it is in none.
std::string resolvePath(const std::string& path, const std::string& folder);

}  // namespace kinegraph
