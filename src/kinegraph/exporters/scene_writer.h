#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A frame's present state as attributes of a `.g` file: reading them gives the same pose, joint, shape, mass and free
/// attributes. Order: pose, joint, shape, mass, then everything that the library keeps without interpreting it. Poses
/// are relative to the parent, or of the world for a root; a joint with dofs has `q` instead. Meshes are named by the
/// absolute path of their file, or given by their numbers if they came from none.
Graph describeFrame(const FrameData& frame);

/// What frame names may look like in a text.
enum class NameRule {
  repeated,  ///< as they are, but for names that the `.g` language cannot refer to
  unique,    ///< every name once: for a dictionary
  plain,     ///< unique, and without characters that mean something in YAML
};

/// All frames of a scene in order, as the entries of a `.g` file. Where `rule` forces another name upon a frame, a
/// warning says so: names with blanks, quotes or parentheses, keywords of the language, or names that several frames
/// have and others refer to.
Graph describeScene(const Config& config, NameRule rule = NameRule::repeated,
                    std::vector<std::string>* warnings = nullptr);

/// The scene as a `.g` text, one frame per line; numbers are exact.
std::string writeScene(const Config& config, std::vector<std::string>* warnings = nullptr);

/// The scene as a text that is YAML and `.g` at once. `one_line` puts all of it on one.
std::string writeYaml(const Config& config, bool one_line = false, std::vector<std::string>* warnings = nullptr);

/// Writes the scene into a file, URDF for .urdf, MJCF for .xml, YAML for .yml and .yaml, else `.g`, and returns the
/// text. Throws FileError.
std::string saveScene(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace kinegraph
