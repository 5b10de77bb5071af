#include "kinegraph/parsers/mjcf/mjcf_dynamics.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/parsers/mjcf/mjcf_expansion.h"

namespace kinegraph::inline parsers_internal {

namespace {

/// Half the width of a symmetric range that contains the element's range; nullopt if it has none in force.
std::optional<double> reachOf(const MjcfElement& element, const char* range, const char* limited, MjcfValues& values) {
  if (values.keyword(element, limited, {"auto", "true", "false"}, "auto") == "false") return std::nullopt;
  const std::vector<double> r = values.limits(element, range);
  const double reach = r.empty() ? 0. : std::max(std::abs(r[0]), std::abs(r[1]));
  return r.empty() || std::isinf(reach) ? std::nullopt : std::optional(reach);
}

/// First number of a list attribute.
double first(const MjcfElement& element, const char* name, double fallback, MjcfValues& values) {
  const std::vector<double> numbers = values.upTo(element, name, 10);
  return numbers.empty() ? fallback : numbers[0];
}

MjcfMotor motorOf(const MjcfElement& element, MjcfValues& values, std::vector<std::string>& unread) {
  const std::string kind = element.xml().name;
  const double gear = std::abs(first(element, "gear", 1., values));
  MjcfMotor motor;
  const std::optional<double> force = reachOf(element, "forcerange", "forcelimited", values),
                              control = reachOf(element, "ctrlrange", "ctrllimited", values);
  double gain = 1.;
  bool is_torque = kind == "motor";
  if (kind == "position") {
    motor.stiffness = gear * gear * values.number(element, "kp", 1.);
    motor.damping = gear * gear * values.number(element, "kv", 0.);
    motor.damping_ratio = values.number(element, "dampratio", 0.);
  } else if (kind == "general") {
    const std::vector<double> gains = values.upTo(element, "gainprm", 10), bias = values.upTo(element, "biasprm", 10);
    gain = gains.empty() ? 1. : gains[0];
    const XmlAttribute* bias_type = element.attribute("biastype");
    const bool is_affine = bias_type && bias_type->value == "affine";
    const double p = is_affine && bias.size() > 1 ? -bias[1] : 0., d = is_affine && bias.size() > 2 ? -bias[2] : 0.;
    if (p > 0.) motor.stiffness = gear * gear * p;
    if (p > 0.) motor.damping = gear * gear * std::max(d, 0.);
    is_torque = !is_affine;
    if (bias_type && bias_type->value != "affine" && bias_type->value != "none") unread.push_back(bias_type->value);
  } else if (kind != "motor") {
    unread.push_back(cat("gains of <", kind, ">"));
  }
  if (force) motor.effort = gear * *force;
  if (is_torque && control) {
    const double reach = gear * std::abs(gain) * *control;
    motor.effort = motor.effort > 0. ? std::min(motor.effort, reach) : reach;
  }
  return motor;
}

}  // namespace

std::map<std::string, MjcfMotor> mjcfMotors(const MjcfDocument& document, MjcfValues& values, Findings& findings) {
  std::map<std::string, MjcfMotor> motors;
  std::vector<std::string> unread;
  SourcePosition where;
  std::vector<std::string> joints;
  for (const auto& [kind, name] : mjcfDefinitions(document.root())) {
    if (kind == "joint") joints.push_back(name);
  }
  for (const XmlElement* section : document.root().all("actuator")) {
    for (const XmlElement& xml : section->children) {
      const MjcfElement element = document.element(xml);
      const XmlAttribute* joint = element.attribute("joint");
      if (!joint) continue;
      if (!std::binary_search(joints.begin(), joints.end(), joint->value)) {
        findings.warn(joint->where, cat("<", xml.name, ">: there is no joint '", joint->value, "'; it is left out",
                                        similarHint(joint->value, joints)));
        continue;
      }
      if (!where.known()) where = xml.where;
      MjcfMotor motor = motorOf(element, values, unread);
      MjcfMotor& sum = motors[joint->value];
      sum.effort = std::max(sum.effort, motor.effort);
      if (sum.stiffness == 0.) {
        motor.effort = sum.effort;
        sum = motor;
      }
    }
  }
  std::sort(unread.begin(), unread.end());
  unread.erase(std::unique(unread.begin(), unread.end()), unread.end());
  if (!unread.empty()) findings.warn(where, cat("<actuator>: not read: ", join(unread)));
  return motors;
}

void addMjcfJointDynamics(const MjcfElement& joint, const MjcfMotor* motor, MjcfValues& values,
                          FrameAttributes& attributes) {
  const auto addPositive = [&](const char* name, double value) {
    if (value > 0.) attributes.add(name, value);
  };
  addPositive("angularDamping", first(joint, "damping", 0., values));
  addPositive("jointFriction", values.number(joint, "frictionloss", 0.));
  addPositive("armature", values.number(joint, "armature", 0.));
  if (const double stiffness = first(joint, "stiffness", 0., values); stiffness > 0.) {
    attributes.add("springStiffness", stiffness);
    const bool slides = values.keyword(joint, "type", {"hinge", "slide", "ball", "free"}, "hinge") == "slide";
    const double rest = values.number(joint, "springref", 0.);
    if (rest != 0.) attributes.add("springReference", slides ? rest : values.radians(joint, rest));
  }
  const std::optional<double> reach = reachOf(joint, "actuatorfrcrange", "actuatorfrclimited", values);
  double effort = motor ? motor->effort : 0.;
  if (reach) effort = effort > 0. ? std::min(effort, *reach) : *reach;
  if (effort > 0.) attributes.addNumbers("ctrl_limits", {0., effort, -1.});
  if (!motor || motor->stiffness <= 0.) return;
  attributes.add("motorKp", motor->stiffness);
  attributes.add("motorKd", motor->damping);
  addPositive("motorDampingRatio", motor->damping_ratio);
}

void addMjcfFriction(const MjcfElement& geom, MjcfValues& values, FrameAttributes& attributes) {
  const std::vector<double> friction = values.upTo(geom, "friction", 3);
  attributes.add("friction", friction.empty() ? 1. : friction[0]);
  attributes.add("frictionRule", std::string("max"));
  if (friction.size() > 1) attributes.add("torsionalFriction", friction[1]);
  if (friction.size() > 2) attributes.add("rollingFriction", friction[2]);
}

namespace {

void countUnread(const XmlElement& element, std::map<std::string, int>& counts, SourcePosition& where) {
  static const std::map<std::string, std::vector<std::string>> unread = {
      {"geom", {"solref", "solimp", "solmix", "priority", "margin", "gap", "fluidshape", "fluidcoef"}},
      {"joint", {"springdamper", "solreffriction", "solimpfriction", "solreflimit", "solimplimit", "margin"}},
      {"pair", {"condim", "friction", "solref", "solreffriction", "solimp", "margin", "gap"}}};
  const auto names = unread.find(element.name);
  for (const XmlAttribute& attribute : element.attributes) {
    const bool frictionless = element.name == "geom" && attribute.name == "condim" && attribute.value == "1";
    const bool listed = names != unread.end() &&
                        std::find(names->second.begin(), names->second.end(), attribute.name) != names->second.end();
    if (!frictionless && !listed) continue;
    if (!where.known()) where = attribute.where;
    ++counts[frictionless ? "geom condim=1" : cat(element.name, " ", attribute.name)];
  }
  for (const XmlElement& child : element.children) countUnread(child, counts, where);
}

}  // namespace

void warnOfMjcfDynamics(const MjcfDocument& document, Findings& findings) {
  std::map<std::string, int> counts;
  SourcePosition where;
  for (const char* section : {"default", "worldbody", "contact"}) {
    for (const XmlElement* element : document.root().all(section)) countUnread(*element, counts, where);
  }
  for (const XmlElement* option : document.root().all("option")) {
    for (const char* name : {"gravity", "wind", "density", "viscosity", "magnetic"}) {
      const XmlAttribute* attribute = option->attribute(name);
      if (!attribute) continue;
      const auto numbers = numbersIn(attribute->value);
      const bool is_default =
          numbers && (std::string_view(name) == "gravity"
                          ? *numbers == std::vector<double>{0., 0., -9.81}
                          : std::all_of(numbers->begin(), numbers->end(), [](double x) { return x == 0.; }));
      if (is_default) continue;
      if (!where.known()) where = attribute->where;
      ++counts[cat("option ", name)];
    }
  }
  for (const XmlElement* flags : document.inSections("option", "flag")) {
    for (const XmlAttribute& flag : flags->attributes) {
      static const std::set<std::string> unread = {"constraint", "frictionloss", "limit",   "spring",
                                                   "damper",     "passive",      "gravity", "actuation"};
      if (flag.value != "disable" || !unread.contains(flag.name)) continue;
      if (!where.known()) where = flag.where;
      ++counts[cat("flag ", flag.name, "=disable")];
    }
  }
  std::vector<std::string> list;
  for (const auto& [name, count] : counts) list.push_back(count > 1 ? cat(name, " (", count, ")") : name);
  if (!list.empty()) findings.warn(where, cat("not part of the simulation: ", join(list)));
}

}  // namespace kinegraph::inline parsers_internal
