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
#include "kinegraph/parsers/xml.h"

namespace kinegraph {

namespace {

constexpr double kTwoTurns = 4. * std::numbers::pi;

/// Collects one kind of question, and asks it once for all of its places.
class Question {
 public:
  void add(const SourcePosition& where, const std::string& text) {
    if (count_++ == 0) where_ = where, text_ = text;
  }
  void ask(SceneDiagnostics& diagnostics) const {
    if (count_ == 0) return;
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
    const NumberArray* array = node->value.as<NumberArray>();
    if (!array || (array->numbers.size() != 3 && array->numbers.size() != 7)) continue;
    const std::vector<double>& p = array->numbers;
    if (!isMillimeterPosition(p[0], p[1], p[2])) continue;
    const double most =
        *std::max_element(p.begin(), p.begin() + 3, [](double a, double b) { return std::abs(a) < std::abs(b); });
    questions.positions.add(node->where, cat("frame '", frame.name, "': a coordinate of its position is ", most, " m; ",
                                             askForMeters(most)));
  }
}

void checkSize(const FrameData& frame, const Graph& attributes, Questions& questions) {
  const Geometry& geometry = *frame.shape->geometry;
  const Node* node = findAny(attributes, {"size", "mesh", "vertices"});
  const bool is_thin = geometry.type == ShapeType::quad || geometry.type == ShapeType::plane;
  if (!node || is_thin || shapeKind(geometry.type).is_symbol) return;
  std::vector<double> sides = geometry.size;
  if (geometry.mesh && !geometry.mesh->vertices.empty()) {
    Eigen::AlignedBox3d box;
    for (const Vector3d& vertex : geometry.mesh->vertices) box.extend(vertex);
    const Vector3d extent = box.sizes();
    sides = {extent[0], extent[1], extent[2]};
  }
  while (!sides.empty() && sides.back() == 0.) sides.pop_back();  // sharp corners
  if (!mayBeMillimeters(sides)) return;
  const double most = *std::ranges::max_element(sides);
  questions.sizes.add(
      node->where, cat("frame '", frame.name, "': its ", geometry.mesh ? "mesh" : shapeTypeName(geometry.type), " is ",
                       most, " m large; ", askForMeters(most)));
}

}  // namespace

void askAboutUnits(const SceneSource& source, const std::vector<FrameData*>& frames, SceneDiagnostics& diagnostics) {
  Questions questions;
  for (std::size_t i = 0; i < std::min(frames.size(), source.frames.size()); ++i) {
    const FrameData& frame = *frames[i];
    const Graph& attributes = *source.frames[i].node.value.as<Graph>();
    const FrameData* const joint = frame.joint ? &frame : frame.parent;
    if (joint && joint->joint && attributes.find("joint")) checkJoint(*joint, attributes, questions);
    if (frame.shape) checkSize(frame, attributes, questions);
    checkPose(frame, attributes, questions);
  }
  for (const auto& [file, question] : questions.limits) {
    if (!questions.radians.contains(file)) question.ask(diagnostics);
  }
  questions.values.ask(diagnostics);
  questions.rotations.ask(diagnostics);
  questions.sizes.ask(diagnostics);
  questions.positions.ask(diagnostics);
}

}  // namespace kinegraph
