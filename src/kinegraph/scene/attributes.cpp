#include "kinegraph/scene/attributes.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/text.h"
#include "kinegraph/geometry/mass.h"
#include "kinegraph/geometry/mesh_file.h"
#include "kinegraph/geometry/shape_types.h"
#include "kinegraph/scene/reader.h"
#include "kinegraph/scene/scene_source.h"

namespace kinegraph {

namespace {

/// Attributes that mean something here or elsewhere in the library; a near miss of one of them is worth a warning.
const std::vector<std::string>& knownAttributes() {
  static const std::vector<std::string> known = {
      "X", "Q", "pose", "rel", "joint", "q", "limits", "ctrl_limits", "ctrl_H", "joint_scale", "axis", "mimic", "pre", "post", "A", "B",
      "from", "to", "BinvA", "joint_active", "joint_stable", "sampleUniform", "sampleSdv", "shape", "type", "size", "color", "mesh",
      "meshscale", "mesh_decomp", "mesh_points", "mesh_rope", "core", "sdf", "texture", "aruco_id", "mimic_shape", "contact", "mass",
      "inertia", "com", "visual_mesh", "visual_pose", "logical", "multibody", "multibody_fixedBase", "multibody_gravity", "simulate",
      "friction", "restitution", "motorKp", "motorKd", "motorLambda", "motorMass", "gains", "drive", "noMotor", "angularDamping",
      "focalLength", "fxycxy", "orthoAbsHeight", "heightAngle", "heightAbs", "zRange", "width", "height", "label", "part", "visual",
      "noVisual", "franka", "parent"};
  return known;
}

}  // namespace

AttributeReader::AttributeReader(const Graph& attributes, const std::string& folder, const std::string& frame_name,
                                 const SourcePosition& where, std::vector<ParseError>& errors,
                                 std::vector<std::string>& warnings)
    : attributes_(attributes), folder_(folder), frame_name_(frame_name), where_(where), errors_(errors), warnings_(warnings) {}

const Node* AttributeReader::find(std::initializer_list<const char*> keys) const {
  for (const char* key : keys) {
    if (const Node* node = attributes_.find(key)) return node;
  }
  return nullptr;
}

void AttributeReader::error(const Node& node, const std::string& message) {
  const SourcePosition& where = node.value.where.known() ? node.value.where : node.where;
  errors_.emplace_back(where, cat("frame '", frame_name_, "', ", node.key, ": ", message));
}

template <class Function>
void AttributeReader::guarded(const Node& node, Function function) {
  try {
    function();
  } catch (const ParseError& e) {
    error(node, e.reason());
  } catch (const Error& e) {
    error(node, e.what());
  }
}

std::optional<double> AttributeReader::number(const Node& node) {
  if (const double* x = node.value.as<double>()) return *x;
  if (const bool* b = node.value.as<bool>()) return *b ? 1. : 0.;
  const NumberArray* array = node.value.as<NumberArray>();
  if (array && array->numbers.size() == 1) return array->numbers[0];
  error(node, cat("expected a number, got ", describe(node.value)));
  return std::nullopt;
}

std::optional<std::vector<double>> AttributeReader::numbers(const Node& node) {
  if (const NumberArray* array = node.value.as<NumberArray>()) return array->numbers;
  if (const double* x = node.value.as<double>()) return std::vector<double>{*x};
  if (const StringArray* words = node.value.as<StringArray>(); words && words->empty()) return std::vector<double>{};
  error(node, cat("expected numbers [..], got ", describe(node.value)));
  return std::nullopt;
}

std::optional<std::string> AttributeReader::text(const Node& node) {
  if (const std::string* word = node.value.as<std::string>()) return *word;
  if (const NameTuple* tuple = node.value.as<NameTuple>(); tuple && tuple->names.size() == 1) return tuple->names[0];
  error(node, cat("expected a word, got ", describe(node.value)));
  return std::nullopt;
}

std::string AttributeReader::path(const Node& node) {
  if (const AngleText* angle = node.value.as<AngleText>()) return resolvePath(angle->text, folder_);
  if (const std::string* word = node.value.as<std::string>()) return resolvePath(*word, folder_);
  error(node, cat("expected a file <path>, got ", describe(node.value)));
  return "";
}

std::optional<Pose> AttributeReader::readPose(std::initializer_list<const char*> keys) {
  const Node* node = find(keys);
  if (!node) return std::nullopt;
  std::optional<Pose> pose;
  guarded(*node, [&] {
    if (const AngleText* angle = node->value.as<AngleText>()) {
      pose = parsePose(angle->text);
    } else if (const std::string* word = node->value.as<std::string>()) {
      pose = parsePose(*word);
    } else if (const auto list = numbers(*node)) {
      pose = list->empty() ? Pose() : Pose::fromNumbers(Eigen::Map<const VectorXd>(list->data(), Eigen::Index(list->size())));
    }
  });
  return pose;
}

std::optional<Joint> AttributeReader::readJoint() {
  const Node* node = find({"joint"});
  if (!node) return std::nullopt;
  std::optional<Joint> joint;
  guarded(*node, [&] {
    if (const double* code = node->value.as<double>()) {
      if (*code != 0.) joint = Joint(JointType(int(*code)));
      return;
    }
    const auto word = text(*node);
    if (!word || *word == "none" || *word == "JT_none") return;
    joint = word->starts_with("_") ? Joint(JointType::generic, word->substr(1)) : Joint(jointTypeFromName(*word));
  });
  if (!joint) return std::nullopt;
  const std::size_t dofs = std::size_t(joint->dofs());
  if (const Node* scale = find({"joint_scale"})) joint->scale = number(*scale).value_or(1.);
  if (const Node* axis = find({"axis"})) {
    const auto v = numbers(*axis);
    const Vector3d direction = v && v->size() == 3 ? Vector3d((*v)[0], (*v)[1], (*v)[2]) : Vector3d::Zero().eval();
    if (joint->type != JointType::hinge) {
      error(*axis, cat("only a joint of type hinge has an axis, not ", jointTypeName(joint->type)));
    } else if (!(direction.norm() > 1e-10)) {
      error(*axis, "expected 3 numbers that are not all zero");
    } else {
      joint->axis = direction.normalized();
    }
  }
  if (const Node* limits = find({"limits"}); limits && dofs > 0) {
    if (const auto v = numbers(*limits)) {
      if (v->size() < 2 * dofs) {
        error(*limits, cat("a ", jointTypeName(joint->type), " joint has ", 2 * dofs, " limits (all lower, then all upper), got ", v->size()));
      } else {
        joint->lower = Eigen::Map<const VectorXd>(v->data(), Eigen::Index(dofs));
        joint->upper = Eigen::Map<const VectorXd>(v->data() + dofs, Eigen::Index(dofs));
        if ((joint->lower.array() > joint->upper.array()).any()) error(*limits, "a lower limit is above its upper limit");
      }
    }
  }
  if (const Node* q = find({"q"}); q && dofs > 0) {
    if (const auto v = numbers(*q)) {
      if (v->size() == 1) {
        joint->q.setConstant(v->front());
      } else if (v->size() == dofs) {
        joint->q = Eigen::Map<const VectorXd>(v->data(), Eigen::Index(dofs));
      } else {
        error(*q, cat("a ", jointTypeName(joint->type), " joint has ", dofs, " dofs, got ", v->size(), " numbers"));
      }
      joint->home = joint->q;
    }
  }
  if (const Node* weight = find({"ctrl_H"})) joint->control_weight = number(*weight).value_or(1.);
  if (const Node* active = find({"joint_active"})) joint->active = number(*active).value_or(1.) != 0.;
  if (const Node* stable = find({"joint_stable"})) joint->stable = number(*stable).value_or(0.) != 0.;
  if (const Node* uniform = find({"sampleUniform"})) joint->sample_uniform = number(*uniform).value_or(0.);
  if (const Node* deviation = find({"sampleSdv"})) joint->sample_deviation = number(*deviation).value_or(.01);
  return joint;
}

void AttributeReader::apply(FrameData& frame, bool joint_keys) {
  if (joint_keys) {
    const std::optional<Joint> joint = readJoint();
    if (joint && !frame.parent) {
      error(*find({"joint"}), "a frame without a parent cannot have a joint; write 'name (parent): { ... }'");
    } else if (joint) {
      frame.joint = joint;
    } else if (find({"joint"})) {
      frame.joint.reset();
    }
    applyPose(frame);
  }
  applyShape(frame);
  applyInertia(frame);
  checkSpelling();
}

void AttributeReader::applyPose(FrameData& frame) {
  const auto world = readPose({"X"}), relative = readPose({"Q", "rel"}), pose = readPose({"pose"});
  if (!frame.parent) {
    if (const Node* node = find({"Q", "rel"}); node && relative && !relative->isIdentity(0.)) {
      error(*node, "a frame without a parent has no relative pose; use X or pose");
    }
    if (world) frame.pose = *world;
    if (pose) frame.pose = *pose;
    return;
  }
  std::optional<Pose> target = pose ? pose : relative;
  if (!target && world) target = frame.parent->worldPose().inverse() * *world;
  if (!target) return;
  if (!frame.moves()) {
    frame.pose = *target;
    return;
  }
  Joint& joint = *frame.joint;
  if (find({"q"}) || joint.mimic) return;
  joint.q = joint.home = motionProject(joint.steps, joint.axis, joint.scale, *target);
  const Pose reached = motionPose(joint.steps, joint.axis, joint.scale, joint.q.data());
  if (!(reached.inverse() * *target).isIdentity(1e-6)) {
    const Node& node = *find({"pose", "Q", "rel", "X"});
    warnings_.push_back(cat(node.where.str(), ": frame '", frame_name_, "': its ", jointTypeName(joint.type),
                            " joint cannot reach the pose given by ", node.key, " and takes the nearest; a constant offset belongs in 'pre'"));
  }
}

std::shared_ptr<Geometry> AttributeReader::readGeometry() {
  auto geometry = std::make_shared<Geometry>();
  const Node* shape = find({"shape", "type"});
  const Node* mesh = find({"mesh"});
  if (shape) {
    bool understood = false;
    guarded(*shape, [&] {
      if (const double* code = shape->value.as<double>()) {
        geometry->type = ShapeType(int(*code));
        shapeTypeName(geometry->type);
      } else if (const auto word = text(*shape)) {
        geometry->type = shapeTypeFromName(*word);
      } else {
        return;
      }
      understood = true;
    });
    if (!understood) return nullptr;
  }
  if (mesh) {
    geometry->type = shape && geometry->type == ShapeType::pointCloud ? ShapeType::pointCloud : ShapeType::mesh;
    guarded(*mesh, [&] {
      Mesh points = readMeshFile(path(*mesh));
      if (const Node* scale = find({"meshscale"})) {
        const auto s = numbers(*scale).value_or(std::vector<double>{1.});
        if (s.size() != 1 && s.size() != 3) error(*scale, "expected 1 or 3 numbers");
        for (Vector3d& p : points.vertices) p = p.cwiseProduct(s.size() == 3 ? Vector3d(s[0], s[1], s[2]) : Vector3d::Constant(s.at(0)).eval());
      }
      geometry->mesh = std::make_shared<Mesh>(std::move(points));
    });
  }
  if (const Node* core = find({"core"}); core && geometry->type == ShapeType::ssCvx) {
    const auto v = numbers(*core);
    if (v && v->size() >= 3 && v->size() % 3 == 0) {
      Mesh points;
      for (std::size_t i = 0; i < v->size(); i += 3) points.vertices.emplace_back((*v)[i], (*v)[i + 1], (*v)[i + 2]);
      geometry->mesh = std::make_shared<Mesh>(std::move(points));
    } else if (v) {
      error(*core, cat("expected n x 3 numbers, got ", v->size()));
    }
  }
  const Node* size = find({"size"});
  const auto given = size ? numbers(*size).value_or(std::vector<double>{}) : std::vector<double>{};
  std::string warning;
  bool sized = false;
  guarded(size ? *size : *(shape ? shape : mesh), [&] {
    geometry->size = checkedSize(geometry->type, given, &warning);
    sized = true;
  });
  if (!warning.empty()) warnings_.push_back(cat(size->where.str(), ": frame '", frame_name_, "': ", warning));
  return sized ? geometry : nullptr;
}

void AttributeReader::applyShape(FrameData& frame) {
  if (find({"shape", "type", "mesh"})) {
    const std::shared_ptr<Geometry> geometry = readGeometry();
    if (!geometry) return;
    frame.shape = std::make_shared<Shape>();
    frame.shape->geometry = geometry;
    frame.tree->looksChanged(*frame.shape);
  }
  if (!frame.shape) return;
  if (const Node* color = find({"color"})) {
    if (const auto c = numbers(*color)) {
      switch (c->size()) {
        case 1: frame.shape->color = Vector4d((*c)[0], (*c)[0], (*c)[0], 1.); break;
        case 2: frame.shape->color = Vector4d((*c)[0], (*c)[0], (*c)[0], (*c)[1]); break;
        case 3: frame.shape->color = Vector4d((*c)[0], (*c)[1], (*c)[2], 1.); break;
        case 4: frame.shape->color = Vector4d((*c)[0], (*c)[1], (*c)[2], (*c)[3]); break;
        default: error(*color, cat("expected 1 (grey), 2 (grey alpha), 3 (rgb) or 4 (rgba) numbers, got ", c->size()));
      }
    }
  }
  if (const Node* contact = find({"contact"})) frame.shape->contact = int(number(*contact).value_or(0.));
  if (const Node* mesh = find({"visual_mesh"})) frame.shape->visual_mesh = path(*mesh);
  if (const auto pose = readPose({"visual_pose"})) frame.shape->visual_pose = *pose;
}

void AttributeReader::applyInertia(FrameData& frame) {
  const Node* mass = find({"mass"});
  if (!mass) return;
  const auto kilograms = number(*mass);
  if (!kilograms) return;
  Inertia inertia;
  inertia.mass = *kilograms;
  guarded(*mass, [&] {
    const bool solid = frame.shape && frame.shape->geometry->type != ShapeType::marker;
    const ShellMass shell = solid ? shellMass(*frame.shape->geometry) : ShellMass{};
    if (solid && inertia.mass <= 0.) inertia.mass = 5. * shell.area;
    inertia.com = shell.com;
    inertia.matrix = inertia.mass * (solid ? shell.inertia_per_mass : Matrix3d(1e-4 * Matrix3d::Identity()));
    if (const Node* node = find({"inertia"})) {
      const auto m = numbers(*node).value_or(std::vector<double>{});
      if (m.size() == 3) {
        inertia.matrix = Vector3d(m[0], m[1], m[2]).asDiagonal();
      } else if (m.size() == 6) {
        inertia.matrix << m[0], m[1], m[2], m[1], m[3], m[4], m[2], m[4], m[5];
      } else if (m.size() == 9) {
        inertia.matrix = Eigen::Map<const Matrix3d>(m.data()).transpose();
      } else {
        error(*node, cat("expected 3 (diagonal), 6 (xx xy xz yy yz zz) or 9 numbers, got ", m.size()));
      }
    }
    if (const Node* node = find({"com"})) {
      const auto c = numbers(*node).value_or(std::vector<double>{});
      if (c.size() == 3) {
        inertia.com << c[0], c[1], c[2];
      } else {
        error(*node, cat("expected 3 numbers, got ", c.size()));
      }
    }
  });
  frame.inertia = inertia;
}

void AttributeReader::checkSpelling() {
  for (const Node& node : attributes_.nodes) {
    const auto& known = knownAttributes();
    if (node.key.size() < 4 || std::find(known.begin(), known.end(), node.key) != known.end()) continue;
    for (const std::string& word : known) {
      if (word.size() < 4 || editDistance(node.key, word) > 1.2) continue;
      warnings_.push_back(cat(node.where.str(), ": frame '", frame_name_, "': unknown attribute '", node.key, "'; did you mean '", word, "'?"));
      break;
    }
  }
}

}  // namespace kinegraph
