#include "kinegraph/solvers/interface/options.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

std::string optMethodName(OptMethod method) {
  constexpr const char* names[] = {"none",
                                   "gradientDescent",
                                   "rprop",
                                   "LBFGS",
                                   "newton",
                                   "augmentedLag",
                                   "logBarrier",
                                   "slackGN_logBarrier",
                                   "squaredPenalty",
                                   "singleSquaredPenalty",
                                   "slackGN",
                                   "NLopt",
                                   "Ipopt",
                                   "slackGN_Ipopt",
                                   "Ceres",
                                   "LSBO",
                                   "greedy",
                                   "NelderMead",
                                   "CMA",
                                   "LS_CMA",
                                   "ES"};
  const int number = int(method);
  return number >= 0 && number < int(std::size(names)) ? names[number] : cat(number);
}

double SolverOptions::constraintTolerance() const {
  return stopGTolerance >= 0. ? std::max(stopGTolerance, 1e-12) : std::min(stopTolerance, 1e-4);
}

void SolverOptions::validate() const {
  const auto positive = [](const char* name, double value) {
    if (!(value > 0.) || !std::isfinite(value))
      throw ValueError(cat("option ", name, " is ", value, "; expected a positive number"));
  };
  positive("stopTolerance", stopTolerance);
  positive("stepMax", stepMax);
  positive("muInit", muInit);
  positive("muMax", muMax);
  positive("muLBInit", muLBInit);
  if (!(muLBDec > 0. && muLBDec < 1.))
    throw ValueError(cat("option muLBDec is ", muLBDec, "; expected a number > 0 and < 1"));
  if (!(stepInc >= 1.)) throw ValueError(cat("option stepInc is ", stepInc, "; expected a number >= 1"));
  if (!(stepDec > 0. && stepDec < 1.))
    throw ValueError(cat("option stepDec is ", stepDec, "; expected a number > 0 and < 1"));
  if (!(damping >= 0.)) throw ValueError(cat("option damping is ", damping, "; expected a number >= 0"));
  if (!(muInc > 1.)) throw ValueError(cat("option muInc is ", muInc, "; expected a number > 1"));
  if (!(wolfe >= 0. && wolfe < 1.))
    throw ValueError(cat("option wolfe is ", wolfe, "; expected a number >= 0 and < 1"));
  if (std::isnan(stopGTolerance))
    throw ValueError("option stopGTolerance is nan; expected a number, < 0 for the default");
  if (stopEvals < 1) throw ValueError(cat("option stopEvals is ", stopEvals, "; expected at least 1"));
}

}  // namespace kinegraph
