#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

struct MjcfOptions {
  std::string model_name = "scene";
  std::string mesh_folder;  ///< where meshes that MuJoCo cannot read as they are go to, as .stl; empty: into the text
};

/// The scene as an MJCF text, which MuJoCo loads with the same poses:
///
///     root frame `world`         <worldbody>, if it is a fixed one at the origin
///     frame                      a body of its name, with <inertial>
///     joint of a frame           a joint of that name, or joints <frame>_0, <frame>_1, ... for each of its steps;
///                                a free joint at the origin of the world is a <freejoint>, elsewhere three slides
///                                and a ball
///     frame that only moves      no body: the body that it carries has the joint
///     only child                 no body for <joint>_origin (as scenes read from MJCF and URDF have them)
///     shape                      a geom of the frame's name; in the parent's body if the frame is nothing but a shape
///     marker, empty frame        a site of that name, if nothing hangs on the frame
///     camera                     a camera
///     mimic                      an <equality>
///
/// A capsule, box, ... is one, without rounding; a quad that does not move is a plane; other shapes are meshes. Bodies
/// that move get a mass of 1 g if they have none. MuJoCo's q is that of the scene, by name; where a joint has a
/// joint_scale it is |scale| * q. The present q is the keyframe `now`. A joint that is no part of q is fixed where it is,
/// and so are those that mimic it. Pairs of bodies that do not collide are <exclude>. What cannot be written is left
/// out, and `warnings` names it.
std::string writeMjcf(const Config& config, const MjcfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// Writes the scene into an MJCF file, named after which is the model, and meshes that need it into the folder
/// <file without extension>_meshes. Returns the text. Throws FileError.
std::string saveMjcf(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr);

}  // namespace kinegraph
