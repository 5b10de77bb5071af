#pragma once

#include <string>

namespace kinegraph::inline common_internal {

struct LocatedFile {
  std::string path;        ///< absolute; of a file that may be missing, or empty for a package that is not found
  std::string assumption;  ///< for a warning, if the file is not exactly the one that was named; otherwise empty
};

/// Finds the file that `path` names, relative to `folder`. Drops file://. Tries the name as written, with $NAME expanded
/// from the environment, with %20 as a blank and so on, with \ as /, and with other capitals if exactly one file has
/// them. Searches package://NAME/rest (also model:// and $(find NAME)/rest) in the folders of visitPackageFolders, and
/// then `rest` in `folder` and above it. A missing path .../rai-robotModels/rest becomes rest in the folder RAI_PATH,
/// if that exists.
LocatedFile locateFile(const std::string& path, const std::string& folder);

/// The path of locateFile.
std::string resolvePath(const std::string& path, const std::string& folder);

/// Explains an empty result of resolvePath, with remedies.
std::string missingPackageMessage(const std::string& path);

/// Returns "; similar names: ..." with files beside a missing one, or reports a missing folder.
std::string similarFilesHint(const std::string& path);

/// Returns the file `path` of the shipped models, the folder RAI_PATH; "" for absolute paths and without such a file.
std::string shippedFile(const std::string& path);

/// Returns "; the shipped models have <$RAI_PATH/scenarios/pandaSingle.g>" for a missing file whose name, or a similar
/// one, is among the shipped models; otherwise "".
std::string shippedFilesHint(const std::string& path);

/// Returns the extension of a file name with the dot, in lower case: ".urdf".
std::string lowerExtension(const std::string& path);

}  // namespace kinegraph::inline common_internal
