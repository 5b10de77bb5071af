#pragma once

#include <vector>

#include "kinegraph/logic/grounding.h"

namespace kinegraph::inline logic_internal {

/// Sets the rules of derived predicates of a problem, in layers: the facts that a rule negates are of earlier layers.
/// Throws ValueError if a fact is derived from its own negation. Source: Apt, Blair, Walker, Towards a theory of
/// declarative knowledge, 1988 (stratified programs); Thiebaux, Hoffmann, Nebel, In defense of PDDL axioms, 2005.
void setDerivedRules(GroundProblem& ground, std::vector<GroundRule> rules);

/// Derives the facts of derived predicates from the others: they hold exactly if a rule for them does.
void deriveFacts(const GroundProblem& ground, FactSet& state);

}  // namespace kinegraph::inline logic_internal
