#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/logic/domain.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// The words of an action: (pick cup table hand).
using TaskAction = std::vector<std::string>;

/// A hand takes an object from where it stands: pick, lift (obj from hand).
bool isPick(const TaskAction& action);

/// A hand puts an object down: place, lay (obj hand to).
bool isPlace(const TaskAction& action);

/// An object begins to slide on its ground: push_start (obj from hand), hook_start (obj from hook tool hand).
bool startsSliding(const TaskAction& action);

/// An object has been slid to a place: push_end (obj hand to), hook_end (obj hook to tool hand).
bool endsSliding(const TaskAction& action);

/// Whether an action has the name of an action of defaultDomain.
bool isDefaultAction(const TaskAction& action);

/// Throws ValueError for an empty action, and for a default action with too few words.
void requireWords(const TaskAction& action);

/// The object of an action: its second word, or "".
std::string objectOf(const TaskAction& action);

/// The axes other than z that `lay` lets point up: zNeg x xNeg y yNeg.
const std::vector<std::string>& otherFaces();

/// Returns the default domain of planTask. Its actions are:
///
/// - pick (obj from hand) for objects with nothing on them;
/// - lift (obj from hand) for objects labeled is_carrier, with everything that stands on them;
/// - place (obj hand to), handover (obj hand to);
/// - lay (obj hand to face) if the goal names the face that points up;
/// - pose (obj hand goal) for frames labeled is_pose;
/// - push_start (obj from hand) and push_end (obj hand to) for objects labeled is_pushable;
/// - hook_start (obj from hook tool hand) and hook_end (obj hook to tool hand), with a tool that has a part labeled
/// is_hook;
/// - hold, open and close (door handle hand) for frames labeled is_door or is_drawer that have a part labeled
/// is_handle.
LogicDomain defaultDomain();

/// Returns the initial facts: sceneFacts and, if these name no gripper, object or place, guesses from shapes and names.
/// Faces are added if the goal names a face that points up.
std::vector<Literal> taskFacts(const Config& C, const std::vector<Literal>& goal = {});

/// "(pick cup table hand) (place cup hand tray)"
std::string planText(const std::vector<TaskAction>& actions);

/// Formats a number with `digits` decimals: fixed(.0123, 2) is "0.01".
std::string fixed(double value, int digits);

/// Whether a fact is among the facts.
bool contains(const std::vector<Literal>& facts, const Literal& fact);

/// Returns the arguments of all facts of a unary predicate.
std::vector<std::string> wordsOf(const std::vector<Literal>& facts, const std::string& predicate);

/// From facts (on below above): maps each object to the one below it; the last fact counts.
std::map<std::string, std::string> whatIsBelow(const std::vector<Literal>& facts);

/// Returns the hand that an object is attached to, without an active joint in between; "" if there is none.
std::string holderOf(const Config& C, const std::string& obj, const std::vector<std::string>& hands);

/// Returns the objects that stand on a held object.
std::vector<std::string> carriedBy(const Config& C, const std::vector<std::string>& hands,
                                   const std::vector<std::string>& objects);

/// Returns the axis of a frame that points up, to 25 degrees: x y z xNeg yNeg zNeg; "" if none does.
std::string upOf(const Config& C, const std::string& name);

/// Returns the long axis of a bar (0 to 2); -1 for other frames.
int longAxis(const Frame& frame);

/// Whether the shape is a box, sharp or rounded.
bool isBox(const Frame& frame);

/// Returns the facts of a scene, in the order of its frames:
///
/// - a frame with `logical: { is_gripper, ... }`: a fact per label, `(is_gripper hand)`;
/// - another frame with a joint of type rigid and a shape: `(is_object cup)`, and is_box, is_sphere, is_capsule or
///   is_cylinder by its shape;
/// - among these frames: `(on table cup)` if the first frame with a joint, from cup upwards, is a child of the table,
/// and `(partOf cup handle)` for a frame that hangs below another of them without a joint.
std::vector<Literal> sceneFacts(const Config& C);

/// Returns the states of doors and drawers by name: "opened" (from 80 % of the joint's range on), "closed" (up to 5 %),
/// or "ajar". A door or drawer is a frame labeled is_door or is_drawer with an active joint of one dof with limits; it
/// is closed at the limit that is closer to zero.
std::map<std::string, std::string> doorStates(const Config& C);

class TaskWaypoints;

/// The geometric meaning of an action of planTask: the constraints of its waypoints, and its variants. For example:
///
///     TaskRule show{[](TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant) {
///                     const double height = variant == "high" ? 1.2 : .9;
///                     w.komo().addObjective({time}, FS::position, {action[1]}, OT::eq, row(0., 0., 10.), height);
///                   },
///                   [](const Config&, const TaskAction&) { return std::vector<std::string>{"high", "low"}; }};
///
/// Several threads may call both functions at the same time.
struct TaskRule {
  /// Adds the constraints of the action at a time (in phases), in one of its variants.
  std::function<void(TaskWaypoints& w, double time, const TaskAction& action, const std::string& variant)> add;

  /// Returns the names of its variants in a scene, the best first; none: the action is impossible.
  std::function<std::vector<std::string>(const Config& C, const TaskAction& action)> variants;
};

/// Rules by the names of the actions.
using TaskRules = std::map<std::string, TaskRule>;

/// Returns the rules of the actions of defaultDomain. `upright`: `place` puts objects down upright, and leaves other
/// faces to `lay`, for goals that name a face.
TaskRules defaultTaskRules(bool upright = false);

/// Returns the palm, the frame between the fingers of a hand and its arm that held objects must not enter; "" for hands
/// without one.
std::string palmOf(const Config& C, const std::string& hand);

/// Returns the opening of the fingers of a hand, m: the attribute `opening` of its frame, else .08 m for a hand with a
/// palm; none for a hand without fingers. Throws ValueError if the attribute is no number >= 0.
std::optional<double> opening(const Config& C, const std::string& hand);

/// Returns the scene with the attributes `opening` and, for fingers that do not close completely, `least_opening` at
/// the hands with modeled fingers (handFingersOf) that do not have them.
Config withOpenings(const Config& C, const std::vector<std::string>& hands);

/// Returns the grasps of an object by a hand. Boxes and meshes have the axes x, y, z along which the fingers can close,
/// the narrow ones first; cylinders and capsules `around`, balls `center`, and hands without fingers `touch`. None if
/// the object is too wide or too narrow. Throws ValueError for objects without a shape.
std::vector<std::string> graspVariants(const Config& C, const std::string& obj, const std::string& hand);

/// Whether the fingers of a hand fit an object, as it stands, along its upright axis only: from its side, with one of
/// them below it.
bool isTooWideAcross(const Config& C, const std::string& obj, const std::string& hand);

/// Returns at most `most` combinations of the variants of a sequence of actions, the best first. Throws NameError for
/// an action without a rule.
std::vector<std::vector<std::string>> allVariants(const Config& C, const std::vector<TaskAction>& actions,
                                                  const TaskRules& rules, std::size_t most);

}  // namespace kinegraph
