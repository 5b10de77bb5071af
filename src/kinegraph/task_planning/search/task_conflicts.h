#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/grounding.h"
#include "kinegraph/task_planning/search/task_proofs.h"

namespace kinegraph::inline task_planning_internal {

// Translates failures in geometry to logic: which actions and facts exclude each other.

/// A subsequence of actions, and the number of actions before the first of them.
struct ActionsAlone {
  std::vector<TaskAction> actions;
  std::size_t before = 0;
};

/// Returns the last action with those that gave the hand its object or handle, and the actions on doors in between.
ActionsAlone actionsAlone(const std::vector<TaskAction>& actions);

/// Whether the first action picks an object from its initial place, or takes a handle.
bool startsWithPick(const std::vector<TaskAction>& actions, const std::vector<Literal>& start);

/// Returns the objects that no action mentions.
std::vector<std::string> objectsWithout(const std::vector<TaskAction>& actions, const std::vector<Literal>& start);

/// An initial fact that puts an object on a place that an action uses, and the object.
struct InTheWay {
  Literal fact;
  std::string obj;
};
std::vector<InTheWay> inTheWay(const TaskAction& action, const std::vector<Literal>& start);

/// Returns the initial facts on which a failure depends: another grasp may succeed, and a carrier may bring the objects
/// on it within reach.
std::vector<Literal> whileFacts(const std::vector<TaskAction>& alone, const std::vector<Literal>& start);

/// Returns an object that would stand on itself, directly or not, in one of the states; "" if there is none.
std::string standsOnItself(const std::vector<std::vector<Literal>>& states);

/// Returns the causes of a minimal set of proofs that leaves no plan: unnecessary proofs are dropped one by one.
std::string neededProofs(const GroundProblem& ground, const std::vector<ImpossibleAction>& proofs);

/// Returns a sentence with a minimal set of literals of the goal that no sequence of actions reaches together.
std::string contradiction(const LogicProblem& problem);

}  // namespace kinegraph::inline task_planning_internal
