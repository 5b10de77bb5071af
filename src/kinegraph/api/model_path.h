#pragma once

#include <string>

#ifndef KINEGRAPH_MODELS  // set by the package of a static library, which cannot know its own location
#define KINEGRAPH_MODELS ""
#endif

namespace kinegraph {

/// Returns the absolute path of a shipped model, as in modelPath("scenarios/pandaSingle.g"), or the folder of all
/// models: modelPath(""). Searches the folder in the environment variable RAI_PATH, the (relocatable) installation
/// prefix of this library (share/kinegraph/models), and `shipped`. Throws FileError with similar names.
std::string modelPath(const std::string& path, const std::string& shipped = KINEGRAPH_MODELS);

}  // namespace kinegraph
