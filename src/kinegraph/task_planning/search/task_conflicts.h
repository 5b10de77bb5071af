#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/grounding.h"
#include "kinegraph/task_planning/search/task_proofs.h"

namespace kinegraph {

// What a failure in geometry says in logic: which actions and facts exclude each other.

/// Some of a sequence of actions, and how many come before the first of them.
struct ActionsAlone {
  std::vector<TaskAction> actions;
  std::size_t before = 0;
};

/// The last action, with those that gave the hand its object, or the handle, and what happened to doors in between.
ActionsAlone actionsAlone(const std::vector<TaskAction>& actions);

/// Is the first object picked where it is at the start, or is it a door?
bool startsWithPick(const std::vector<TaskAction>& actions, const std::vector<Literal>& start);

/// Objects that actions are not about.
std::vector<std::string> objectsWithout(const std::vector<TaskAction>& actions, const std::vector<Literal>& start);

/// A fact of the start that puts something where an action puts or takes its object, and what that is.
struct InTheWay {
  Literal fact;
  std::string obj;
};
std::vector<InTheWay> inTheWay(const TaskAction& action, const std::vector<Literal>& start);

/// Facts of the start on which a failure rests: another grasp may do what this one cannot, and what stands on a carrier
/// may be brought within reach.
std::vector<Literal> whileFacts(const std::vector<TaskAction>& alone, const std::vector<Literal>& start);

/// An object that would stand on what stands on it, in one of the states; "" if there is none.
std::string standsOnItself(const std::vector<std::vector<Literal>>& states);

/// The proofs that matter: with these alone there is no plan; those that can be left out one by one are.
std::string neededProofs(const GroundProblem& ground, const std::vector<ImpossibleAction>& proofs);

/// The fewest literals of the goal that no sequence of actions reaches together, in words.
std::string contradiction(const LogicProblem& problem);

}  // namespace kinegraph
