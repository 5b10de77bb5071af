#include "kinegraph/exporters/writers.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/mjcf_motors.h"
#include "kinegraph/exporters/srdf_writer.h"
#include "kinegraph/exporters/stl_writer.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/parsers/urdf/urdf_model.h"
#include "kinegraph/parsers/xml/xml.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

std::string numbers(std::initializer_list<double> values) {
  std::vector<std::string> texts;
  for (const double x : values) texts.push_back(exact(x));
  return join(texts, " ");
}

std::string numbers(const Vector3d& v) { return numbers({v[0], v[1], v[2]}); }

/// Decomposes a rotation as R_z(yaw) R_y(pitch) R_x(roll). Exact at a pitch of 90 degrees, too.
Vector3d rollPitchYaw(const Matrix3d& R) {
  const double yaw = std::hypot(R(0, 0), R(1, 0)) < 1e-14 ? 0. : std::atan2(R(1, 0), R(0, 0));
  const Matrix3d rest = axisRotation(2, -yaw) * R;
  return {std::atan2(-rest(1, 2), rest(1, 1)), std::atan2(-rest(2, 0), rest(0, 0)), yaw};
}

std::string originElement(const Pose& pose) {
  if (pose.isIdentity(0.)) return "";
  return cat("<origin xyz=\"", numbers(pose.p), "\" rpy=\"", numbers(rollPitchYaw(pose.q.toRotationMatrix())), "\"/>");
}

bool isVisible(const FrameData& frame) {
  return frame.shape && frame.shape->geometry->type != ShapeType::none &&
         !shapeKind(frame.shape->geometry->type).is_symbol;
}

bool isBare(const FrameData& frame) { return !isVisible(frame) && !frame.inertia; }

/// Returns whether this is one of the frames <link>_0, <link>_1, ... with the shapes of a link.
bool isShapeOfLink(const FrameData& frame) {
  if (!frame.parent || frame.joint || frame.inertia || !frame.children.empty() || !isVisible(frame)) return false;
  const std::string stem = frame.parent->name + "_";
  const std::string number = frame.name.starts_with(stem) ? frame.name.substr(stem.size()) : "";
  return !number.empty() && number.find_first_not_of("0123456789") == std::string::npos;
}

bool isOriginOfJoint(const FrameData& frame) {
  return frame.parent && !frame.joint && isBare(frame) && frame.children.size() == 1 && frame.children[0]->moves() &&
         frame.name == frame.children[0]->name + "_origin";
}

/// One joint of a URDF file.
struct JointElement {
  std::string name, type, parent, child;
  Pose origin;
  Vector3d axis = Vector3d::Zero();  ///< zero: not written
  double lower = -kUrdfUnlimited, upper = kUrdfUnlimited, effort = 0., velocity = 0.;
  std::string mimic;
  double multiplier = 1.;
};

class UrdfWriter {
 public:
  UrdfWriter(const Config& config, const UrdfOptions& options, std::vector<std::string>* warnings)
      : config_(config), options_(options), warnings_(warnings), fingers_(fingerJoints(config)) {}

  std::string write() {
    for (const auto& frame : config_.scene()->frames()) reserved_.insert(frame->name);
    std::vector<const FrameData*> roots;
    for (const auto& frame : config_.scene()->frames()) {
      if (!frame->parent) roots.push_back(frame.get());
    }
    if (roots.size() == 1 && roots[0]->pose.isIdentity(0.)) {
      addFrames(*roots[0], linkName(roots[0]->name));
    } else {
      const std::string world = unused(links_, reserved_.contains("world") ? "world_" : "world");
      text_ += cat("  <link name=\"", xmlEscaped(world), "\"/>\n");
      for (const FrameData* root : roots) addFixed(*root, world, root->pose);
    }
    reportLosses();
    return cat("<?xml version=\"1.0\"?>\n<robot name=\"", xmlEscaped(options_.robot_name), "\">\n", text_,
               "</robot>\n");
  }

  /// Names of frames in the text.
  const UrdfNames& names() const { return names_; }

 private:
  void warn(const std::string& message) {
    if (warnings_) warnings_->push_back(message);
  }

  /// Returns whether q or a hand moves the frame. Other inactive joints and their mimics are fixed.
  bool isFree(const FrameData& frame) const {
    return frame.moves() && (dofSource(frame).joint->active || fingers_.contains(&frame));
  }

  /// The child that is the link of this frame's joint, or null.
  const FrameData* linkOfJoint(const FrameData& frame) const {
    if (!frame.parent || !isBare(frame) || frame.children.size() != 1) return nullptr;
    const FrameData& child = *frame.children[0];
    if (child.joint || isShapeOfLink(child) || isOriginOfJoint(child) || !child.pose.p.isZero(0.)) return nullptr;
    const bool turnable = isFree(frame) && frame.joint->steps.size() == 1 && frame.joint->dofs() == 1;
    return turnable || child.pose.isIdentity(0.) ? &child : nullptr;
  }

  void reportLosses() {
    const auto report = [&](const std::vector<std::string>& frames, const char* what) {
      if (!frames.empty()) warn(cat(what, ": ", joinFirst(frames)));
    };
    report(rounded_, "URDF has no rounded boxes and cylinders; frames without their rounding");
    report(moved_, "URDF has no joint state and readers start at q = 0; joints at other values");
  }

  static std::string unused(std::set<std::string>& taken, std::string name) {
    if (name.empty()) name = "frame";
    while (!taken.insert(name).second) name += "_";
    return name;
  }
  std::string linkName(const std::string& name) { return unused(links_, name); }
  std::string jointName(const std::string& name) { return unused(joints_, name); }

  /// A link name that no frame has.
  std::string newLinkName(std::string name) {
    while (reserved_.contains(name)) name += "_";
    return linkName(std::move(name));
  }

  /// Adds the link of a frame with its shapes, and everything below it.
  void addFrames(const FrameData& frame, const std::string& link) {
    std::string inside;
    addContact(frame, link);
    if (frame.inertia) inside += inertial(*frame.inertia);
    if (isVisible(frame)) inside += shape(frame, Pose());
    for (const FrameData* child : frame.children) {
      if (!isShapeOfLink(*child)) continue;
      inside += shape(*child, child->pose);
      addContact(*child, link);
    }
    text_ += inside.empty() ? cat("  <link name=\"", xmlEscaped(link), "\"/>\n")
                            : cat("  <link name=\"", xmlEscaped(link), "\">\n", inside, "  </link>\n");
    for (const FrameData* child : frame.children) {
      if (!isShapeOfLink(*child)) addChild(*child, link);
    }
  }

  void addContact(const FrameData& frame, const std::string& link) {
    if (isVisible(frame) && frame.shape->contact != 0) names_.link_of_shape[frame.id] = link;
  }

  void addChild(const FrameData& frame, const std::string& parent) {
    const bool origin = isOriginOfJoint(frame);
    const FrameData& moving = origin ? *frame.children[0] : frame;
    const Pose before = origin ? frame.pose : Pose();
    if (isFree(moving) && moving.joint->type != JointType::tau) {
      addMoving(moving, parent, before);
    } else {
      if (moving.moves() && !isFree(moving)) warnFixed(moving);
      addFixed(moving, parent, before * moving.relativePose());
    }
  }

  void warnFixed(const FrameData& frame) {
    const FrameData& source = dofSource(frame);
    if (&source != &frame)
      return warn(cat("joint '", frame.name, "' is fixed because the joint '", source.name, "' it mimics is fixed"));
    std::vector<std::string> q;
    for (const double value : source.joint->q) q.push_back(exact(value));
    warn(cat("joint '", frame.name, "' is not in q (joint_active: false) and is fixed at q = ", join(q, " ")));
  }

  void addFixed(const FrameData& frame, const std::string& parent, const Pose& origin) {
    const FrameData* behind = linkOfJoint(frame);
    JointElement joint;
    joint.name = jointName(behind ? frame.name : frame.name + "_joint");
    joint.type = "fixed";
    joint.parent = parent;
    joint.child = linkName(behind ? behind->name : frame.name);
    joint.origin = behind ? origin * behind->pose : origin;
    addJoint(joint);
    addFrames(behind ? *behind : frame, joint.child);
  }

  void addMoving(const FrameData& frame, const std::string& parent, const Pose& origin) {
    const FrameData* behind = linkOfJoint(frame);
    const std::string link = behind ? linkName(behind->name) : newLinkName(frame.name + "_link");
    std::vector<JointElement> chain = jointsOf(frame);
    if (!frame.joint->mimic && frame.joint->q != motionIdentity(frame.joint->steps)) moved_.push_back(frame.name);
    for (std::size_t i = 0; i < chain.size(); ++i) {
      JointElement& joint = chain[i];
      joint.name = chain.size() == 1 ? jointName(frame.name) : jointName(cat(frame.name, "_", i));
      joint.parent = i == 0 ? parent : chain[i - 1].child;
      if (i == 0) joint.origin = origin;
      joint.child = i + 1 == chain.size() ? link : newLinkName(cat(joint.name, "_link"));
      if (behind && !behind->pose.isIdentity(0.)) {  // the link is rotated against the joint frame: rotate both
        joint.origin = joint.origin * behind->pose;
        joint.axis = behind->pose.q.conjugate() * joint.axis;
      }
      if (chain.size() == 1) names_.joint_of_frame[frame.id] = joint.name;
      addJoint(joint);
      if (i + 1 < chain.size()) text_ += cat("  <link name=\"", xmlEscaped(joint.child), "\"/>\n");
    }
    addFrames(behind ? *behind : frame, link);
  }

  /// The URDF joints that compose the motion of a frame, without names and origins.
  std::vector<JointElement> jointsOf(const FrameData& frame) {
    const Joint& joint = *frame.joint;
    std::vector<JointElement> chain;
    if (joint.type == JointType::free || (joint.type == JointType::transXYPhi && joint.scale == 1.)) {
      JointElement element;
      element.type = joint.type == JointType::free ? "floating" : "planar";
      if (element.type == "planar") element.axis = Vector3d::UnitZ();
      if (joint.mimic)
        warn(cat("joint '", frame.name, "' of type ", jointTypeName(joint.type),
                 " mimics another; URDF cannot express that"));
      return {element};
    }
    int dof = 0;
    for (const MotionStep& step : joint.steps) {
      const double scale = motionScale(frame) * step.sign;
      const Vector3d axis = step.direction(joint.axis);
      if (step.translates() || step.rotates()) {
        chain.push_back(oneDof(frame, dof, step.translates() ? "prismatic" : "revolute", axis, scale));
      } else if (step.kind == MotionStep::Kind::quaternion) {
        for (int i = 0; i < 3; ++i) chain.push_back(continuous(Vector3d::Unit(i)));
      } else if (step.orients()) {
        chain.push_back(continuous(axis));
      }
      dof += step.dofs();
    }
    if (chain.empty()) {  // only a time joint
      chain.emplace_back();
      chain.back().type = "fixed";
    }
    return chain;
  }

  static JointElement continuous(const Vector3d& axis) {
    JointElement element;
    element.type = "continuous";
    element.axis = axis;
    return element;
  }

  JointElement oneDof(const FrameData& frame, int dof, const char* type, const Vector3d& axis, double scale) {
    const Joint& joint = *frame.joint;
    JointElement element;
    element.type = type;
    element.axis = scale < 0. ? Vector3d(-axis) : axis;
    const double unit = std::abs(scale);
    if (joint.lower.size() > dof && std::isfinite(joint.lower[dof]) && std::isfinite(joint.upper[dof])) {
      element.lower = unit * joint.lower[dof];
      element.upper = unit * joint.upper[dof];
    } else if (element.type == "revolute") {
      element.type = "continuous";
    }
    if (const Node* node = frame.attributes->find("ctrl_limits")) {
      const NumberArray* limits = node->value.as<NumberArray>();
      if (limits && limits->numbers.size() >= 2) {
        element.velocity = limits->numbers[0];
        element.effort = limits->numbers[1];
      }
    }
    if (joint.mimic) {
      const FrameData& source = dofSource(frame);
      const int parts = int(source.joint->steps.size());
      element.mimic = parts == 1 ? source.name : cat(source.name, "_", dof);
      element.multiplier = unit / std::abs(source.joint->scale);
    }
    return element;
  }

  void addJoint(const JointElement& joint) {
    names_.parent_of_link[joint.child] = joint.parent;
    text_ += cat("  <joint name=\"", xmlEscaped(joint.name), "\" type=\"", joint.type, "\">\n");
    if (const std::string origin = originElement(joint.origin); !origin.empty()) text_ += cat("    ", origin, "\n");
    text_ += cat("    <parent link=\"", xmlEscaped(joint.parent), "\"/>\n    <child link=\"", xmlEscaped(joint.child),
                 "\"/>\n");
    if (!joint.axis.isZero(0.)) text_ += cat("    <axis xyz=\"", numbers(joint.axis), "\"/>\n");
    const bool bounded = joint.type == "revolute" || joint.type == "prismatic";
    if (bounded || joint.effort != 0. || joint.velocity != 0.) {
      text_ += "    <limit";
      if (bounded) text_ += cat(" lower=\"", exact(joint.lower), "\" upper=\"", exact(joint.upper), "\"");
      const auto ofMotor = [](double limit) { return exact(limit > 0. ? limit : kUrdfUnlimited); };
      text_ += cat(" effort=\"", ofMotor(joint.effort), "\" velocity=\"", ofMotor(joint.velocity), "\"/>\n");
    }
    if (!joint.mimic.empty())
      text_ += cat("    <mimic joint=\"", xmlEscaped(joint.mimic), "\" multiplier=\"", exact(joint.multiplier),
                   "\" offset=\"0\"/>\n");
    text_ += "  </joint>\n";
  }

  static std::string inertial(const Inertia& inertia) {
    const Matrix3d& m = inertia.matrix;
    return cat("    <inertial>\n      <origin xyz=\"", numbers(inertia.com), "\"/>\n      <mass value=\"",
               exact(inertia.mass), "\"/>\n      <inertia ixx=\"", exact(m(0, 0)), "\" ixy=\"", exact(m(0, 1)),
               "\" ixz=\"", exact(m(0, 2)), "\" iyy=\"", exact(m(1, 1)), "\" iyz=\"", exact(m(1, 2)), "\" izz=\"",
               exact(m(2, 2)), "\"/>\n    </inertial>\n");
  }

  /// The shape of a frame at `pose` in its link: as visual, collision, or both.
  std::string shape(const FrameData& frame, const Pose& pose) {
    const Shape& shape = *frame.shape;
    const bool transparent = shape.color && (*shape.color)[3] < 1.;
    const auto element = [&](const char* kind, const Pose& at, const std::string& geometry,
                             const std::string& material) {
      const std::string origin = originElement(at);
      return cat("    <", kind, " name=\"", xmlEscaped(frame.name), "\">\n",
                 origin.empty() ? "" : cat("      ", origin, "\n"), "      <geometry>", geometry, "</geometry>\n",
                 material, "    </", kind, ">\n");
    };
    std::string material;
    const bool pictured = shape.texture && !shape.texture->path.empty();
    if (shape.color || pictured) {
      const Vector4d c = shape.color.value_or(Vector4d::Ones());
      material =
          cat("      <material name=\"", xmlEscaped(frame.name), "_color\"><color rgba=\"",
              numbers({c[0], c[1], c[2], c[3]}), "\"/>",
              pictured ? cat("<texture filename=\"", xmlEscaped(shape.texture->path), "\"/>") : "", "</material>\n");
    }
    std::string out;
    for (const auto& [at, geometry] : geometryElements(frame)) {
      if (shape.contact == 0 || !transparent) out += element("visual", pose * at, geometry, material);
      if (shape.contact != 0) out += element("collision", pose * at, geometry, "");
    }
    return out;
  }

  /// The shape as URDF elements, with their poses in the frame.
  std::vector<std::pair<Pose, std::string>> geometryElements(const FrameData& frame) {
    const Geometry& geometry = *frame.shape->geometry;
    const std::vector<double>& s = geometry.size;
    if (geometry.type == ShapeType::ssBox || geometry.type == ShapeType::ssCylinder) rounded_.push_back(frame.name);
    const auto cylinder = [](double length, double radius) {
      return cat("<cylinder length=\"", exact(length), "\" radius=\"", exact(radius), "\"/>");
    };
    switch (geometry.type) {
      case ShapeType::box:
      case ShapeType::ssBox:
        return {{Pose(), cat("<box size=\"", numbers({s[0], s[1], s[2]}), "\"/>")}};
      case ShapeType::sphere:
        return {{Pose(), cat("<sphere radius=\"", exact(s[0]), "\"/>")}};
      case ShapeType::cylinder:
      case ShapeType::ssCylinder:
        return {{Pose(), cylinder(s[0], s[1])}};
      case ShapeType::capsule: {
        const std::string ball = cat("<sphere radius=\"", exact(s[1]), "\"/>");
        const Vector3d end(0., 0., .5 * s[0]);
        return {{Pose(), cylinder(s[0], s[1])},
                {Pose(end, Quaterniond::Identity()), ball},
                {Pose(-end, Quaterniond::Identity()), ball}};
      }
      default:
        break;
    }
    if (!geometry.mesh_file.empty()) {
      const std::string scale =
          geometry.mesh_scale == Vector3d::Ones() ? "" : cat(" scale=\"", numbers(geometry.mesh_scale), "\"");
      return {{Pose(), cat("<mesh filename=\"file://", xmlEscaped(geometry.mesh_file), "\"", scale, "/>")}};
    }
    const Mesh mesh = tessellate(geometry);
    if (mesh.triangles.empty() || options_.mesh_folder.empty()) {
      warn(cat("the ", shapeTypeName(geometry.type), " of frame '", frame.name, "' is omitted: URDF ",
               mesh.triangles.empty() ? "has no such shape" : "needs a mesh file; pass mesh_folder"));
      return {};
    }
    std::filesystem::create_directories(options_.mesh_folder);
    const std::filesystem::path path = std::filesystem::absolute(options_.mesh_folder) / cat(frame.id, ".stl");
    writeStl(mesh, path.string());
    return {{Pose(), cat("<mesh filename=\"file://", xmlEscaped(path.string()), "\"/>")}};
  }

  const Config& config_;
  const UrdfOptions& options_;
  std::vector<std::string>* warnings_;
  const std::set<const FrameData*> fingers_;  ///< joints of hands
  std::string text_;
  std::set<std::string> reserved_;  ///< names of frames
  std::set<std::string> links_, joints_;
  UrdfNames names_;
  std::vector<std::string> rounded_, moved_;  ///< frames and joints that lose their rounding or position
};

}  // namespace

std::string writeUrdf(const Config& config, const UrdfOptions& options, std::vector<std::string>* warnings) {
  UrdfWriter writer(config, options, warnings);
  std::string text = writer.write();
  if (warnings && !srdfText(config, options.robot_name, writer.names(), nullptr).empty())
    warnings->push_back(
        "the text lacks disabled collision pairs, joint groups or named states: URDF has no elements for them; "
        "saving to a file also writes them to an SRDF file beside it");
  return text;
}

std::string writeSrdf(const Config& config, const UrdfOptions& options, std::vector<std::string>* warnings) {
  UrdfWriter writer(config, {options.robot_name, ""}, nullptr);
  writer.write();
  return srdfText(config, options.robot_name, writer.names(), warnings);
}

}  // namespace kinegraph
