#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/place_frames.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph {

namespace {

std::set<std::string> setOf(const std::vector<std::string>& words) { return {words.begin(), words.end()}; }

/// Drops facts that are already known.
std::vector<Literal> unique(const std::vector<Literal>& facts) {
  std::vector<Literal> kept;
  for (const Literal& fact : facts) {
    if (!contains(kept, fact)) kept.push_back(fact);
  }
  return kept;
}

class StartFacts {
 public:
  explicit StartFacts(const Config& C) : C_(C), said_(sceneFacts(C)) {
    for (const char* kind : {"is_carrier", "is_pushable"})  // labels that only objects have
      for (const std::string& name : wordsOf(said_, kind))
        if (C.getFrame(name).getJointType() == JointType::rigid) said_.push_back({"is_object", {name}});
  }

  std::vector<Literal> with(const std::vector<Literal>& goal) {
    const std::vector<Frame> frames = C_.getFrames();
    std::erase_if(said_, [&](const Literal& fact) {  // the base of a robot is no object
      return fact.predicate == "is_object" && carriesJoints(C_.getFrame(fact.arguments[0]));
    });
    const bool names_grippers = has("is_gripper"), names_places = has("is_place");
    if (!names_grippers) {
      for (const Frame& f : frames)
        if (f.getName().ends_with("gripper")) said_.push_back({"is_gripper", {f.getName()}});
    }
    const std::set<std::string> grippers = setOf(wordsOf(said_, "is_gripper")),
                                objects = setOf(wordsOf(said_, "is_object")),
                                drawers = setOf(wordsOf(said_, "is_drawer"));
    if (!names_places) {
      for (const Frame& f : frames)
        if (hasTop(f) && ((isBox(f) && !isPart(f, objects)) || isUsed(f, goal)) && !grippers.contains(f.getName()) &&
            placeFlaw(f, objects, drawers).empty())
          said_.push_back({"is_place", {f.getName()}});
    }
    addWhatIsOn(grippers, objects);
    correctWhatIsOn(objects);
    const VectorXd q = C_.getJointState();
    for (const TaskDoor& door : doorsOf(C_)) {
      said_.push_back({"is_guided", {door.name}});
      said_.push_back({door.stateAt(q[door.dof]), {door.name}});
    }
    for (const std::string& hand : grippers)
      if (holdsAnything(hand)) said_.push_back({"busy", {hand}});
    for (const std::string& name : objects)
      if (const std::string up = upOf(C_, name); !up.empty()) said_.push_back({"up", {up, name}});
    std::vector<std::string> kinds = {"is_carrier", "is_pushable"};
    if (has("is_hook")) kinds.emplace_back("is_object");  // any object may be pulled within reach
    for (const std::string& kind : kinds)
      for (const std::string& name : wordsOf(said_, kind)) said_.push_back({"fresh", {name}});
    if (std::ranges::any_of(goal, [](const Literal& g) { return g.predicate == "up"; })) {
      for (const std::string& face : otherFaces()) said_.push_back({"is_face", {face}});
    }
    for (const Literal& literal : goal)  // goalFlaw names those that are neither objects nor places
      for (const std::string& word : literal.arguments)
        if (C_.findFrame(word)) said_.push_back({"is_frame", {word}});
    return unique(said_);
  }

 private:
  static bool carriesJoints(const Frame& frame) {
    return std::ranges::any_of(frame.getSubtree(), [](const Frame& below) {
      const auto& joint = below.data().joint;
      return joint && joint->active && joint->dofs() > 0;
    });
  }

  bool has(const std::string& predicate) const {
    return std::ranges::any_of(said_, [&](const Literal& fact) { return fact.predicate == predicate; });
  }

  bool holdsAnything(const std::string& hand) const {
    return std::ranges::any_of(whatIsBelow(said_), [&](const auto& entry) { return entry.second == hand; });
  }

  /// Facts about objects that hang below unlabeled frames.
  void addWhatIsOn(const std::set<std::string>& grippers, const std::set<std::string>& objects) {
    const std::map<std::string, std::string> below = whatIsBelow(said_);
    for (const std::string& name : objects) {
      if (below.contains(name)) continue;
      const std::optional<Frame> parent = C_.getFrame(name).getParent();
      if (parent && contains(said_, {"is_place", {parent->getName()}})) {
        said_.push_back({"on", {parent->getName(), name}});
      } else if (const std::string hand = holderOf(C_, name, {grippers.begin(), grippers.end()}); !hand.empty()) {
        said_.push_back({"on", {hand, name}});
      }
    }
  }

  /// Whether a frame without a joint belongs to an object.
  static bool isPart(const Frame& frame, const std::set<std::string>& objects) {
    Frame body = frame;
    while (body.getJointType() == JointType::none && body.getParent()) body = *body.getParent();
    return !(body == frame) && objects.contains(body.getName());
  }

  /// Whether something stands on a frame, or shall stand there.
  bool isUsed(const Frame& frame, const std::vector<Literal>& goal) const {
    const std::string& name = frame.getName();
    const auto names = [&](const Literal& g) {
      return g.predicate == "on" && g.arguments.size() == 2 && g.arguments[0] == name;
    };
    const auto isChild = [&](const Frame& child) { return contains(said_, {"is_object", {child.getName()}}); };
    return std::ranges::any_of(goal, names) || std::ranges::any_of(frame.getChildren(), isChild);
  }

  /// Objects hang below any frame of a scene. Those that stand on no place, or beside their place, are on the static
  /// place that they touch.
  void correctWhatIsOn(const std::set<std::string>& objects) {
    std::vector<std::string> places;
    for (const std::string& name : wordsOf(said_, "is_place")) {
      if (!contains(said_, {"is_carrier", {name}}) && isStill(C_.getFrame(name))) places.push_back(name);
    }
    const std::map<std::string, std::string> below = whatIsBelow(said_);
    for (const std::string& name : objects) {
      const Frame obj = C_.getFrame(name);
      const auto known = below.find(name);
      if (!isStill(obj) || obj.getShapeType() == ShapeType::none) continue;
      const bool moves = known != below.end() && objects.contains(known->second);
      if (known != below.end() && (moves || !isOff(obj, C_.getFrame(known->second)))) continue;
      const std::string place = supportingPlace(C_, name, places);
      if (place.empty()) continue;
      if (known != below.end()) std::erase(said_, Literal{"on", {known->second, name}});
      said_.push_back({"on", {place, name}});
    }
  }

  /// Whether no joint with dofs moves a frame.
  static bool isStill(const Frame& frame) {
    for (std::optional<Frame> up = frame; up; up = up->getParent())
      if (up->data().moves()) return false;
    return true;
  }

  const Config& C_;
  std::vector<Literal> said_;
};

}  // namespace

std::vector<Literal> taskFacts(const Config& C, const std::vector<Literal>& goal) { return StartFacts(C).with(goal); }

}  // namespace kinegraph
