#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "kinegraph/solvers/sensitivity/sensitivity.h"

namespace kinegraph {

/// Returns a parameter by name. Of a KOMO: an objective, with `what` "target" (the default) or "scale"; a frame, with
/// "position" (the default) or "pose"; or "start". Of a solution of solveIk: the frame or feature of a target. Throws
/// NameError with similar names.
std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, const std::string& name, const std::string& what = "");

/// Returns the parameter of an objective or target by its index.
std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, int number, const std::string& what = "");

/// Returns (dq/dp)^T v for each solution of solveIk, one row each, over all numbers p of its targets; `v` has one row
/// per solution. Rows of unsolved problems are nan. The result does not depend on the number of threads, bit for bit.
MatrixXd ikGradients(const std::vector<IkResult>& results, const MatrixXd& v, int threads = 1);

/// Returns one parameter per target of a solution of solveIk.
NlpParameters ikTargets(const Nlp& nlp);

/// Solves independent motion problems, each from its present path, and stores each result in its problem; `chosen` is
/// the best. The result does not depend on the number of threads. Throws ValueError without problems or threads.

SolveManyResult solveAll(std::span<Komo> problems, const SolveManyOptions& options = {});

}  // namespace kinegraph
