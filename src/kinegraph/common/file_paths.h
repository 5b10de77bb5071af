#pragma once

#include <string>

namespace kinegraph {

/// An absolute path: `path` with $NAME expanded from the environment, relative to `folder`; file:// in front is
/// dropped. A path package://NAME/rest (or model://) is looked up in `folder` and all folders above it, then in those
/// of KINEGRAPH_PACKAGE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; empty if it is in none. Where nothing is at a path
/// .../rai-robotModels/rest, it is rest in the folder RAI_PATH, if that is there.
std::string resolvePath(const std::string& path, const std::string& folder);

/// Why resolvePath found no place for a path in a package, and what helps.
std::string missingPackageMessage(const std::string& path);

/// "; similar names: ..." of the files beside a missing one, or that its folder does not exist.
std::string similarFilesHint(const std::string& path);

/// The extension of a file's name with the dot, in lower case: ".urdf".
std::string lowerExtension(const std::string& path);

}  // namespace kinegraph
