#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/grounding.h"

namespace kinegraph {

/// Returns the index of an action given as words, (pick cup table hand). Throws ValueError with similar actions.
int actionNumber(const GroundProblem& ground, const std::vector<std::string>& action);
std::vector<int> actionNumbers(const GroundProblem& ground, const std::vector<std::vector<std::string>>& actions);

/// Returns the words of actions: name, then arguments.
std::vector<std::vector<std::string>> actionWords(const GroundProblem& ground, const std::vector<int>& actions);

/// Returns indices of facts for PlanSearch::forbid. Throws ValueError for a fact that never changes, or can never hold.
std::vector<int> changingFacts(const GroundProblem& ground, const std::vector<Literal>& facts);

/// Returns the literals that hold at the start and after each action. Throws ValueError for an action whose
/// precondition does not hold.
std::vector<std::vector<Literal>> statesAlong(const GroundProblem& ground, const std::vector<int>& actions);

}  // namespace kinegraph
