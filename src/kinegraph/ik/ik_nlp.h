#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/nlp/parameter.h"

namespace kinegraph {

/// Input of solveIk, which its results hold for makeNlp.
struct IkRequest {
  std::shared_ptr<const IkProblem> problem;
  std::vector<std::vector<IkTarget>> problems;
  std::vector<VectorXd> starts{};  ///< of the first attempts, (n,); empty: the q of the Config
};

/// Returns the optimization problem that an answer of solveIk solves, in the neighborhood of that answer. Targets are
/// equalities of q, or inequalities for bounds; near pairs are inequalities, and limits are bounds. If the answer was
/// moved close to a preferred configuration, the squared distance from it is the cost. Joints that move no target are
/// fixed by bounds. Throws ValueError for a result without a solution or without a request, such as one loaded from a
/// file.
std::shared_ptr<Nlp> makeNlp(const IkResult& result);

/// Returns the number of a target from the name of its frame or feature. Throws NameError unless exactly one matches.
int ikTargetNumber(const Nlp& nlp, const std::string& name);

int ikTargetCount(const Nlp& nlp);

/// Returns the numbers of a target as a parameter, in their original order:
/// - position or gaze: x y z (m)
/// - pose: x y z, then a rotation vector r (rad) about its own origin, R <- exp(r) R
/// - rotation: the rotation vector alone
/// - direction or feature: its entries
///
/// Axes are those of the frame that the target is relative to. `nlp` comes from makeNlp. Throws ValueError if there is
/// no such target.
std::shared_ptr<NlpParameter> ikTarget(const Nlp& nlp, int target);

}  // namespace kinegraph
