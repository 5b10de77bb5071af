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

/// Something begins to slide on what it stands on: push_start (obj from hand), hook_start (obj from hook tool hand).
bool startsSliding(const TaskAction& action);

/// It has been slid somewhere: push_end (obj hand to), hook_end (obj hook to tool hand).
bool endsSliding(const TaskAction& action);

/// Throws ValueError for an action of a name that is known here with too few words, or with none.
void requireWords(const TaskAction& action);

/// What an action is about: its second word, or "".
std::string objectOf(const TaskAction& action);

/// The axes that can point up beside z, which `place` does: zNeg x xNeg y yNeg.
const std::vector<std::string>& otherFaces();

/// The domain of planTask where none is given: pick (obj from hand) for what nothing stands on, lift (obj from hand) for
/// what is called is_carrier, with all that stands on it, place (obj hand to), handover (obj hand to), lay (obj hand to
/// face) where the goal says which face is up, pose (obj hand goal) for frames that are called is_pose, push_start (obj
/// from hand) and push_end (obj hand to) for what is called is_pushable, hook_start (obj from hook tool hand) and hook_end
/// (obj hook to tool hand) with a tool of which a part is called is_hook, hold, open and close (door handle hand) for what
/// is called is_door or is_drawer, with a part that is called is_handle.
LogicDomain defaultDomain();

/// What holds at the start: what a scene says (sceneFacts) and, where that names no gripper, no object or no place, what
/// shapes and names suggest. There are faces where the goal says which face of something is up.
std::vector<Literal> taskFacts(const Config& C, const std::vector<Literal>& goal = {});

/// "(pick cup table hand) (place cup hand tray)"
std::string planText(const std::vector<TaskAction>& actions);

/// A number with so many digits behind the point: fixed(.0123, 2) is "0.01".
std::string fixed(double value, int digits);

/// Does a fact hold?
bool contains(const std::vector<Literal>& facts, const Literal& fact);

/// What a predicate of one argument holds of.
std::vector<std::string> wordsOf(const std::vector<Literal>& facts, const std::string& predicate);

/// Of facts (on below above): what each thing is on; the last one counts.
std::map<std::string, std::string> whatIsBelow(const std::vector<Literal>& facts);

/// The hand that an object hangs below without a joint of q in between; "" if there is none.
std::string holderOf(const Config& C, const std::string& obj, const std::vector<std::string>& hands);

/// Objects that stand on something that a hand holds.
std::vector<std::string> carriedBy(const Config& C, const std::vector<std::string>& hands,
                                   const std::vector<std::string>& objects);

/// The axis of a frame that points up, to 25 degrees: x y z xNeg yNeg zNeg; "" if none does.
std::string upOf(const Config& C, const std::string& name);

/// The axis along which a box is long (0 to 2), as of a bar; -1 for what is none, or not long.
int longAxis(const Frame& frame);

/// Is it a box, sharp or rounded?
bool isBox(const Frame& frame);

}  // namespace kinegraph
