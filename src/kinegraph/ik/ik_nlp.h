#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/nlp/parameter.h"

namespace kinegraph {

/// What solveIk was asked, which its results hold.
struct IkQuestion {
  std::shared_ptr<const IkProblem> problem;
  std::vector<std::vector<IkTarget>> problems;
};

/// The problem that an answer of solveIk solves, around it: its targets as equalities of q (or bounds, as inequalities),
/// the pairs that are near as inequalities, limits as bounds; and where the answer was to be near to a posture the
/// squared distance from it. Joints that move no target are given. Throws ValueError for a result that is no answer, or
/// that knows no question, as one that was loaded.
std::shared_ptr<Nlp> makeNlp(const IkResult& result);

/// Number of a target, by the name of its frame or feature. Throws NameError if there is none, or more than one.
int ikTargetNumber(const Nlp& nlp, const std::string& name);

int ikTargetCount(const Nlp& nlp);

/// The numbers of a target, in the order in which they were given: of a position or gaze x y z (m); of a pose these and a
/// rotation vector (rad), by which it is turned about its own origin, R <- exp(r) R; of a rotation the vector alone; of a
/// direction its entries; of a feature its value. With axes of what the target is relative to. `nlp` is that of a result.
/// Throws ValueError for a target that is not there.
std::shared_ptr<NlpParameter> ikTarget(const Nlp& nlp, int target);

}  // namespace kinegraph
