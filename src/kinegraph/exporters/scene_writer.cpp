#include "kinegraph/exporters/writers.h"

#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/gfile/writer.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Names of frames in a text, by frame.
using Names = std::map<const FrameData*, std::string>;

/// The first frame of each shared shape.
using ShapeOwners = std::map<const Shape*, const FrameData*>;

/// Builds the attributes of one frame.
class FrameDescription {
 public:
  FrameDescription(const FrameData& frame, const Names& names, const ShapeOwners& owners)
      : frame_(frame), names_(names), owners_(owners) {}

  Graph describe() {
    addPose();
    if (frame_.joint) addJoint(*frame_.joint);
    if (frame_.shape) addShape(*frame_.shape);
    addExclusions();
    if (frame_.inertia) addInertia(*frame_.inertia);
    addFreeAttributes();
    return std::move(graph_);
  }

 private:
  template <class T>
  void add(const char* key, T data) {
    Node node;
    node.key = key;
    node.value.data = std::move(data);
    graph_.nodes.push_back(std::move(node));
  }

  template <class Range>
  void addNumbers(const char* key, const Range& numbers) {
    add(key, NumberArray{std::vector<double>(numbers.begin(), numbers.end()), 1});
  }

  void addPoseNumbers(const char* key, const Pose& pose) {
    if (pose.isIdentity(0.)) return;
    const Vector7d x = pose.numbers();
    if (pose.q.vec().isZero(0.)) {
      addNumbers(key, Vector3d(x.head<3>()));
    } else if (pose.p.isZero(0.)) {
      addNumbers(key, Vector4d(x.tail<4>()));
    } else {
      addNumbers(key, x);
    }
  }

  void addPose() {
    if (!frame_.moves()) addPoseNumbers("pose", frame_.pose);
  }

  std::string nameOf(const FrameData& frame) const {
    const auto found = names_.find(&frame);
    return found == names_.end() ? frame.name : found->second;
  }

  void addJoint(const Joint& joint) {
    add("joint", joint.type == JointType::generic ? "_" + joint.code : jointTypeName(joint.type));
    if (joint.control_weight != 1.) add("ctrl_H", joint.control_weight);
    if (joint.scale != 1.) add("joint_scale", joint.scale);
    if (joint.lower.size() > 0) {
      std::vector<double> limits(joint.lower.begin(), joint.lower.end());
      limits.insert(limits.end(), joint.upper.begin(), joint.upper.end());
      addNumbers("limits", limits);
    }
    if (joint.type == JointType::hinge) addNumbers("axis", joint.axis);
    if (joint.mimic) add("mimic", nameOf(*joint.mimic));
    const bool at_identity = joint.dofs() == 0 || (joint.q - motionIdentity(joint.steps)).isZero(0.);
    if (!joint.mimic && !at_identity) addNumbers("q", joint.q);
    if (!joint.mimic && joint.dofs() > 0 && joint.home != joint.q) addNumbers("home", joint.home);
    if (!joint.active) add("joint_active", false);
    if (joint.stable) add("joint_stable", true);
    if (joint.sample_uniform != 0.) add("sampleUniform", joint.sample_uniform);
    if (joint.sample_deviation != .01) add("sampleSdv", joint.sample_deviation);
  }

  void addShape(const Shape& shape) {
    if (const auto owner = owners_.find(&shape); owner != owners_.end() && owner->second != &frame_) {
      add("mimic_shape", nameOf(*owner->second));
      return;
    }
    const Geometry& geometry = *shape.geometry;
    if (geometry.type != ShapeType::none) add("shape", shapeTypeName(geometry.type));
    if (!geometry.size.empty()) addNumbers("size", geometry.size);
    if (shape.color) {
      addNumbers("color", (*shape.color)[3] == 1. ? std::vector<double>(shape.color->begin(), shape.color->begin() + 3)
                                                  : std::vector<double>(shape.color->begin(), shape.color->end()));
    }
    if (geometry.mesh) addMesh(geometry);
    addTexture(shape);
    if (geometry.grid) {
      addNumbers("grid_cells", geometry.grid->cells);
      addNumbers("grid_values", geometry.grid->values);
    }
    if (shape.contact != 0) add("contact", double(shape.contact));
    if (!shape.visual_mesh.empty()) add("visual_mesh", fileReference("visual_mesh", shape.visual_mesh));
    addPoseNumbers("visual_pose", shape.visual_pose);
  }

  /// Also for meshes without a file, if a single picture with a file covers the whole mesh.
  void addTexture(const Shape& shape) {
    const Mesh* mesh = shape.geometry->mesh.get();
    std::shared_ptr<const Image> image = shape.texture;
    const bool own = mesh && shape.geometry->mesh_file.empty();
    if (!image && own && mesh->textures.size() == 1 && mesh->textures[0].count == mesh->triangles.size())
      image = mesh->textures[0].image;
    if (image && !image->path.empty()) add("texture", fileReference("texture", image->path));
    if (shape.texture_repeat != std::array{1., 1.}) addNumbers("texture_repeat", shape.texture_repeat);
    if (!mesh || mesh->texcoords.empty() || !(own || frame_.attributes->find("texcoords"))) return;
    std::vector<double> numbers;
    for (const auto& uv : mesh->texcoords) numbers.insert(numbers.end(), uv.begin(), uv.end());
    addNumbers("texcoords", numbers);
  }

  void addExclusions() {
    StringArray names;
    for (const FrameData* other : frame_.no_contact) names.push_back(nameOf(*other));
    if (!names.empty()) add("contact_exclude", std::move(names));
  }

  /// The original path if it does not depend on the scene's folder, else the absolute path.
  AngleText fileReference(const char* key, const std::string& path) const {
    const Node* node = frame_.attributes->find(key);
    const AngleText* given = node ? node->value.as<AngleText>() : nullptr;
    const bool portable = given && given->text.starts_with("package://") && resolvePath(given->text, "") == path;
    return portable ? *given : AngleText{path};
  }

  void addMesh(const Geometry& geometry) {
    if (!geometry.mesh_file.empty()) {
      add("mesh", fileReference("mesh", geometry.mesh_file));
      if (geometry.mesh_scale != Vector3d::Ones()) addNumbers("meshscale", geometry.mesh_scale);
      return;
    }
    const Mesh& mesh = *geometry.mesh;
    std::vector<double> numbers;
    for (const Vector3d& p : mesh.vertices) numbers.insert(numbers.end(), p.begin(), p.end());
    addNumbers(geometry.type == ShapeType::ssCvx ? "core" : "vertices", numbers);
    numbers.clear();
    for (const auto& triangle : mesh.triangles) numbers.insert(numbers.end(), triangle.begin(), triangle.end());
    if (!numbers.empty()) addNumbers("triangles", numbers);
    numbers.clear();
    for (const auto& color : mesh.colors) numbers.insert(numbers.end(), color.begin(), color.end());
    if (!numbers.empty()) addNumbers("vertex_colors", numbers);
    if (!mesh.parts.empty()) addNumbers("mesh_parts", mesh.parts);
  }

  void addInertia(const Inertia& inertia) {
    const Matrix3d& m = inertia.matrix;
    add("mass", inertia.mass);
    addNumbers("com", inertia.com);
    if (m != m.transpose()) {
      addNumbers("inertia",
                 std::vector<double>{m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2)});
    } else if (m.isDiagonal(0.)) {
      addNumbers("inertia", Vector3d(m.diagonal()));
    } else {
      addNumbers("inertia", std::vector<double>{m(0, 0), m(0, 1), m(0, 2), m(1, 1), m(1, 2), m(2, 2)});
    }
  }

  void addFreeAttributes() {
    static const std::set<std::string> interpreted = {"X",
                                                      "Q",
                                                      "pose",
                                                      "rel",
                                                      "joint",
                                                      "q",
                                                      "home",
                                                      "limits",
                                                      "ctrl_H",
                                                      "joint_scale",
                                                      "axis",
                                                      "mimic",
                                                      "pre",
                                                      "origin",
                                                      "post",
                                                      "A",
                                                      "B",
                                                      "from",
                                                      "to",
                                                      "BinvA",
                                                      "joint_active",
                                                      "joint_stable",
                                                      "sampleUniform",
                                                      "sampleSdv",
                                                      "shape",
                                                      "type",
                                                      "size",
                                                      "color",
                                                      "mesh",
                                                      "meshscale",
                                                      "core",
                                                      "vertices",
                                                      "triangles",
                                                      "vertex_colors",
                                                      "mesh_parts",
                                                      "grid_cells",
                                                      "grid_values",
                                                      "texcoords",
                                                      "texture_repeat",
                                                      "mimic_shape",
                                                      "contact",
                                                      "contact_exclude",
                                                      "mass",
                                                      "inertia",
                                                      "com",
                                                      "visual_mesh",
                                                      "visual_pose",
                                                      "parent"};
    static const std::set<std::string> mesh_sources = {"mesh_decomp", "mesh_points", "mesh_rope"};
    for (const Node& node : frame_.attributes->nodes) {
      const bool unresolved = node.key == "visual_mesh" && frame_.shape && frame_.shape->visual_mesh.empty();
      if (node.key == "texture" && frame_.shape && frame_.shape->texture && !frame_.shape->texture->path.empty())
        continue;
      if (node.key.starts_with("%") || (interpreted.contains(node.key) && !unresolved)) continue;
      if (mesh_sources.contains(node.key) && frame_.shape && frame_.shape->geometry->mesh) continue;
      if (node.key == "sdf" && frame_.shape && frame_.shape->geometry->grid) continue;
      graph_.nodes.push_back(node);
    }
  }

  const FrameData& frame_;
  const Names& names_;
  const ShapeOwners& owners_;
  Graph graph_;
};

ShapeOwners sharedShapes(const SceneTree& scene) {
  ShapeOwners first, shared;
  for (const auto& frame : scene.frames()) {
    if (!frame->shape) continue;
    const auto [owner, is_first] = first.emplace(frame->shape.get(), frame.get());
    if (!is_first) shared.insert(*owner);
  }
  return shared;
}

/// Frames referred to by name.
std::set<const FrameData*> referredTo(const SceneTree& scene, const ShapeOwners& owners) {
  std::set<const FrameData*> frames;
  for (const auto& frame : scene.frames()) {
    if (frame->parent) frames.insert(frame->parent);
    if (frame->joint && frame->joint->mimic) frames.insert(frame->joint->mimic);
    frames.insert(frame->no_contact.begin(), frame->no_contact.end());
  }
  for (const auto& [shape, owner] : owners) frames.insert(owner);
  return frames;
}

/// `name`, or the closest name that a text can contain.
std::string expressible(std::string name, NameRule rule) {
  static const std::set<std::string> keywords = {"Include", "Prefix", "Edit",  "Delete", "DeleteBranch",
                                                 "ChDir",   "Quit",   "shape", "joint"};
  const std::string impossible = rule == NameRule::plain ? " \t\r\n(),\"'`:;[]{}<>=!~#%@&*?|\\" : " \t\r\n(),\"'";
  for (char& c : name) {
    if (impossible.find(c) != std::string::npos) c = '_';
  }
  return keywords.contains(name) ? name + "_" : name;
}

Names namesFor(const SceneTree& scene, const ShapeOwners& owners, NameRule rule, std::vector<std::string>* warnings) {
  const std::set<const FrameData*> referred = referredTo(scene, owners);
  std::set<std::string> taken, reserved;
  for (const auto& frame : scene.frames()) reserved.insert(expressible(frame->name, rule));
  Names names;
  std::vector<std::string> renamed;
  for (const auto& frame : scene.frames()) {
    std::string name = expressible(frame->name, rule);
    const bool must_be_unique = rule != NameRule::repeated || referred.contains(frame.get());
    if (must_be_unique && (name.empty() || taken.contains(name))) {
      const std::string stem = name.empty() ? "frame" : name;
      for (int number = 2; reserved.contains(name) || name.empty(); ++number) name = cat(stem, "_", number);
      reserved.insert(name);
    }
    taken.insert(name);
    if (name != frame->name) renamed.push_back(cat("'", frame->name, "' (frame ", frame->id, ") as '", name, "'"));
    names[frame.get()] = std::move(name);
  }
  if (warnings && !renamed.empty()) {
    const std::size_t rest = renamed.size() - std::min<std::size_t>(renamed.size(), 5);
    renamed.resize(renamed.size() - rest);
    warnings->push_back(cat("names that are duplicate or not expressible in the text are changed: ", join(renamed),
                            rest > 0 ? cat(" and ", rest, " more") : ""));
  }
  return names;
}

}  // namespace

Graph describeFrame(const FrameData& frame) { return FrameDescription(frame, {}, {}).describe(); }

Graph describeScene(const Config& config, NameRule rule, std::vector<std::string>* warnings) {
  const SceneTree& scene = *config.scene();
  const ShapeOwners owners = sharedShapes(scene);
  const Names names = namesFor(scene, owners, rule, warnings);
  Graph graph;
  for (const auto& frame : scene.frames()) {
    Node node;
    node.key = names.at(frame.get());
    if (frame->parent) node.parents = {names.at(frame->parent)};
    node.value.data = FrameDescription(*frame, names, owners).describe();
    graph.nodes.push_back(std::move(node));
  }
  return graph;
}

std::string writeScene(const Config& config, std::vector<std::string>* warnings) {
  return writeFile(describeScene(config, NameRule::repeated, warnings));
}

}  // namespace kinegraph
