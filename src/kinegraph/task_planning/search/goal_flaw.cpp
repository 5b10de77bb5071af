#include "kinegraph/task_planning/search/goal_flaw.h"

#include <algorithm>
#include <map>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/place_frames.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr char kGoals[] =
    "(on place object), (on hand object), (up face object), (posed object pose), (opened door) or (closed door)";

class GoalFlaw {
 public:
  GoalFlaw(const Config& C, const std::vector<Literal>& start) : C_(C), start_(start) {}

  std::string of(const Literal& literal) const {
    const std::vector<std::string>& words = literal.arguments;
    if (literal.negated) return "";
    if (literal.predicate == "on" && words.size() == 2) return ofOn(words[0], words[1]);
    if ((literal.predicate == "opened" || literal.predicate == "closed") && words.size() == 1) return ofDoor(words[0]);
    if (literal.predicate == "posed" && words.size() == 2 && !is("is_pose", words[1]))
      return cat("'", words[1], "' is no pose; label it with 'logical: { is_pose }'");
    if ((literal.predicate == "posed" || literal.predicate == "up") && words.size() == 2) {
      const std::string flaw = ofObject(words[literal.predicate == "up" ? 1 : 0]);
      return flaw.empty() ? ofHands() : flaw;
    }
    return cat("no action makes ", literal.str(), " true; a goal is ", kGoals);
  }

 private:
  bool is(const std::string& predicate, const std::string& name) const { return contains(start_, {predicate, {name}}); }

  std::string ofOn(const std::string& place, const std::string& obj) const {
    if (place == obj) return cat("'", obj, "' cannot stand on itself");
    if (!is("is_object", obj) && is("is_object", place) && is("is_place", obj))
      return cat(ofObject(obj), "; did you mean (on ", obj, " ", place, ")? The place comes first");
    const std::string flaws[] = {ofObject(obj), is("is_gripper", place) ? "" : ofPlace(place), ofHands()};
    for (const std::string& flaw : flaws)
      if (!flaw.empty()) return flaw;
    const std::map<std::string, std::string> below = whatIsBelow(start_);
    if (const auto now = below.find(obj); now != below.end()) {
      const std::string flaw = is("is_gripper", now->second) ? "" : ofPlace(now->second);
      return flaw.empty() ? "" : cat("'", obj, "' cannot be picked up where it stands: ", flaw);
    }
    const std::optional<Frame> parent = C_.getFrame(obj).getParent();
    return cat("'", obj, "' stands on no place", parent ? cat(" (it hangs below '", parent->getName(), "')") : "",
               "; put it on a place: a level box that no joint moves, or another object");
  }

  std::string ofObject(const std::string& name) const {
    const std::optional<Frame> frame = C_.findFrame(name);
    if (!frame || is("is_object", name)) return "";
    if (frame->getJointType() == JointType::rigid && frame->getShapeType() == ShapeType::none)
      return cat("'", name,
                 "' is no object: neither it nor a part fixed to it has a shape that collides; call setShape and "
                 "setContact(1)");
    if (frame->getJointType() == JointType::rigid)
      return cat("'", name, "' is no object: it carries joints, or it has labels without is_object");
    return cat("'", name,
               "' is no object: it has no rigid joint; call setJoint(JointType::rigid), or write 'joint: rigid' in its "
               "file");
  }

  std::string ofPlace(const std::string& name) const {
    const std::optional<Frame> frame = C_.findFrame(name);
    if (!frame || is("is_place", name)) return "";
    const auto named = [&](const char* predicate) {
      const std::vector<std::string> words = wordsOf(start_, predicate);
      return std::set<std::string>(words.begin(), words.end());
    };
    const std::string flaw = placeFlaw(*frame, named("is_object"), named("is_drawer"));
    return cat("'", name,
               "' is no place: ", flaw.empty() ? "only frames with the label is_place are, in this scene" : flaw);
  }

  std::string ofHands() const {
    if (!wordsOf(start_, "is_gripper").empty()) return "";
    return "no frame is a gripper; give the point between the fingers a name that ends with 'gripper', or label it "
           "with "
           "'logical: { is_gripper }'";
  }

  std::string ofDoor(const std::string& name) const {
    if (!is("is_guided", name))
      return cat("'", name, "' is no door or drawer; expected a frame labeled is_door or is_drawer, with an active ",
                 "joint of one dof with limits");
    const auto is_handle = [&](const Literal& fact) {
      return fact.predicate == "partOf" && fact.arguments[0] == name && is("is_handle", fact.arguments[1]);
    };
    if (std::ranges::none_of(start_, is_handle)) return cat("'", name, "' has no part labeled is_handle");
    return ofHands();
  }

  const Config& C_;
  const std::vector<Literal>& start_;
};

}  // namespace

std::string goalFlaw(const Config& C, const GroundProblem& ground) {
  const GoalFlaw flaw(C, ground.problem.start);
  std::vector<std::string> missing;
  for (const Literal& literal : ground.unreachable) {
    if (std::string reason = flaw.of(literal); !reason.empty()) return reason;
    missing.push_back(literal.str());
  }
  return cat("no sequence of actions makes ", join(missing, " and "), " true");
}

}  // namespace kinegraph::inline task_planning_internal
