#pragma once

#include <string>

namespace kinegraph {

/// Resolves `path` relative to `folder` to an absolute path: expands $NAME from the environment and drops file://.
/// Searches package://NAME/rest (or model://) in `folder` and all folders above it, then in KINEGRAPH_PACKAGE_PATH,
/// ROS_PACKAGE_PATH and AMENT_PREFIX_PATH; empty if none has it. A missing path .../rai-robotModels/rest becomes rest
/// in the folder RAI_PATH, if that exists.
std::string resolvePath(const std::string& path, const std::string& folder);

/// Explains an empty result of resolvePath, with remedies.
std::string missingPackageMessage(const std::string& path);

/// Returns "; similar names: ..." with files beside a missing one, or reports a missing folder.
std::string similarFilesHint(const std::string& path);

/// Returns the extension of a file name with the dot, in lower case: ".urdf".
std::string lowerExtension(const std::string& path);

}  // namespace kinegraph
