#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

struct UrdfOptions {
  std::string robot_name = "scene";
  std::string mesh_folder;  ///< where shapes that URDF has no element for go to, as .stl; empty: they are left out
};

/// The scene as a URDF text. Each frame becomes a link of its name on a fixed joint <frame>_joint, but:
///
///     frame with a joint        a joint of that name; its link is the frame's only child if that sits at its origin
///                               without shape or joint in between (as scenes read from URDF have it), else
///                               <frame>_link
///     <joint>_origin            the origin of that joint
///     frame with such a child   a fixed joint of the frame's name, with the child as its link
///     <link>_0, <link>_1, ...   shapes of that link
///     several roots,            a link `world` above them
///     or one off the origin
///
/// Shapes are visuals; with a contact flag they are collisions, and visuals too unless transparent. A capsule is a
/// cylinder with two spheres; rounded boxes and cylinders lose their rounding. A joint of several dofs is a floating or
/// planar joint if URDF has that, else a chain of joints <frame>_0, <frame>_1, ... of one dof each; a ball is three of
/// them. A joint that is no part of q is fixed where it is, and so are those that mimic it. URDF holds no joint state:
/// its zero is q = 0, and where a joint has a joint_scale its unit is that of scale * q. What cannot be written is left
/// out, and `warnings` names it.
std::string writeUrdf(const Config& config, const UrdfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// What URDF has no words for, as an SRDF text that belongs to that of writeUrdf: pairs of links that do not collide,
/// groups of joints and named states (attributes `joint_groups`, `joint_states`). "" if there is nothing to say: no group
/// and no state, and links collide as those of a URDF file without SRDF do (Config::getCollidablePairs).
std::string writeSrdf(const Config& config, const UrdfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// Writes the scene into a URDF file, named after which is the robot, shapes that need one into mesh files in the folder
/// <file without extension>_meshes, and an SRDF file of the same name beside it if there is something to say there.
/// Returns the text. Throws FileError.
std::string saveUrdf(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace kinegraph
