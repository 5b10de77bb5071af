#pragma once

#include <string>
#include <vector>

#include "kinegraph/logic/grounding.h"

namespace kinegraph {

/// The number of an action that is told in words, (pick cup table hand). Throws ValueError with those that are near.
int actionNumber(const GroundProblem& ground, const std::vector<std::string>& action);
std::vector<int> actionNumbers(const GroundProblem& ground, const std::vector<std::vector<std::string>>& actions);

/// The words of all of them: name, then arguments.
std::vector<std::vector<std::string>> actionWords(const GroundProblem& ground, const std::vector<int>& actions);

/// Numbers of facts for PlanSearch::forbid. Throws ValueError for one that never changes, or can never hold.
std::vector<int> changingFacts(const GroundProblem& ground, const std::vector<Literal>& facts);

/// The literals that hold at the start and after each action. Throws ValueError for an action that is not possible then.
std::vector<std::vector<Literal>> statesAlong(const GroundProblem& ground, const std::vector<int>& actions);

}  // namespace kinegraph
