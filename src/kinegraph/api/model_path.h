#pragma once

#include <string>

#ifndef KINEGRAPH_MODELS  // the package of a static library, which cannot know where it is, says it
#define KINEGRAPH_MODELS ""
#endif

namespace kinegraph {

/// The absolute path of a model that comes with the library: modelPath("scenarios/pandaSingle.g"), or of the folder of
/// them all: modelPath(""). They are looked for in the folder that the environment variable RAI_PATH names, below the
/// prefix that this library lies in (share/kinegraph/models, wherever the prefix was moved to), and in `shipped`.
/// Throws FileError, with similar names.
std::string modelPath(const std::string& path, const std::string& shipped = KINEGRAPH_MODELS);

}  // namespace kinegraph
