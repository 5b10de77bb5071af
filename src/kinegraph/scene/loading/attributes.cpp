#include "kinegraph/scene/loading/attributes.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <string_view>
#include <utility>

#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/mass.h"
#include "kinegraph/scene/loading/reader.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

namespace {

// clang-format off
/// Attributes used by any part of the library; a near miss of one of them causes a warning.
constexpr std::string_view kKnownAttributes[] = {
    "X", "Q", "pose", "rel", "joint", "q", "limits", "ctrl_limits", "ctrl_H", "joint_scale", "axis", "mimic", "pre",
    "post", "A", "B", "from", "to", "origin", "BinvA", "joint_active", "joint_stable", "sampleUniform", "sampleSdv",
    "shape", "type", "size", "color", "mesh", "meshscale", "mesh_decomp", "mesh_points", "mesh_rope", "core", "sdf",
    "texture", "texcoords", "texture_repeat", "aruco_id", "mimic_shape", "contact", "mass", "inertia", "com", "visual_mesh", "visual_pose",
    "logical", "multibody", "multibody_fixedBase", "multibody_gravity", "simulate", "friction", "restitution",
    "motorKp", "motorKd", "motorDampingRatio", "motorLambda", "motorMass", "gains", "servo", "noMotor", "angularDamping", "focalLength",
    "fxycxy", "orthoAbsHeight", "heightAngle", "heightAbs", "zRange", "width", "height", "label", "part", "visual",
    "noVisual", "franka", "parent", "home", "contact_exclude", "vertices", "triangles", "vertex_colors",
    "joint_groups", "joint_states", "actuators", "mesh_parts", "grid_cells", "grid_values",
    "jointFriction", "armature", "springStiffness", "springReference", "gravityCompensation", "torsionalFriction",
    "rollingFriction", "frictionRule", "surfaceVelocity",
};
// clang-format on

/// Attribute names of other formats, with the name used here.
constexpr std::pair<std::string_view, std::string_view> kForeignNames[] = {
    {"pos", "pose"},        {"position", "pose"}, {"xyz", "pose"},  {"rpy", "pose"},       {"quat", "pose"},
    {"quaternion", "pose"}, {"rgba", "color"},    {"rgb", "color"}, {"geometry", "shape"}, {"filename", "mesh"}};

constexpr double kLeastJudgedMass = 1e-3;  ///< kg: markers in robot files have tiny masses and any inertia
constexpr double kPointInertia = 1e-12;    // m^2, per mass: that of a body of a micrometer
constexpr double kRounding = .01;          ///< share of the largest moment by which rounded numbers may miss the rule

bool isKnown(const std::string& key) {
  return std::any_of(std::begin(kKnownAttributes), std::end(kKnownAttributes),
                     [&](std::string_view word) { return key == word; });
}

/// Whether a word of three letters lacks one letter of a word of four: `mas`.
bool lacksOneLetter(std::string_view key, std::string_view word) {
  return key.size() == 3 && word.size() == 4 && isWithinEditDistance(key, word, 1.);
}

}  // namespace

std::string askAboutAttribute(const Node& node) {
  if (isKnown(node.key)) return "";
  const auto ask = [&](std::string_view word) {
    return cat("unknown attribute '", node.key, "'; did you mean '", word, "'?");
  };
  for (const auto& [foreign, word] : kForeignNames)
    if (foreign == node.key) return ask(word);
  if (node.value.as<Graph>()) return "";
  for (const std::string_view word : kKnownAttributes) {
    const bool is_near = node.key.size() >= 4 && word.size() >= 4 && isWithinEditDistance(node.key, word, 1.2);
    if (is_near || lacksOneLetter(node.key, word)) return ask(word);
  }
  return "";
}

const Node* AttributeReader::find(std::initializer_list<const char*> keys) const {
  for (const char* key : keys) {
    if (const Node* node = attributes_.find(key)) return node;
  }
  return nullptr;
}

void AttributeReader::error(const Node& node, const std::string& message) {
  const SourcePosition& where = node.value.where.known() ? node.value.where : node.where;
  diagnostics_.error(where, cat("frame '", frame_name_, "', ", node.key, ": ", message));
}

void AttributeReader::warning(const Node& node, const std::string& message) {
  diagnostics_.warning(node.where, cat("frame '", frame_name_, "': ", message));
}

std::optional<double> AttributeReader::number(const Node& node) {
  if (const double* x = node.value.as<double>()) return *x;
  if (const bool* b = node.value.as<bool>()) return *b ? 1. : 0.;
  const NumberArray* array = node.value.as<NumberArray>();
  if (array && array->numbers.size() == 1) return array->numbers[0];
  error(node, cat("expected a number, got ", describe(node.value)));
  return std::nullopt;
}

double AttributeReader::numberOr(const char* key, double otherwise) {
  const Node* node = find({key});
  return node ? number(*node).value_or(otherwise) : otherwise;
}

std::optional<std::vector<double>> AttributeReader::numbers(const Node& node) {
  if (const NumberArray* array = node.value.as<NumberArray>()) return array->numbers;
  if (const double* x = node.value.as<double>()) return std::vector<double>{*x};
  if (const StringArray* strings = node.value.as<StringArray>(); strings && strings->empty())
    return std::vector<double>{};
  error(node,
        cat("expected numbers", node.key == "color" ? " [r g b] in 0..1" : " [..]", ", got ", describe(node.value)));
  return std::nullopt;
}

/// `size: 1 2 3` parses as the number 1 followed by flags.
std::string AttributeReader::bracketHint(const Node& node) {
  return node.value.as<double>() ? "; write several numbers in brackets: [1 2 3]" : "";
}

std::optional<Vector3d> AttributeReader::vector3(const Node& node) {
  const auto v = numbers(node);
  if (!v) return std::nullopt;
  if (v->size() == 3) return Vector3d((*v)[0], (*v)[1], (*v)[2]);
  error(node, cat("expected 3 numbers, got ", v->size()));
  return std::nullopt;
}

std::optional<std::string> AttributeReader::text(const Node& node) {
  if (const std::string* word = node.value.as<std::string>()) return *word;
  if (const NameTuple* tuple = node.value.as<NameTuple>(); tuple && tuple->names.size() == 1) return tuple->names[0];
  error(node, cat("expected a name, got ", describe(node.value)));
  return std::nullopt;
}

std::string AttributeReader::pathText(const Node& node) {
  if (const AngleText* angle = node.value.as<AngleText>()) return angle->text;
  if (const std::string* word = node.value.as<std::string>(); word && !word->empty()) return *word;
  throw ValueError(cat("expected a file <path>, got ", describe(node.value)));
}

std::string AttributeReader::path(const Node& node) {
  const std::string given = pathText(node), absolute = resolvePath(given, folder_);
  if (!absolute.empty()) return absolute;
  throw FileError(missingPackageMessage(given));
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
      if (node->value.as<double>()) throw ValueError(cat("expected a pose, got a single number", bracketHint(*node)));
      pose = list->empty() ? Pose()
                           : Pose::fromNumbers(Eigen::Map<const VectorXd>(list->data(), Eigen::Index(list->size())));
    }
  });
  return pose;
}

void AttributeReader::applyPose(FrameData& frame) {
  const auto world = readPose({"X"}), relative = readPose({"Q", "rel"}), pose = readPose({"pose"});
  if (!frame.parent) {
    if (const Node* node = find({"Q", "rel"}); node && relative && !relative->isIdentity(0.)) {
      error(*node, cat("a frame without a parent has no relative pose; write 'name (parent): { ... }', or ", node->key,
                       " as X"));
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
  if (find({"q", "mimic"})) return;
  joint.q = joint.home = motionProject(joint.steps, joint.axis, joint.scale, *target);
  const Pose reached = motionPose(joint.steps, joint.axis, joint.scale, joint.q.data());
  if ((reached.inverse() * *target).isIdentity(1e-6)) return;
  const Node& node = *find({"pose", "Q", "rel", "X"});
  warning(node, cat("its ", jointTypeName(joint.type), " joint cannot reach the pose given by ", node.key,
                    " and takes the nearest; a constant offset belongs in 'pre'"));
}

void AttributeReader::applyBody(FrameData& frame) {
  applyShape(frame);
  applyInertia(frame);
  checkSpelling();
}

void AttributeReader::applyInertia(FrameData& frame) {
  const Node* mass = find({"mass"});
  if (!mass) return;
  const auto kilograms = number(*mass);
  if (!kilograms) return;
  if (!std::isfinite(*kilograms)) return error(*mass, "a mass is a finite number of kg");
  Inertia inertia;
  inertia.mass = *kilograms;
  guarded(*mass, [&] {
    const bool solid = frame.shape && frame.shape->geometry->type != ShapeType::marker;
    const bool all_given = inertia.mass > 0. && find({"inertia"}) && find({"com"});
    const ShellMass shell = solid && !all_given ? shellMass(*frame.shape->geometry) : ShellMass{};
    if (solid && inertia.mass <= 0.) inertia.mass = 5. * shell.area;
    inertia.com = shell.com;
    inertia.matrix = inertia.mass * (solid ? shell.inertia_per_mass : Matrix3d(1e-4 * Matrix3d::Identity()));
  });
  const Matrix3d of_shape = inertia.matrix;
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
    if (!inertia.matrix.allFinite()) return error(*node, "an inertia has finite numbers, in kg m^2");
    // Three zeros are a point mass on purpose; the readers of URDF and MJCF give six numbers.
    if (m.size() != 3 || !inertia.matrix.isZero(0.)) judgeInertia(*node, inertia, of_shape);
  }
  if (const Node* node = find({"com"})) inertia.com = vector3(*node).value_or(inertia.com);
  frame.inertia = inertia;
}

/// Warns of an inertia that no body has. A negative one is replaced; others are kept, as Pinocchio does.
void AttributeReader::judgeInertia(const Node& node, Inertia& inertia, const Matrix3d& otherwise) {
  if (inertia.mass < kLeastJudgedMass) return;
  const Vector3d moments =
      Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia.matrix, Eigen::EigenvaluesOnly).eigenvalues();
  const std::string listed = cat(moments[0], ", ", moments[1], ", ", moments[2], " kg m^2");
  const double largest = moments[2], rounding = kPointInertia * inertia.mass;
  if (moments[0] < -std::max(1e-6 * std::abs(largest), rounding)) {
    inertia.matrix = otherwise;
    warning(node, cat("its inertia has a negative principal moment (", listed, "); it is left out, and the mass of ",
                      inertia.mass, " kg alone counts"));
  } else if (largest <= rounding) {
    inertia.matrix.setZero();
    warning(node, cat("its inertia is zero although its mass is ", inertia.mass,
                      " kg; it is read as a point mass at its center of mass, which MuJoCo refuses"));
  } else if (moments[0] + moments[1] < (1. - kRounding) * largest) {
    warning(node, cat("its principal moments of inertia (", listed,
                      ") are impossible: one exceeds the sum of the other two; they are kept for the dynamics, and a"
                      " simulation uses their mean for all three"));
  }
}

void AttributeReader::checkSpelling() {
  for (const Node& node : attributes_.nodes) {
    const bool is_known = isKnown(node.key);
    if (is_known && attributes_.find(node.key) != &node) {
      warning(node, cat("'", node.key, "' is given twice; the first counts"));
    }
    if (!node.parents.empty()) {
      warning(node, cat("'", node.key, " (", join(node.parents, " "),
                        ")' is inside of this frame, and no frame; is a '}' missing before it?"));
    }
    if (is_known) continue;
    if (const std::string question = askAboutAttribute(node); !question.empty()) warning(node, question);
  }
}

}  // namespace kinegraph::inline scene_internal
