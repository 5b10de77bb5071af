#pragma once

#include <string>
#include <vector>

#include "kinegraph/scene/config.h"

namespace kinegraph {

/// Converts the scene in its current state to a binary glTF 2.0 file (.glb). Each frame becomes a node with its name,
/// its pose in the parent, and the surface or points shown by a viewer, in their colors. The root node `scene` rotates
/// z to y, glTF's up axis. Shapes with the same mesh share its data. Markers, cameras and lines are omitted.
std::string gltfBytes(const Config& config);

/// Writes gltfBytes() to a file. Throws FileError.
void writeGltf(const Config& config, const std::string& path);

/// Merges the surfaces of all shapes with triangles into one mesh in world coordinates (m). Each vertex has a color:
/// the mesh's own, else the frame's, else gray.
Mesh worldMesh(const Config& config);

/// Writes a mesh as a binary PLY file with vertex colors. Throws FileError.
void writePly(const Mesh& mesh, const std::string& path);

/// Writes a mesh as a text file of Wavefront OBJ, with vertex colors behind the coordinates. Throws FileError.
void writeObj(const Mesh& mesh, const std::string& path);

/// Writes all surfaces of a scene to one file, in world coordinates. The suffix is .ply, .obj, or .stl (no colors).
/// Throws FileError, and ValueError for other suffixes and for a scene without surfaces.
void saveWorldMesh(const Config& config, const std::string& path);

/// Writes every mesh of a scene once, in its frame's coordinates, as `<prefix><frame>.ply`, or as
/// `<prefix>mesh_<number>.ply` with `enumerate`. Shapes that share a mesh share the file. Creates folders. Returns the
/// paths.
std::vector<std::string> saveMeshes(const Config& config, const std::string& prefix, bool enumerate = false);

/// Writes the convex hull of every mesh, shrunk by `shrink` (m) if that is positive, as `<prefix><frame>.stl`. Skips
/// flat meshes. Creates folders. Returns the paths.
std::vector<std::string> saveConvexStls(const Config& config, const std::string& prefix, double shrink = -1.);

/// The tree of frames with poses, surfaces and colors as a COLLADA 1.4.1 text. Units m, z up.
std::string writeCollada(const Config& config);

/// Writes writeCollada() to a file. Throws FileError.
void saveCollada(const Config& config, const std::string& path);

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
