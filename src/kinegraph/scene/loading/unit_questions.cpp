#include "kinegraph/scene/loading/unit_questions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "kinegraph/common/guessed_units.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline scene_internal {

namespace {

constexpr double kTwoTurns = 4. * std::numbers::pi;
constexpr double kLeastReach = 2., kTimesLarger = 50.;  // m; a link is at most as many times larger than the offsets
constexpr double kLeastDensity = .01;                   // kg/m^3; air has 1.2

/// Collects one kind of question, and asks it once for all of its places, if they are `least` or more.
class Question {
 public:
  void add(const SourcePosition& where, const std::string& text) {
    if (count_++ == 0) where_ = where, text_ = text;
  }
  void ask(SceneDiagnostics& diagnostics, int least = 1) const {
    if (count_ < least) return;
    const int more = count_ - 1;
    diagnostics.warning(where_, cat(text_, more == 0 ? "" : cat("; so for ", more, more == 1 ? " more" : " others")));
  }

 private:
  SourcePosition where_;
  std::string text_;
  int count_ = 0;
};

struct Questions {
  Question values, rotations, sizes, positions;
  std::map<std::string, Question> limits;  ///< by file
  std::set<std::string> radians;           ///< files with limits within a turn, or that are no round numbers
  std::set<const FrameData*> far;          ///< links far from their parents
};

const Node* findAny(const Graph& attributes, std::initializer_list<const char*> keys) {
  for (const char* key : keys) {
    if (const Node* node = attributes.find(key)) return node;
  }
  return nullptr;
}

/// Calls `use` with the values of the dofs that rotate.
template <class Use>
void forAngles(const Joint& joint, const VectorXd& values, Use use) {
  Eigen::Index dof = 0;
  for (const MotionStep& step : joint.steps) {
    if (step.rotates() && dof < values.size()) use(values[dof]);
    dof += step.dofs();
  }
}

/// Whether a limit is in degrees although others of the file are not: -170, 180, but not 100, which means many turns.
bool isLimitOfDegrees(double limit) {
  const double size = std::abs(limit);
  return size >= 90. && size <= 360. && std::fmod(size, 5.) == 0. && std::fmod(size, 100.) != 0.;
}

void checkJoint(const FrameData& frame, const Graph& attributes, Questions& questions) {
  const Joint& joint = *frame.joint;
  if (const Node* node = attributes.find("limits")) {
    double widest = 0.;
    const auto look = [&](double limit) {
      if (!std::isfinite(limit)) return;
      if (!mayBeDegrees(limit, 0.)) questions.radians.insert(node->where.file);
      if (std::abs(limit) > std::abs(widest)) widest = limit;
    };
    forAngles(joint, joint.lower, look);
    forAngles(joint, joint.upper, look);
    if (widest != 0. && std::abs(widest) < .5 * kTwoTurns) questions.radians.insert(node->where.file);
    if (mayBeDegrees(widest, kTwoTurns)) {
      Question& question = questions.limits[isLimitOfDegrees(widest) ? "" : node->where.file];
      question.add(node->where, cat("frame '", frame.name, "': a limit is ", widest, " rad; ", askForRadians(widest)));
    }
  }
  if (const Node* node = findAny(attributes, {"q", "home"})) {
    forAngles(joint, node->key == "q" ? joint.q : joint.home, [&](double q) {
      if (mayBeDegrees(q, kTwoTurns) && std::fmod(q, 5.) == 0.)
        questions.values.add(node->where,
                             cat("frame '", frame.name, "': ", node->key, " is ", q, " rad; ", askForRadians(q)));
    });
  }
}

/// The letter and the first numbers of the motions of a pose text: "t(0 0 1) r(90 1 0 0)".
void checkPoseText(const std::string& text, const FrameData& frame, const Node& node, Questions& questions) {
  for (std::size_t at = text.find_first_of("rE"); at != std::string::npos; at = text.find_first_of("rE", at + 1)) {
    const std::size_t open = text.find('(', at), end = text.find(')', at);
    if (open == std::string::npos || end == std::string::npos || end < open) return;
    const std::vector<double> v = numbersIn(text.substr(open + 1, end - open - 1)).value_or(std::vector<double>{});
    const std::size_t angles = text[at] == 'r' ? 1 : 3;
    for (std::size_t i = 0; i < std::min(angles, v.size()); ++i) {
      if (!mayBeDegrees(v[i], kTwoTurns)) continue;
      questions.rotations.add(node.where, cat("frame '", frame.name, "': ", text[at], "(...) turns by ", v[i], " rad; ",
                                              askForRadians(v[i]), "; d(90 1 0 0) is in degrees"));
    }
  }
}

void checkPose(const FrameData& frame, const Graph& attributes, Questions& questions) {
  for (const char* key : {"X", "Q", "rel", "pose", "pre", "A", "origin", "post", "B"}) {
    const Node* node = attributes.find(key);
    if (!node) continue;
    if (const std::string* text = node->value.as<std::string>()) checkPoseText(*text, frame, *node, questions);
    if (const AngleText* text = node->value.as<AngleText>()) checkPoseText(text->text, frame, *node, questions);
  }
}

/// Whether a joint of the frame or of an ancestor only rotates: the frame is a link of an arm.
bool isOnArm(const FrameData& frame) {
  const auto rotates = [](const MotionStep& step) { return step.rotates(); };
  for (const FrameData* link = &frame; link; link = link->parent) {
    if (link->moves() && std::ranges::all_of(link->joint->steps, rotates)) return true;
  }
  return false;
}

/// Where the links of arms are in their parents. The root does not count: it is placed in a scene of any size.
void checkPosition(const FrameData& frame, const Node& node, Questions& questions) {
  if (!frame.parent || !isOnArm(frame)) return;
  const bool has_origin = frame.parent->name == frame.name + "_origin";
  const FrameData& placed = has_origin ? *frame.parent : frame;
  const Vector3d p = placed.relativePose().p;
  if (!isMillimeterPosition(p[0], p[1], p[2]) || !questions.far.insert(&placed).second) return;
  Eigen::Index most = 0;
  p.cwiseAbs().maxCoeff(&most);
  questions.positions.add(node.where, cat("frame '", frame.name, "': a coordinate of its position is ", p[most], " m; ",
                                          askForMeters(p[most])));
}

/// The sides of a shape, or of the box around its mesh, m. Empty for floors and symbols.
std::vector<double> sidesOf(const Geometry& geometry) {
  const bool is_thin = geometry.type == ShapeType::quad || geometry.type == ShapeType::plane;
  if (is_thin || shapeKind(geometry.type).is_symbol) return {};
  std::vector<double> sides = geometry.size;
  if (geometry.mesh && !geometry.mesh->vertices.empty()) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : geometry.mesh->vertices) box.extend(vertex);
    const Vector3d extent = box.sizes();
    sides = {extent[0], extent[1], extent[2]};
  }
  while (!sides.empty() && sides.back() == 0.) sides.pop_back();  // sharp corners
  return sides;
}

/// Whether a movable frame is lighter than what it displaces by far. Fixed scenery often has an arbitrary mass.
bool isLighterThanAir(const FrameData& frame, const std::vector<double>& sides) {
  const double shortest = std::ranges::min(sides), longest = std::ranges::max(sides);
  for (const FrameData* link = &frame; link; link = link->parent) {
    if (link->inertia && link->inertia->mass > kLeastDensity * shortest * shortest * longest) return false;
    if (link->joint) return link->inertia && link->inertia->mass > 0.;
  }
  return false;
}

}  // namespace

std::string askAboutSize(const FrameData& frame) {
  if (!frame.shape) return "";
  const Geometry& geometry = *frame.shape->geometry;
  const std::vector<double> sides = sidesOf(geometry);
  if (!mayBeMillimeters(sides)) return "";
  double reach = kLeastReach;
  for (const FrameData* link = &frame; link->parent; link = link->parent)
    reach = std::max(reach, link->relativePose().p.norm());
  const double most = std::ranges::max(sides);
  const bool is_large_link = isOnArm(frame) && most >= kTimesLarger * reach;
  if (!is_large_link && !isLighterThanAir(frame, sides)) return "";
  return cat("frame '", frame.name, "': its ", geometry.mesh ? "mesh" : shapeTypeName(geometry.type), " is ", most,
             " m large; ", askForMeters(most));
}

void askAboutUnits(const SceneSource& source, const std::vector<FrameData*>& frames, SceneDiagnostics& diagnostics) {
  Questions questions;
  for (std::size_t i = 0; i < std::min(frames.size(), source.frames.size()); ++i) {
    const FrameData& frame = *frames[i];
    const Node& node = source.frames[i].node;
    const Graph& attributes = *node.value.as<Graph>();
    const FrameData* const joint = frame.joint ? &frame : frame.parent;
    if (joint && joint->joint && attributes.find("joint")) checkJoint(*joint, attributes, questions);
    if (const std::string question = askAboutSize(frame); !question.empty()) questions.sizes.add(node.where, question);
    checkPose(frame, attributes, questions);
    checkPosition(frame, node, questions);
  }
  for (const auto& [file, question] : questions.limits) {
    if (!questions.radians.contains(file)) question.ask(diagnostics);
  }
  questions.values.ask(diagnostics);
  questions.rotations.ask(diagnostics);
  questions.sizes.ask(diagnostics);
  questions.positions.ask(diagnostics, 2);  // a single one is a high tower's joint
}

}  // namespace kinegraph::inline scene_internal
