#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/ik/ik_nlp.h"
#include "kinegraph/komo/path_parameters.h"
#include "kinegraph/solvers/sensitivity/sensitivity.h"

namespace kinegraph {

/// A parameter of a problem, in words. Of a KOMO: an objective by its name, with `what` "target" (the default) or
/// "scale"; a frame, with "position" (the default) or "pose"; "start". Of an answer of solveIk: the name of a target's
/// frame or feature. Throws NameError with names that are near.
std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, const std::string& name, const std::string& what = "");

/// The same for the number of an objective or target.
std::shared_ptr<NlpParameter> parameterOf(const Nlp& nlp, int number, const std::string& what = "");

/// Per answer of solveIk, (dq/dp)^T v for all numbers p of its targets, a row each; `v` has a row per answer. Rows of
/// problems without an answer are nan. The same bits for any number of threads.
MatrixXd ikGradients(const std::vector<IkResult>& results, const MatrixXd& v, int threads = 1);

/// A parameter for each target of an answer of solveIk.
NlpParameters ikTargets(const Nlp& nlp);

}  // namespace kinegraph
