#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Describes a frame's current state as attributes of a `.g` file. Reading them restores pose, joint, shape, mass and
/// the free attributes. Order: pose, joint, shape, mass, then the uninterpreted attributes. Poses are relative to the
/// parent, or to the world for a root; a joint with dofs has `q` instead. Meshes are given by the absolute path of
/// their file, or inline if they have none.
Graph describeFrame(const FrameData& frame);

/// Restrictions on frame names in a text.
enum class NameRule {
  repeated,  ///< unchanged, except for names that the `.g` language cannot refer to
  unique,    ///< every name once: for a dictionary
  plain,     ///< unique, and without special characters of YAML
};

/// Describes all frames of a scene in order, as the entries of a `.g` file. Renamed frames are listed in a warning:
/// names with blanks, quotes or parentheses, keywords of the language, and ambiguous names that other frames refer to.
Graph describeScene(const Config& config, NameRule rule = NameRule::repeated,
                    std::vector<std::string>* warnings = nullptr);

/// The scene as a `.g` text, one frame per line; numbers are exact.
std::string writeScene(const Config& config, std::vector<std::string>* warnings = nullptr);

/// The scene as a text that is valid YAML and `.g`. `one_line` writes it on a single line.
std::string writeYaml(const Config& config, bool one_line = false, std::vector<std::string>* warnings = nullptr);

/// Writes the scene to a file and returns the text. The extension selects URDF (.urdf), MJCF (.xml), YAML (.yml,
/// .yaml), else `.g`. Throws FileError.
std::string saveScene(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace kinegraph
