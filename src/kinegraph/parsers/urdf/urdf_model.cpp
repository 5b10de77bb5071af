#include "kinegraph/parsers/urdf/urdf_model.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <numbers>

#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"
#include "kinegraph/parsers/urdf/urdf_spelling.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

namespace {

Quaterniond rollPitchYaw(const Vector3d& rpy) {
  const auto about = [](double angle, int axis) { return Quaterniond(Eigen::AngleAxisd(angle, Vector3d::Unit(axis))); };
  return about(rpy[2], 2) * about(rpy[1], 1) * about(rpy[0], 0);
}

class UrdfParser {
 public:
  explicit UrdfParser(std::vector<Diagnostic>& found) : found_(found) {}

  UrdfModel parse(const XmlElement& robot) {
    if (robot.name != "robot") {
      error(robot.where, cat("the root of a URDF file is <robot>, not <", robot.name, ">"));
      return {};
    }
    if (const XmlAttribute* name = robot.attribute("name")) model_.name = name->value;
    askAboutSpelling(robot, found_);
    collectMaterials(robot);
    for (const XmlElement& element : robot.children) {
      if (element.name == "link") {
        readLink(element);
      } else if (element.name == "joint") {
        readJoint(element);
      } else if (element.name == "mujoco") {
        readExtension(element);
      }
    }
    if (model_.links.empty()) {
      const bool macros = std::any_of(robot.children.begin(), robot.children.end(),
                                      [](const XmlElement& child) { return child.name.starts_with("xacro:"); });
      error(robot.where, macros ? "this robot has no <link>, but macros; a file with macros ends in .xacro"
                                : "this robot has no <link>");
    }
    return std::move(model_);
  }

 private:
  /// Inside of a shape or an <inertial>, an error leaves that part out.
  void error(const SourcePosition& where, std::string message) {
    if (optional_part_) {
      part_failed_ = true;
      return warn(where, cat(message, "; the <", optional_part_, "> is left out"));
    }
    found_.push_back({Diagnostic::Severity::error, where, std::move(message)});
  }
  void warn(const SourcePosition& where, std::string message) {
    found_.push_back({Diagnostic::Severity::warning, where, std::move(message)});
  }

  /// Materials are defined at the top of the file or at a first use, which may come after a reference.
  void collectMaterials(const XmlElement& element) {
    for (const XmlElement& child : element.children) {
      const XmlAttribute* name = child.name == "material" ? child.attribute("name") : nullptr;
      if (name && (child.child("color") || child.child("texture"))) materials_.emplace(name->value, &child);
      if (child.name == "link" || child.name == "visual") collectMaterials(child);
    }
  }

  /// MuJoCo's settings for its compiler.
  void readExtension(const XmlElement& element) {
    model_.mesh_folder.emplace();
    for (const XmlElement* compiler : element.all("compiler")) {
      if (const XmlAttribute* folder = compiler->attribute("meshdir")) model_.mesh_folder = folder->value;
    }
  }

  std::optional<std::string> text(const XmlElement& element, const char* name) {
    if (const XmlAttribute* attribute = element.attribute(name)) return attribute->value;
    error(element.where, cat(context_, "<", element.name, "> has no attribute '", name, "'"));
    return std::nullopt;
  }

  std::vector<double> numbers(const XmlAttribute& attribute, const XmlElement& element, std::size_t count) {
    const auto found = numbersIn(attribute.value);
    if (found && found->size() == count) return *found;
    const auto shown = [&] { return cat(context_, "<", element.name, "> ", attribute.name, "=\"", attribute.value); };
    if (const auto listed = numbersBetweenCommas(attribute.value); listed && listed->size() == count) {
      warn(attribute.where, cat(shown(), "\": the commas are read as blanks"));
      return *listed;
    }
    const bool is_xacro =
        attribute.value.find("$(") != std::string::npos || attribute.value.find("${") != std::string::npos;
    error(attribute.where, cat(shown(), "\": expected ", count, count == 1 ? " number" : " numbers",
                               is_xacro ? "; this is xacro: give the file a name that ends with .xacro" : ""));
    return std::vector<double>(count, 0.);
  }

  /// A number, required unless a default is given.
  double number(const XmlElement& element, const char* name, std::optional<double> fallback = std::nullopt) {
    if (const XmlAttribute* attribute = element.attribute(name)) return numbers(*attribute, element, 1)[0];
    if (!fallback) error(element.where, cat(context_, "<", element.name, "> has no attribute '", name, "'"));
    return fallback.value_or(0.);
  }

  /// A limit, 0 by default. An infinite one becomes `unlimited`, with its sign.
  double limitOf(const XmlElement& limit, const char* name, double unlimited) {
    const XmlAttribute* attribute = limit.attribute(name);
    const auto given = attribute ? limitsIn(attribute->value) : std::nullopt;
    if (given && given->size() == 1 && std::isinf(given->front())) return std::copysign(unlimited, given->front());
    return number(limit, name, 0.);
  }

  Vector3d vector(const XmlElement& element, const char* name, const Vector3d& fallback) {
    const XmlAttribute* attribute = element.attribute(name);
    if (!attribute) return fallback;
    const std::vector<double> v = numbers(*attribute, element, 3);
    return {v[0], v[1], v[2]};
  }

  /// Roll, pitch and yaw. Round numbers beyond a turn are asked about, once per file.
  Vector3d anglesOf(const XmlElement& origin) {
    const Vector3d rpy = vector(origin, "rpy", Vector3d::Zero());
    for (const double angle : rpy) {
      if (asked_for_radians_ || !mayBeDegrees(angle, 2. * std::numbers::pi)) continue;
      warn(origin.attribute("rpy")->where, cat(context_, "rpy has ", angle, " rad; ", askForRadians(angle)));
      asked_for_radians_ = true;
    }
    return rpy;
  }

  Pose origin(const XmlElement& element) {
    const XmlElement* origin = element.child("origin");
    if (!origin) return {};
    const Vector3d p = vector(*origin, "xyz", Vector3d::Zero());
    const XmlAttribute* const quaternion = origin->attribute("quat_xyzw");  // URDF 1.1
    if (!quaternion) return {p, rollPitchYaw(anglesOf(*origin))};
    const std::vector<double> v = numbers(*quaternion, *origin, 4);
    const Quaterniond q(v[3], v[0], v[1], v[2]);
    if (!(q.norm() > 1e-10)) {
      error(quaternion->where, cat(context_, "the quaternion of <origin> is zero"));
      return {p, Quaterniond::Identity()};
    }
    return {p, q.normalized()};
  }

  void readLink(const XmlElement& element) {
    context_.clear();
    UrdfLink link;
    link.where = element.where;
    link.name = text(element, "name").value_or("");
    context_ = cat("link '", link.name, "': ");
    for (const UrdfLink& other : model_.links) {
      if (other.name == link.name)
        error(element.where, cat("link '", link.name, "' is already defined at ", other.where.str()));
    }
    if (const XmlElement* inertial = element.child("inertial")) {
      beginPart("inertial");
      const UrdfInertial read = readInertial(*inertial);
      if (endPart()) link.inertial = read;
    }
    for (const XmlElement* visual : element.all("visual")) readShape(*visual, link);
    for (const XmlElement* collision : element.all("collision")) readShape(*collision, link);
    model_.links.push_back(std::move(link));
  }

  /// Begins a part of a link without which the robot still moves as it should.
  void beginPart(const char* name) {
    optional_part_ = name;
    part_failed_ = false;
  }
  /// Returns whether the part has no error.
  bool endPart() {
    optional_part_ = nullptr;
    return !part_failed_;
  }

  UrdfInertial readInertial(const XmlElement& element) {
    UrdfInertial inertial;
    inertial.where = element.where;
    const XmlElement* mass = element.child("mass");
    if (mass) inertial.mass = number(*mass, "value");
    if (!mass) error(element.where, cat(context_, "<inertial> has no <mass value=\"...\"/>"));
    if (inertial.mass < 0.) error(mass->where, cat(context_, "the mass ", inertial.mass, " kg is negative"));
    const Pose frame = origin(element);
    inertial.com = frame.p;
    if (const XmlElement* m = element.child("inertia")) {
      const double xx = number(*m, "ixx"), yy = number(*m, "iyy"), zz = number(*m, "izz");
      const double xy = number(*m, "ixy", 0.), xz = number(*m, "ixz", 0.), yz = number(*m, "iyz", 0.);
      Matrix3d own;
      own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
      const Matrix3d R = frame.q.toRotationMatrix();
      inertial.matrix = R * own * R.transpose();
    }
    return inertial;
  }

  void readShape(const XmlElement& element, UrdfLink& link) {
    beginPart(element.name == "visual" ? "visual" : "collision");
    UrdfShape shape = readGeometry(element);
    if (!endPart()) return;
    if (const XmlElement* material = element.child("material")) readMaterial(*material, shape);
    link.shapes.push_back(std::move(shape));
  }

  UrdfShape readGeometry(const XmlElement& element) {
    UrdfShape shape;
    shape.collision = element.name == "collision";
    shape.where = element.where;
    shape.origin = origin(element);
    const XmlElement* geometry = element.child("geometry");
    if (!geometry || geometry->children.empty()) {
      error(element.where, cat(context_, "<", element.name, "> has no <geometry> with a shape in it"));
      return shape;
    }
    const XmlElement& g = geometry->children.front();
    shape.where = g.where;
    if (g.name == "box") {
      const Vector3d size = vector(g, "size", Vector3d::Zero());
      if (!g.attribute("size")) text(g, "size");
      shape.type = ShapeType::box;
      shape.size = {size[0], size[1], size[2]};
    } else if (g.name == "sphere") {
      shape.type = ShapeType::sphere;
      shape.size = {number(g, "radius")};
    } else if (g.name == "cylinder" || g.name == "capsule") {
      shape.type = g.name == "cylinder" ? ShapeType::cylinder : ShapeType::capsule;
      shape.size = {number(g, "length"), number(g, "radius")};
    } else if (g.name == "mesh") {
      shape.type = ShapeType::mesh;
      shape.mesh = text(g, "filename").value_or("");
      if (const XmlAttribute* scale = g.attribute("scale")) shape.scale = meshScale(*scale);
    } else {
      error(g.where, cat(context_, "unknown geometry <", g.name, ">; expected box, sphere, cylinder, capsule or mesh"));
    }
    const auto is_negative = [](double x) { return x < 0.; };
    if (std::any_of(shape.size.begin(), shape.size.end(), is_negative))
      error(g.where, cat(context_, "<", g.name, "> has a negative size"));
    return shape;
  }

  /// Three factors, or one for all axes.
  Vector3d meshScale(const XmlAttribute& scale) {
    const auto given = numbersIn(scale.value);
    Vector3d factors = Vector3d::Ones();
    if (!given || given->empty()) {
      error(scale.where, cat(context_, "<mesh> scale=\"", scale.value, "\": expected 3 numbers"));
      return factors;
    }
    for (std::size_t i = 0; i < 3; ++i) factors[Eigen::Index(i)] = (*given)[std::min(i, given->size() - 1)];
    if (given->size() != 1 && given->size() != 3) {
      warn(scale.where, cat(context_, "<mesh> scale=\"", scale.value, "\": expected 3 numbers; it is read as ",
                            factors.transpose()));
    }
    if ((factors.array() == 0.).any()) error(scale.where, cat(context_, "<mesh> is scaled by 0"));
    return factors;
  }

  void readMaterial(const XmlElement& element, UrdfShape& shape) {
    const XmlElement* source = &element;
    const XmlAttribute* name = element.attribute("name");
    if (!element.child("color") && !element.child("texture") && name) {
      const auto found = materials_.find(name->value);
      if (found == materials_.end()) {
        std::vector<std::string> known;
        for (const auto& [key, material] : materials_) known.push_back(key);
        warn(name->where, cat(context_, "no material '", name->value, "'", similarHint(name->value, known)));
        return;
      }
      source = found->second;
    }
    if (const XmlElement* color = source->child("color")) {
      if (const XmlAttribute* rgba = color->attribute("rgba")) shape.color = colorIn(*rgba);
    }
    if (const XmlElement* texture = source->child("texture")) {
      if (const XmlAttribute* file = texture->attribute("filename")) shape.texture = file->value;
    }
  }

  /// Four numbers. Other counts give a warning: the alpha of three is 1, numbers behind the fourth are ignored.
  std::optional<Vector4d> colorIn(const XmlAttribute& rgba) {
    const auto given = numbersIn(rgba.value);
    const bool enough = given && given->size() >= 3;
    if (!enough || given->size() > 4) {
      warn(rgba.where, cat(context_, "<color> rgba=\"", rgba.value, "\": expected 4 numbers; ",
                           enough ? "the first 4 are read" : "the color is left out"));
    } else if (given->size() == 3) {
      warn(rgba.where, cat(context_, "<color> rgba=\"", rgba.value, "\": expected 4 numbers; the alpha is read as 1"));
    }
    if (!enough) return std::nullopt;
    return Vector4d((*given)[0], (*given)[1], (*given)[2], given->size() > 3 ? (*given)[3] : 1.);
  }

  std::optional<UrdfJointType> jointType(const XmlElement& element) {
    static const std::map<std::string, UrdfJointType> types = {
        {"fixed", UrdfJointType::fixed},           {"revolute", UrdfJointType::revolute},
        {"continuous", UrdfJointType::continuous}, {"prismatic", UrdfJointType::prismatic},
        {"planar", UrdfJointType::planar},         {"floating", UrdfJointType::floating},
        {"spherical", UrdfJointType::spherical}};
    auto word = text(element, "type");
    if (!word) return std::nullopt;
    std::string lower = *word;
    for (char& c : lower) c = char(std::tolower(static_cast<unsigned char>(c)));
    if (lower != *word && types.contains(lower)) {
      warn(element.attribute("type")->where, cat(context_, "joint type '", *word, "' is read as '", lower, "'"));
      word = lower;
    }
    if (const auto found = types.find(*word); found != types.end()) return found->second;
    std::vector<std::string> known;
    for (const auto& [name, type] : types) known.push_back(name);
    error(element.attribute("type")->where,
          cat(context_, "unknown joint type '", *word, "'; expected one of ", join(known), similarHint(*word, known)));
    return std::nullopt;
  }

  std::string linkOf(const XmlElement& element, const char* role, SourcePosition& where) {
    const XmlElement* link = element.child(role);
    where = link ? link->where : element.where;
    if (!link) error(element.where, cat(context_, "has no <", role, " link=\"...\"/>"));
    return link ? text(*link, "link").value_or("") : "";
  }

  void readJoint(const XmlElement& element) {
    context_.clear();
    UrdfJoint joint;
    joint.where = joint.limit_where = element.where;
    joint.name = text(element, "name").value_or("");
    context_ = cat("joint '", joint.name, "': ");
    for (const UrdfJoint& other : model_.joints) {
      if (other.name == joint.name)
        error(element.where, cat("joint '", joint.name, "' is already defined at ", other.where.str()));
    }
    joint.type = jointType(element).value_or(UrdfJointType::fixed);
    joint.parent = linkOf(element, "parent", joint.parent_where);
    joint.child = linkOf(element, "child", joint.child_where);
    joint.origin = origin(element);
    if (const XmlElement* axis = element.child("axis"); axis && joint.type != UrdfJointType::fixed &&
                                                        joint.type != UrdfJointType::floating &&
                                                        joint.type != UrdfJointType::spherical) {
      if (!axis->attribute("xyz"))
        warn(axis->where, cat(context_, "<axis> has no attribute 'xyz'; it is read as 1 0 0"));
      const Vector3d direction = vector(*axis, "xyz", Vector3d::UnitX());
      if (!(direction.norm() > 1e-10)) {
        error(axis->where, cat(context_, "its axis is zero"));
      } else {
        joint.axis = direction.normalized();
      }
    }
    readLimits(element, joint);
    if (const XmlElement* dynamics = element.child("dynamics")) {
      joint.damping = number(*dynamics, "damping", 0.);
      joint.friction = number(*dynamics, "friction", 0.);
    }
    if (const XmlElement* mimic = element.child("mimic")) {
      joint.mimic = UrdfMimic{text(*mimic, "joint").value_or(""), number(*mimic, "multiplier", 1.),
                              number(*mimic, "offset", 0.), mimic->where};
    }
    model_.joints.push_back(std::move(joint));
  }

  void readLimits(const XmlElement& element, UrdfJoint& joint) {
    const bool bounded = joint.type == UrdfJointType::revolute || joint.type == UrdfJointType::prismatic;
    const XmlElement* limit = element.child("limit");
    if (!limit) {
      if (bounded)
        warn(element.where, cat(context_, "a joint of this type should have a <limit>; it is read as unlimited"));
      return;
    }
    joint.limit_where = limit->where;
    const auto ofMotor = [&](const char* name) {  // 0: unknown
      const double value = limitOf(*limit, name, 0.);
      return value > 0. && value < kUrdfUnlimited ? value : 0.;
    };
    joint.effort = ofMotor("effort");
    joint.velocity = ofMotor("velocity");
    const bool has_motor = joint.type != UrdfJointType::fixed && joint.type != UrdfJointType::floating;
    if (has_motor && !said_that_motors_have_no_limit_ && !element.child("mimic")) {
      sayThatZeroIsNoLimit(*limit);
      sayThatLimitsAreMissing(*limit);
    }
    if (!bounded) return;
    joint.lower = limitOf(*limit, "lower", kUrdfUnlimited);
    joint.upper = limitOf(*limit, "upper", kUrdfUnlimited);
    joint.limited = joint.lower > -kUrdfUnlimited || joint.upper < kUrdfUnlimited;
    if (joint.lower > joint.upper) {
      warn(limit->where, cat(context_, "its lower limit ", joint.lower, " is above its upper limit ", joint.upper,
                             "; it is read as unlimited"));
      joint.limited = false;
    } else if (joint.lower == joint.upper) {
      warn(limit->where, cat(context_, "both of its limits are ", joint.lower, "; the joint cannot move"));
    }
  }

  /// Exporters write 0 or -1 where they know no limits of motors. Warns once per file.
  void sayThatZeroIsNoLimit(const XmlElement& limit) {
    const auto isNone = [&](const char* name) { return limit.attribute(name) && limitOf(limit, name, 1.) <= 0.; };
    const bool effort = isNone("effort"), velocity = isNone("velocity");
    if (!effort && !velocity) return;
    const char* what = effort && velocity ? "effort and velocity are" : effort ? "effort is" : "velocity is";
    const bool negative = limitOf(limit, effort ? "effort" : "velocity", 1.) < 0.;
    warn(limit.where, cat(context_, "its ", what, negative ? " negative" : " 0",
                          ", which is read as no limit, here and at other joints; write the ", "motor's ",
                          effort && velocity ? "limits" : "limit"));
    said_that_motors_have_no_limit_ = true;
  }

  /// URDF requires both limits of a motor. Warns once per file.
  void sayThatLimitsAreMissing(const XmlElement& limit) {
    if (said_that_motors_have_no_limit_) return;
    const bool effort = !limit.attribute("effort"), velocity = !limit.attribute("velocity");
    if (!effort && !velocity) return;
    warn(limit.where, cat(context_, "its <limit> has no ",
                          effort && velocity ? "effort and velocity"
                          : effort           ? "effort"
                                             : "velocity",
                          ", which URDF requires; the motor is read as unlimited, here and at other joints"));
    said_that_motors_have_no_limit_ = true;
  }

  std::vector<Diagnostic>& found_;
  UrdfModel model_;
  std::map<std::string, const XmlElement*> materials_;
  std::string context_;                  ///< "link 'x': ", for messages
  const char* optional_part_ = nullptr;  ///< element that an error leaves out, or null
  bool part_failed_ = false;
  bool asked_for_radians_ = false, said_that_motors_have_no_limit_ = false;
};

}  // namespace

UrdfModel parseUrdf(std::string_view text, const std::string& file, std::vector<Diagnostic>& found) {
  try {
    return UrdfParser(found).parse(parseXml(text, file));
  } catch (const ParseError& e) {
    found.push_back({Diagnostic::Severity::error, e.where(), e.reason()});
    return {};
  }
}

bool hasErrors(const std::vector<Diagnostic>& found) {
  const auto is_error = [](const Diagnostic& diagnostic) { return diagnostic.severity == Diagnostic::Severity::error; };
  return std::any_of(found.begin(), found.end(), is_error);
}

}  // namespace kinegraph::inline parsers_internal
