#include "kinegraph/exporters/mjcf_motors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/exporters/mjcf_geoms.h"
#include "kinegraph/parsers/xml/xml.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline exporters_internal {

namespace {

// the defaults of SimulationOptions, and the hands of its models
constexpr double kServoFrequency = 100.;  ///< rad/s
constexpr double kArmature = .1;          ///< kg m^2 or kg
constexpr double kGripStiffness = 2000., kGripDamping = 60., kGripLever = .1;
constexpr double kGripForce = 70.;  ///< N, of hands without a limit
constexpr double kNone = std::numeric_limits<double>::infinity();

double motorNumber(const FrameData& frame, const char* key, double otherwise) {
  const Node* node = frame.attributes->find(key);
  const double* number = node ? node->value.as<double>() : nullptr;
  return number ? *number : otherwise;
}

/// The largest force of the motor of a joint, N or N m; infinite without a limit.
double motorForce(const FrameData& frame) {
  const Node* node = frame.attributes->find("ctrl_limits");
  const NumberArray* limits = node ? node->value.as<NumberArray>() : nullptr;
  const bool has_limit = limits && limits->numbers.size() > 1 && limits->numbers[1] > 0.;
  return std::min(has_limit ? limits->numbers[1] : kNone, motorNumber(frame, "motorLimit", kNone));
}

std::string forceRange(double force) {
  return std::isfinite(force) ? cat(" forcerange=\"", exact(-force), " ", exact(force), "\"") : "";
}

std::string controlRange(const FrameData& frame, int dof, double unit) {
  const Joint& joint = *frame.joint;
  if (joint.lower.size() <= dof || !std::isfinite(joint.lower[dof]) || !(joint.lower[dof] < joint.upper[dof]))
    return "";
  return cat(" ctrlrange=\"", exact(unit * joint.lower[dof]), " ", exact(unit * joint.upper[dof]), "\"");
}

bool carriesJoints(const FrameData& frame) {
  return std::ranges::any_of(frame.children,
                             [](const FrameData* child) { return child->joint || carriesJoints(*child); });
}

bool weighsSomething(const FrameData& frame) {
  if (frame.inertia && frame.inertia->mass > 0.) return true;
  return std::ranges::any_of(frame.children, [](const FrameData* child) { return weighsSomething(*child); });
}

}  // namespace

std::set<const FrameData*> fingerJoints(const Config& config) {
  std::set<const FrameData*> fingers;
  for (const auto& frame : config.scene()->frames()) {
    if (!frame->moves() || !frame->joint->mimic) continue;
    const FrameData& source = dofSource(*frame);
    if (source.joint->active || source.joint->dofs() != 1 || frame->joint->dofs() != 1) continue;
    fingers.insert(frame.get());
    fingers.insert(&source);
  }
  return fingers;
}

Config withFreeObjects(const Config& config) {
  Config copy = config;
  std::vector<std::string> names;
  for (const auto& frame : copy.scene()->frames()) {
    if (frame->parent && frame->joint && frame->joint->type == JointType::rigid && weighsSomething(*frame) &&
        !carriesJoints(*frame))
      names.push_back(frame->name);
  }
  if (names.empty()) return copy;
  const std::optional<Frame> known = copy.findFrame("world");
  const bool is_root = known && !known->getParent() && known->getPose().isIdentity(0.);
  std::string root = "world";
  while (!is_root && copy.findFrame(root)) root += "_";
  const Frame world = is_root ? *known : copy.addFrame(root);
  for (const std::string& name : names) {
    Frame object = copy.getFrame(name);
    object.setParent(world, true);
    object.setJoint(JointType::free);
  }
  return copy;
}

MjcfMotors::MjcfMotors(const Config& config) : config_(config), fingers_(fingerJoints(config)) {
  const Eigen::Index n = config.getJointState().size();
  inertia_ = n > 0 ? VectorXd(config.equationOfMotion(VectorXd::Zero(n)).M.diagonal()) : VectorXd();
}

bool MjcfMotors::isMotor(const FrameData& frame) const {
  if (!frame.moves() || frame.joint->type == JointType::free) return false;
  const Node* node = frame.attributes->find("noMotor");
  const bool* off = node ? node->value.as<bool>() : nullptr;
  return !(off && *off) && (isFinger(frame) || dofSource(frame).joint->active);
}

bool MjcfMotors::isDriven(const FrameData& frame) const {
  for (const FrameData* f = &frame; f; f = f->parent)
    if (isMotor(*f)) return true;
  return false;
}

std::string MjcfMotors::jointAttributes(const FrameData& frame) const {
  std::string text;
  const auto add = [&](const char* name, double value) {
    if (value != 0.) text += cat(" ", name, "=\"", exact(value), "\"");
  };
  const bool driven = isMotor(frame);
  add("armature", motorNumber(frame, "armature", driven ? kArmature : 0.));
  add("damping", motorNumber(frame, "angularDamping", 0.));
  if (!driven) add("frictionloss", motorNumber(frame, "jointFriction", 0.));  // motors overcome theirs
  add("stiffness", motorNumber(frame, "springStiffness", 0.));
  if (motorNumber(frame, "springStiffness", 0.) != 0.)
    add("springref", motionScale(frame) * motorNumber(frame, "springReference", 0.));
  return text;
}

void MjcfMotors::add(const FrameData& frame, int dof, const std::string& joint, double value, double unit) {
  if (isFinger(frame)) return addHand(frame, joint, value);
  if (!isMotor(frame) || frame.joint->mimic) return;
  Eigen::Index index = dof;
  for (const auto& other : config_.scene()->frames()) {  // q has the joints in the order of their frames
    if (other.get() == &frame) break;
    if (other->moves() && other->joint->active && !other->joint->mimic) index += other->joint->dofs();
  }
  const double armature = motorNumber(frame, "armature", kArmature);
  const double mass = inertia_[index] / (unit * unit) + armature;
  double stiffness = kServoFrequency * kServoFrequency * mass, damping = 2. * kServoFrequency * mass;
  if (frame.attributes->find("motorKp")) {
    stiffness = motorNumber(frame, "motorKp", 0.);
    damping = motorNumber(frame, "motorKd", 0.);
  }
  actuators_ += cat("    <position name=\"", xmlEscaped(joint), "\" joint=\"", xmlEscaped(joint), "\" kp=\"",
                    exact(stiffness), "\" kv=\"", exact(damping), "\"", controlRange(frame, dof, unit),
                    forceRange(motorForce(frame) / unit), "/>\n");
  controls_.push_back(value);
}

void MjcfMotors::addHand(const FrameData& frame, const std::string& joint, double value) {
  const FrameData& source = dofSource(frame);
  wraps_.push_back({&source, joint, std::abs(motionScale(frame) / motionScale(source))});  // the axis has the sign
  if (&frame != &source) return;
  hands_.push_back(&source);
  controls_.push_back(value);
  const bool slides = source.joint->steps[0].translates();
  const double lever = slides ? 1. : kGripLever * kGripLever;
  const double force = std::isfinite(motorForce(source)) ? motorForce(source) : kGripForce;
  const auto fingers = std::ranges::count_if(fingers_, [&](const FrameData* f) { return &dofSource(*f) == &source; });
  const double unit = std::abs(motionScale(source));
  actuators_ += cat("    <general name=\"", xmlEscaped(joint), "\" tendon=\"", xmlEscaped(joint), "\"",
                    controlRange(source, 0, unit), " gainprm=\"", exact(lever * kGripStiffness),
                    "\" biastype=\"affine\" biasprm=\"0 ", exact(-lever * kGripStiffness), " ",
                    exact(-lever * kGripDamping), "\"", forceRange(double(fingers) * force), "/>\n");
}

std::string MjcfMotors::text() const {
  std::string tendons;
  for (const FrameData* hand : hands_) {
    const auto own = [&](const Wrap& wrap) { return wrap.source == hand; };
    const double count = double(std::ranges::count_if(wraps_, own));
    std::string joints, name;
    for (const Wrap& wrap : wraps_) {
      if (!own(wrap)) continue;
      if (wrap.ratio == 1. && name.empty()) name = wrap.joint;
      joints += cat("      <joint joint=\"", xmlEscaped(wrap.joint), "\" coef=\"", exact(1. / (count * wrap.ratio)),
                    "\"/>\n");
    }
    tendons += cat("    <fixed name=\"", xmlEscaped(name), "\">\n", joints, "    </fixed>\n");
  }
  std::string text;
  if (!tendons.empty()) text += cat("  <tendon>\n", tendons, "  </tendon>\n");
  if (!actuators_.empty()) text += cat("  <actuator>\n", actuators_, "  </actuator>\n");
  return text;
}

std::string MjcfMotors::options() {
  return "  <option timestep=\"0.002\" integrator=\"implicitfast\" cone=\"elliptic\" impratio=\"1000\"/>\n"
         "  <default>\n    <geom condim=\"4\"/>\n  </default>\n";
}

std::string MjcfMotors::coupling() { return " solref=\"0.005 1\" solimp=\"0.95 0.99 0.001 0.5 2\""; }

}  // namespace kinegraph::inline exporters_internal
