#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

struct MjcfOptions {
  std::string model_name = "scene";
  std::string mesh_folder;  ///< folder for .stl files of meshes that MuJoCo cannot read directly; empty: inline numbers

  /// Adds what a simulation needs: actuators with the gains and force limits of `Simulation` (MjcfMotors), hands that
  /// open and close, free joints of objects with a mass, and options for contacts.
  bool motors = false;
};

/// Converts the scene to an MJCF text; MuJoCo loads it with the same poses:
///
///     root frame `world`         <worldbody>, if it is fixed at the origin
///     frame                      a body of its name, with <inertial>
///     joint of a frame           a joint of that name, or joints <frame>_0, <frame>_1, ... for each of its steps;
///                                a free joint at the origin of the world is a <freejoint>, elsewhere three slides
///                                and a ball
///     frame that only moves      no body: the joint belongs to the body of its child
///     <joint>_origin             no body if it has one child (scenes read from MJCF and URDF contain such frames)
///     shape                      a geom of the frame's name; in the parent's body if the frame is only a shape
///     marker, empty frame        a site of that name, if the frame has no children
///     camera                     a camera
///     mimic                      an <equality>
///
/// Shapes such as capsule and box keep their type, without rounding; a fixed quad is a plane; other shapes are
/// meshes.
/// Moving bodies without mass get 1 g. MuJoCo's q equals the scene's by joint name; with a joint_scale it is |scale|
/// * q.
/// The current q is the keyframe `now`. Joints outside of q and their mimics are fixed at their current values.
/// With `motors`, an actuator has the name of its joint. Its `ctrl` is the reference q + v kv / kp, with the velocity
/// v of the reference; that of a hand is the position of its joint. The keyframe holds the present q.
/// Non-colliding pairs of bodies are <exclude>. Content without an MJCF equivalent is omitted and listed in
/// `warnings`.
std::string writeMjcf(const Config& config, const MjcfOptions& options = {},
                      std::vector<std::string>* warnings = nullptr);

/// Writes the scene to an MJCF file. The model gets the file's name; meshes that need files go to the folder
/// <file without extension>_meshes. Returns the text. Throws FileError.
std::string saveMjcf(const Config& config, const std::string& path, std::vector<std::string>* warnings = nullptr,
                     bool motors = false);

}  // namespace kinegraph
