#include "kinegraph/scene/frame_setters.h"

#include <cmath>
#include <utility>
#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/gfile/parser.h"
#include "kinegraph/scene/loading/attributes.h"
#include "kinegraph/scene/tree/joint_limits.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

/// Words that a file interprets once, and what does the same for an existing frame.
constexpr std::pair<std::string_view, std::string_view> kOfFiles[] = {
    {"X", "setPose"},
    {"pose", "setPose"},
    {"Q", "setRelativePose"},
    {"rel", "setRelativePose"},
    {"pre", "setRelativePose of a frame in between"},
    {"post", "setRelativePose of a frame below"},
    {"joint", "setJoint"},
    {"axis", "setJoint"},
    {"joint_scale", "setJoint"},
    {"mimic", "setJoint"},
    {"joint_active", "selectJoints"},
    {"parent", "setParent"},
    {"shape", "setShape"},
    {"type", "setShape"},
    {"size", "setShape"},
    {"mesh", "setMeshFile"},
    {"meshscale", "setMeshFile"},
    {"vertices", "setMesh"},
    {"triangles", "setMesh"},
    {"core", "setConvexMesh"},
    {"sdf", "setImplicitSurface"},
    {"texture", "setTextureFile"},
    {"inertia", "setMass"},
    {"com", "setMass"},
};

std::vector<double> numbersOf(const Frame& frame, const Node& node) {
  if (const auto* list = node.value.as<NumberArray>()) return list->numbers;
  if (const auto* number = node.value.as<double>()) return {*number};
  if (const auto* flag = node.value.as<bool>()) return {*flag ? 1. : 0.};
  throw ValueError(cat("frame '", frame.getName(), "': ", node.key, " is not a number or a list of numbers"));
}

double numberOf(const Frame& frame, const Node& node) {
  const std::vector<double> numbers = numbersOf(frame, node);
  if (numbers.size() == 1) return numbers[0];
  throw ValueError(cat("frame '", frame.getName(), "': ", node.key, " has ", numbers.size(), " numbers; expected one"));
}

int contactOf(const Frame& frame, const Node& node) {
  const double number = numberOf(frame, node);
  if (std::abs(number) < 1e6 && number == std::round(number)) return int(number);
  throw ValueError(cat("frame '", frame.getName(), "': contact is ", number, "; expected a whole number"));
}

void setLimits(Frame& frame, const Node& node) {
  const std::vector<double> limits = numbersOf(frame, node);
  FrameData& data = frame.edit();
  if (!data.joint) throw ValueError(cat("frame '", data.name, "' has no joint, so limits mean nothing"));
  const auto dofs = std::size_t(data.joint->dofs());
  if (limits.size() != 2 * dofs)
    throw ValueError(cat("frame '", data.name, "': limits of its joint are ", 2 * dofs,
                         " numbers (all lower, then all upper), not ", limits.size()));
  if (const std::string why = limitsError(limits); !why.empty())
    throw ValueError(cat("frame '", data.name, "': ", why));
  data.joint->lower = Eigen::Map<const VectorXd>(limits.data(), Eigen::Index(dofs));
  data.joint->upper = Eigen::Map<const VectorXd>(limits.data() + dofs, Eigen::Index(dofs));
  VectorXd q = data.joint->q;
  if (!data.joint->mimic && moveToEqualLimits(data.joint->steps, limits, {q.data(), dofs})) frame.setJointState(q);
  frame.scene()->structureChanged();
}

/// The shapes of these frames never collide with those of the frame, instead of the ones named before.
void setContactExclude(Frame& frame, const Node& node) {
  std::vector<std::string> names;
  if (const auto* list = node.value.as<StringArray>()) names = *list;
  if (const auto* tuple = node.value.as<NameTuple>()) names = tuple->names;
  if (const auto* name = node.value.as<std::string>()) names = {*name};
  if (names.empty())
    throw ValueError(cat("frame '", frame.getName(), "': contact_exclude has no names of frames; expected [a, b]"));
  std::vector<FrameData*> others;
  for (const std::string& name : names) others.push_back(&frame.scene()->get(name, "setAttributes, contact_exclude"));
  frame.edit().no_contact = others;
  frame.scene()->structureChanged();
}

}  // namespace

std::vector<std::string> setAttributes(Frame& frame, const Graph& attributes) {
  for (const Node& node : attributes.nodes)
    for (const auto& [word, method] : kOfFiles)
      if (node.key == word)
        throw ValueError(cat("setAttributes: '", word, "' of frame '", frame.getName(),
                             "' has a meaning in files only; call ", method));
  std::vector<std::string> warnings;
  for (const Node& node : attributes.nodes) {
    if (const std::string question = askAboutAttribute(node); !question.empty())
      warnings.push_back(cat("setAttributes: frame '", frame.getName(), "': ", question));
    if (node.key == "contact") frame.setContact(contactOf(frame, node));
    if (node.key == "mass") frame.setMass(numberOf(frame, node));
    if (node.key == "color") frame.setColor(numbersOf(frame, node));
    if (node.key == "limits") setLimits(frame, node);
    if (node.key == "contact_exclude") setContactExclude(frame, node);
    if (node.key == "q") {
      const std::vector<double> q = numbersOf(frame, node);
      frame.setJointState(Eigen::Map<const VectorXd>(q.data(), Eigen::Index(q.size())));
    }
    frame.editAttributes().set(node);
    if (node.key == "multibody") frame.scene()->structureChanged();  // what stands beside it may collide now
  }
  return warnings;
}

std::vector<std::string> setAttributes(Frame& frame, const std::string& text) {
  return setAttributes(frame, parse(text, cat("attributes of frame '", frame.getName(), "'")));
}

}  // namespace kinegraph
