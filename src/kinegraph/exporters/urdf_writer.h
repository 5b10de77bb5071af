#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

struct UrdfOptions {
  std::string robot_name = "scene";
  std::string mesh_folder;  ///< folder for .stl files of shapes without a URDF element; empty: they are omitted
};

/// Converts the scene to a URDF text. Each frame becomes a link of its name on a fixed joint <frame>_joint, except:
///
///     frame with a joint        a joint of that name; its link is the frame's only child if that is at its origin
///                               without shape or joint in between (as in scenes read from URDF), else <frame>_link
///     <joint>_origin            the origin of that joint
///     frame with such a child   a fixed joint of the frame's name, with the child as its link
///     <link>_0, <link>_1, ...   shapes of that link
///     several roots,            a link `world` above them
///     or one off the origin
///
/// Shapes become visuals; with a contact flag they become collisions, and visuals too unless transparent. A capsule
/// becomes a cylinder with two spheres; rounded boxes and cylinders lose their rounding. A joint of several dofs
/// becomes a floating or planar joint if possible, else a chain of joints <frame>_0, <frame>_1, ... of one dof each; a
/// ball joint becomes three. Hands move: their joint, which is outside of q, and those that mimic it are joints. Other
/// joints outside of q and their mimics are fixed at their current values. URDF stores no
/// joint state: its zero is q = 0, and with a joint_scale its unit is that of scale * q. Content without a URDF
/// equivalent is omitted and listed in `warnings`.
std::string writeUrdf(const Config& config, const UrdfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// Returns an SRDF text for the text of writeUrdf: disabled collision pairs, groups of joints and named states
/// (attributes `joint_groups`, `joint_states`). Returns "" without groups and states if links collide by the rule for
/// URDF files without SRDF (Config::getCollidablePairs).
std::string writeSrdf(const Config& config, const UrdfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// Writes the scene to a URDF file. The robot gets the file's name, shapes that need mesh files go to the folder
/// <file without extension>_meshes, and a nonempty SRDF text goes to a file of the same name beside it. Returns the
/// text. Throws FileError.
std::string saveUrdf(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace kinegraph
