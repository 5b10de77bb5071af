#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::inline parsers_internal {

/// The content of a URDF file, with positions for messages. SI units.

/// A <visual> or <collision>.
struct UrdfShape {
  bool collision = false;
  Pose origin;                        ///< in the link
  ShapeType type = ShapeType::none;   ///< box, sphere, cylinder, capsule or mesh
  std::vector<double> size;           ///< as in Geometry
  std::string mesh;                   ///< file name as written
  Vector3d scale = Vector3d::Ones();  ///< of the mesh
  std::optional<Vector4d> color;      ///< of the material
  std::string texture;
  SourcePosition where;
};

struct UrdfInertial {
  double mass = 0.;
  Vector3d com = Vector3d::Zero();     ///< in the link
  Matrix3d matrix = Matrix3d::Zero();  ///< about the center of mass, in the axes of the link
  SourcePosition where;
};

struct UrdfLink {
  std::string name;
  std::optional<UrdfInertial> inertial;
  std::vector<UrdfShape> shapes;
  SourcePosition where;
};

struct UrdfMimic {
  std::string joint;
  double multiplier = 1., offset = 0.;
  SourcePosition where;
};

/// A limit of at least this size (rad or m) means unlimited: URDF requires limits for every prismatic joint.
constexpr double kUrdfUnlimited = 1e9;

/// `spherical` is an extension of PyBullet and MuJoCo.
enum class UrdfJointType { fixed, revolute, continuous, prismatic, planar, floating, spherical };

struct UrdfJoint {
  std::string name;
  UrdfJointType type = UrdfJointType::fixed;
  std::string parent, child;  ///< links
  Pose origin;                ///< in the parent link
  Vector3d axis = Vector3d::UnitX();
  bool limited = false;
  double lower = 0., upper = 0.;       ///< if limited
  double effort = 0., velocity = 0.;   ///< 0: not given
  double damping = 0., friction = 0.;  ///< of <dynamics>
  std::optional<UrdfMimic> mimic;
  SourcePosition where, parent_where, child_where, limit_where;
};

struct UrdfModel {
  std::string name;
  std::vector<UrdfLink> links;
  std::vector<UrdfJoint> joints;
  std::optional<std::string> mesh_folder;  ///< `meshdir` of MuJoCo's extension <mujoco>; "" if that gives none
};

/// Parses a URDF text as far as possible and appends errors and warnings to `found`. A flaw of a shape, a material or
/// an <inertial> leaves that part out with a warning. Does not check that links and joints form a tree.
UrdfModel parseUrdf(std::string_view text, const std::string& file, std::vector<Diagnostic>& found);

/// Returns whether the list contains an error.
bool hasErrors(const std::vector<Diagnostic>& found);

}  // namespace kinegraph::inline parsers_internal
