#pragma once

#include <map>
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

}  // namespace kinegraph
