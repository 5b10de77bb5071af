#include "kinegraph/parsers/urdf/urdf_reader.h"

#include <filesystem>
#include <map>
#include <set>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_cache.h"
#include "kinegraph/parsers/urdf/urdf_model.h"
#include "kinegraph/parsers/xml/axis_motion.h"
#include "kinegraph/parsers/xml/frame_attributes.h"

namespace kinegraph::inline parsers_internal {

namespace {

AxisMotion motionOf(const UrdfJoint& joint) {
  switch (joint.type) {
    case UrdfJointType::fixed:
      return {"none"};
    case UrdfJointType::revolute:
    case UrdfJointType::continuous:
      return rotationAbout(joint.axis);
    case UrdfJointType::prismatic:
      return translationAlong(joint.axis);
    case UrdfJointType::planar:
      return {"transXYPhi", 1., Quaterniond::FromTwoVectors(Vector3d::UnitZ(), joint.axis)};
    case UrdfJointType::floating:
      return {"free"};
    case UrdfJointType::spherical:
      return {"quatBall"};
  }
  return {"none"};
}

/// The pose of a one-dof joint at `q`.
Pose poseAt(const UrdfJoint& joint, double q) {
  if (joint.type == UrdfJointType::prismatic) return {q * joint.axis, Quaterniond::Identity()};
  return {Vector3d::Zero(), Quaterniond(Eigen::AngleAxisd(q, joint.axis))};
}

bool hasOneDof(const UrdfJoint& joint) {
  return joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::continuous ||
         joint.type == UrdfJointType::prismatic;
}

class UrdfReader {
 public:
  UrdfReader(UrdfModel model, const std::string& folder, std::vector<Diagnostic>& found)
      : model_(std::move(model)), folder_(folder), found_(found) {}

  Graph read() {
    if (hasErrors(found_)) return {};
    nameEverything();
    linkUp();
    const auto roots = hasErrors(found_) ? std::vector<const UrdfLink*>() : findRoots();
    if (hasErrors(found_)) return {};
    resolveMimics();
    for (const UrdfLink* root : roots) addLink(*root, "", Quaterniond::Identity());
    return std::move(graph_);
  }

 private:
  void error(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::error, where, std::move(message)});
  }
  void warn(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, where, std::move(message)});
  }

  /// Returns an unused name: `name` itself, or with underscores appended.
  std::string unusedName(std::string name) {
    while (!names_.insert(name).second) name += "_";
    return name;
  }

  void nameEverything() {
    for (const UrdfLink& link : model_.links) {
      names_.insert(link.name);
      links_[link.name] = &link;
    }
    for (const UrdfJoint& joint : model_.joints) {
      frame_of_joint_[&joint] = unusedName(names_.contains(joint.name) ? joint.name + "_joint" : joint.name);
    }
  }

  std::vector<std::string> linkNames() const {
    std::vector<std::string> names;
    for (const UrdfLink& link : model_.links) names.push_back(link.name);
    return names;
  }

  /// Connects joints and links.
  void linkUp() {
    for (const UrdfJoint& joint : model_.joints) {
      for (const auto& [link, where] :
           {std::pair(joint.parent, joint.parent_where), std::pair(joint.child, joint.child_where)}) {
        if (!links_.contains(link)) {
          error(where, cat("joint '", joint.name, "': no link '", link, "'", similarHint(link, linkNames())));
        }
      }
      const auto [above, is_first] = joint_above_.emplace(joint.child, &joint);
      if (!is_first) {
        error(joint.child_where, cat("link '", joint.child, "' is the child of two joints: '", above->second->name,
                                     "' and '", joint.name, "'"));
      }
      joints_below_[joint.parent].push_back(&joint);
    }
  }

  /// Returns the links without a joint above them. Reports an error and returns none if a loop has no root.
  std::vector<const UrdfLink*> findRoots() {
    std::vector<const UrdfLink*> roots;
    for (const UrdfLink& link : model_.links) {
      if (!joint_above_.contains(link.name)) roots.push_back(&link);
    }
    if (roots.empty()) {
      error(model_.joints.front().where, "the joints of this robot form a loop; a URDF file describes a tree");
      return {};
    }
    std::set<std::string> reached;
    for (const UrdfLink* root : roots) reach(root->name, reached);
    for (std::size_t i = 1; i < roots.size(); ++i) {
      warn(roots[i]->where, cat("link '", roots[i]->name, "' has no joint above it, and neither has '", roots[0]->name,
                                "'; it is read as a separate root"));
    }
    for (const UrdfLink& link : model_.links) {
      if (reached.contains(link.name)) continue;
      error(link.where, cat("link '", link.name, "' is its own ancestor: the joints above it form a loop"));
      return {};
    }
    return roots;
  }

  void reach(const std::string& link, std::set<std::string>& reached) const {
    reached.insert(link);
    const auto below = joints_below_.find(link);
    if (below == joints_below_.end()) return;
    for (const UrdfJoint* joint : below->second) reach(joint->child, reached);
  }

  const UrdfJoint* findJoint(const std::string& name) const {
    for (const UrdfJoint& joint : model_.joints) {
      if (joint.name == name) return &joint;
    }
    return nullptr;
  }

  /// Makes every mimic refer to the joint that owns the dof. Such files exist: an unknown source or a loop removes the
  /// mimic; a fixed source or the multiplier 0 fixes the joint.
  void resolveMimics() {
    std::vector<std::string> names;
    for (const UrdfJoint& joint : model_.joints) names.push_back(joint.name);
    for (UrdfJoint& joint : model_.joints) {
      if (joint.type == UrdfJointType::fixed) joint.mimic.reset();  // as in reduced models
      if (!joint.mimic || findJoint(joint.mimic->joint)) continue;
      warn(joint.mimic->where,
           cat("joint '", joint.name, "' mimics '", joint.mimic->joint,
               "', which is not a joint; it is read as an independent joint", similarHint(joint.mimic->joint, names)));
      joint.mimic.reset();
    }
    for (UrdfJoint& joint : model_.joints) followMimic(joint);
    for (UrdfJoint& joint : model_.joints) {
      const bool source_fixed = joint.mimic && findJoint(joint.mimic->joint)->type == UrdfJointType::fixed;
      if (!joint.mimic || (!source_fixed && joint.mimic->multiplier != 0.)) continue;
      warn(joint.mimic->where, cat("joint '", joint.name, "' mimics '", joint.mimic->joint,
                                   source_fixed ? "', which is fixed; it is read as fixed, too"
                                                : "' with the multiplier 0; it is read as fixed"));
      joint.origin = joint.origin * poseAt(joint, joint.mimic->offset);
      joint.type = UrdfJointType::fixed;
      joint.mimic.reset();
    }
  }

  void followMimic(UrdfJoint& joint) {
    std::set<const UrdfJoint*> seen = {&joint};
    const std::string mimicked = joint.mimic ? joint.mimic->joint : "";
    while (joint.mimic) {
      const UrdfJoint& source = *findJoint(joint.mimic->joint);
      const std::string whom = mimicked == joint.name ? "itself" : cat("'", mimicked, "'");
      const std::string who = cat("joint '", joint.name, "' mimics ", whom);
      const bool impossible = !hasOneDof(joint) || (!hasOneDof(source) && source.type != UrdfJointType::fixed);
      if (impossible || !seen.insert(&source).second) {
        warn(joint.mimic->where,
             cat(who,
                 impossible               ? ", but only revolute, continuous and prismatic joints can mimic each other"
                 : mimicked == joint.name ? ""
                                          : ", which mimics it in turn",
                 "; it is read as an independent joint"));
        joint.mimic.reset();
      } else if (source.mimic) {
        joint.mimic->offset += joint.mimic->multiplier * source.mimic->offset;
        joint.mimic->multiplier *= source.mimic->multiplier;
        joint.mimic->joint = source.mimic->joint;
        continue;
      }
      return;
    }
  }

  void addFrame(const std::string& name, const std::string& parent, const SourcePosition& where,
                FrameAttributes attributes) {
    graph_.nodes.push_back(attributes.takeFrame(name, parent, where));
  }

  void addLink(const UrdfLink& link, const std::string& parent, const Quaterniond& rotation) {
    FrameAttributes attributes(link.inertial ? link.inertial->where : link.where);
    attributes.addPose({Vector3d::Zero(), rotation});
    if (link.inertial && link.inertial->mass > 0.) {
      const Matrix3d& m = link.inertial->matrix;
      attributes.add("mass", link.inertial->mass);
      if (!link.inertial->com.isZero(0.))
        attributes.addNumbers("com", {link.inertial->com.begin(), link.inertial->com.end()});
      attributes.addNumbers("inertia", {m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
    }
    addFrame(link.name, parent, link.where, std::move(attributes));
    // Visual shapes come first. A link that has lost all of them shows its collision shapes.
    bool lost = false, shown = false;
    for (std::size_t i = 0; i < link.shapes.size(); ++i) {
      const UrdfShape& shape = link.shapes[i];
      const bool known = addShape(shape, link.name, i, lost && !shown);
      if (!shape.collision) (known ? shown : lost) = true;
    }
    for (const UrdfJoint* joint : joints_below_[link.name]) addJoint(*joint);
  }

  /// Finds a mesh file. With the extension <mujoco>, a missing one is searched in its `meshdir`, also by name alone.
  LocatedFile locateMesh(const std::string& name) const {
    namespace fs = std::filesystem;
    const LocatedFile file = locateFile(name, folder_);
    std::error_code ignored;
    if (!model_.mesh_folder || fs::is_regular_file(file.path, ignored)) return file;
    for (const fs::path& tail : {fs::path(name), fs::path(name).filename()}) {
      const LocatedFile next = locateFile((fs::path(*model_.mesh_folder) / tail).string(), folder_);
      if (fs::is_regular_file(next.path, ignored)) return next;
    }
    return file;
  }

  /// Returns the path of a mesh file that can be read, or "" after a warning.
  std::string findMesh(const UrdfShape& shape, const std::string& link) {
    const LocatedFile file = locateMesh(shape.mesh);
    const std::string who = cat("link '", link, "': mesh '", shape.mesh, "' ");
    if (file.path.empty()) {
      warn(shape.where, cat(who,
                            "does not exist; packages are searched in the folders above the file and in "
                            "KINEGRAPH_PACKAGE_PATH, ROS_PACKAGE_PATH and AMENT_PREFIX_PATH"));
      return "";
    }
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file.path, ignored)) {
      warn(shape.where, cat(who, "does not exist (", file.path, ")"));
      return "";
    }
    try {
      sharedMeshFile(file.path);
    } catch (const FileError& e) {
      warn(shape.where, cat("link '", link, "': ", e.what(), "; the shape is left out"));
      return "";
    }
    if (!file.assumption.empty())
      warn(shape.where, cat("link '", link, "': mesh '", shape.mesh, "': ", file.assumption));
    return file.path;
  }

  /// Adds a frame with the shape; returns false if its mesh is missing. `opaque`: a collision shape is shown as a part.
  bool addShape(const UrdfShape& shape, const std::string& link, std::size_t index, bool opaque) {
    FrameAttributes attributes(shape.where);
    attributes.addPose(shape.origin);
    const std::string name = unusedName(cat(link, "_", index));
    bool known = true;
    if (shape.type == ShapeType::mesh) {
      const std::string path = findMesh(shape, link);
      known = !path.empty();
      if (known) {
        attributes.add("mesh", AngleText{path});
        if (shape.scale != Vector3d::Ones())
          attributes.addNumbers("meshscale", {shape.scale.begin(), shape.scale.end()});
      }
    } else {
      static const std::map<ShapeType, std::string> words = {{ShapeType::box, "box"},
                                                             {ShapeType::sphere, "sphere"},
                                                             {ShapeType::cylinder, "cylinder"},
                                                             {ShapeType::capsule, "capsule"}};
      attributes.add("shape", words.at(shape.type));
      attributes.addNumbers("size", shape.size);
    }
    if (known && shape.collision) {
      attributes.addNumbers("color", opaque ? std::vector{.7, .7, .7} : std::vector{1., 0., 0., .2});
      attributes.add("contact", -2.);
    } else if (known) {
      if (shape.color) attributes.addNumbers("color", {shape.color->begin(), shape.color->end()});
      attributes.add("visual", true);
    }
    if (known && !shape.texture.empty()) attributes.add("texture", AngleText{resolvePath(shape.texture, folder_)});
    addFrame(name, link, shape.where, std::move(attributes));
    return known;
  }

  void addJoint(const UrdfJoint& joint) {
    const std::string& name = frame_of_joint_.at(&joint);
    const AxisMotion motion = motionOf(joint);
    Pose origin = joint.origin;
    if (joint.mimic) origin = origin * poseAt(joint, joint.mimic->offset);
    origin = origin * Pose(Vector3d::Zero(), motion.rotation);
    FrameAttributes attributes(joint.limit_where);
    std::string parent = joint.parent;
    if (joint.type == UrdfJointType::fixed) {
      attributes.addPose(origin);
    } else {
      if (!origin.isIdentity(0.)) {
        FrameAttributes at(joint.where);
        at.addPose(origin);
        parent = unusedName(name + "_origin");
        addFrame(parent, joint.parent, joint.where, std::move(at));
      }
      attributes.add("joint", std::string(motion.type));
      if (std::string_view(motion.type) == "hinge")
        attributes.addNumbers("axis", {joint.axis.begin(), joint.axis.end()});
      double scale = motion.scale;  // a mimic multiplies its source's motion, including the source's own scale
      if (joint.mimic) scale *= joint.mimic->multiplier * motionOf(*findJoint(joint.mimic->joint)).scale;
      if (scale != 1.) attributes.add("joint_scale", scale);
      if (joint.limited) attributes.addNumbers("limits", {joint.lower, joint.upper});
      if (joint.effort != 0. || joint.velocity != 0.)
        attributes.addNumbers("ctrl_limits", {joint.velocity, joint.effort, -1.});
      if (joint.damping > 0.) attributes.add("angularDamping", joint.damping);
      if (joint.friction > 0.) attributes.add("jointFriction", joint.friction);
      if (joint.mimic) attributes.add("mimic", frame_of_joint_.at(findJoint(joint.mimic->joint)));
    }
    addFrame(name, parent, joint.where, std::move(attributes));
    addLink(*links_.at(joint.child), name, motion.rotation.conjugate());
  }

  UrdfModel model_;
  const std::string& folder_;
  std::vector<Diagnostic>& found_;
  Graph graph_;
  std::set<std::string> names_;
  std::map<std::string, const UrdfLink*> links_;
  std::map<const UrdfJoint*, std::string> frame_of_joint_;
  std::map<std::string, const UrdfJoint*> joint_above_;                ///< by link
  std::map<std::string, std::vector<const UrdfJoint*>> joints_below_;  ///< by link
};

}  // namespace

ParseResult readUrdf(std::string_view text, const std::string& file, const std::string& folder) {
  ParseResult result;
  UrdfModel model = parseUrdf(text, file, result.diagnostics);
  result.graph = UrdfReader(std::move(model), folder, result.diagnostics).read();
  return result;
}

}  // namespace kinegraph::inline parsers_internal
