#include "kinegraph/solvers/interface/options.h"

#include <algorithm>

namespace kinegraph {

std::string optMethodName(OptMethod method) {
  for (const OptMethodName& row : kOptMethods) {
    if (row.method == method) return row.name;
  }
  return cat(int(method));
}

double SolverOptions::constraintTolerance() const {
  return stopGTolerance >= 0. ? std::max(stopGTolerance, 1e-12) : std::min(stopTolerance, 1e-4);
}

void SolverOptions::validate() const { solverOptionTable().validate(*this); }

const OptionTable<SolverOptions, OptMethod>& solverOptionTable() {
  using O = SolverOptions;
  using R = OptionRange;
  static const OptionTable<SolverOptions, OptMethod> table(
      "NlpSolver",
      {{"verbose", &O::verbose, "", "0: silent, 1: a summary, 2: a line per outer iteration, 3: a line per step."},
       {"stopTolerance", &O::stopTolerance, "rad or m", "A step without larger entries counts as converged.",
        R::positive()},
       {"stopFTolerance", &O::stopFTolerance, "",
        "A path (more than 100 variables) converges if its constraints hold and the further relative decrease of the "
        "cost is estimated as less than a third of this or of stopTolerance. If steps are refused repeatedly and the "
        "relative decrease of the cost per evaluation is smaller, the solve stalls.",
        R::notNegative()},
       {"stopGTolerance", &O::stopGTolerance, "",
        "Largest accepted violation of a (scaled) constraint; < 0: stopTolerance, at most 1e-4."},
       {"stopEvals", &O::stopEvals, "", "Limit on evaluations per solve.", R::atLeastOne()},
       {"stopInners", &O::stopInners, "",
        "Limit on steps of sequential quadratic programming; the augmented Lagrangian may make 20 times as many."},
       {"stopOuters", &O::stopOuters, "", "Limit on outer iterations, which update the multipliers."},
       {"stepMax", &O::stepMax, "rad or m", "Largest entry of a step; grows after successful long steps.",
        R::positive()},
       {"damping", &O::damping, "", "Initial Levenberg damping, which the method adapts.", R::notNegative()},
       {"stepInc", &O::stepInc, "", "Factor of the step of gradientDescent after a success.", R::atLeastOne()},
       {"stepDec", &O::stepDec, "", "Factor of the step of gradientDescent after a failure.", R::betweenZeroAndOne()},
       {"wolfe", &O::wolfe, "", "A step is accepted if the decrease is at least this share of the predicted one.",
        R::belowOne()},
       {"muInit", &O::muInit, "", "Initial penalty weight.", R::positive()},
       {"muInc", &O::muInc, "",
        "Factor of the penalty weight after an outer iteration that reduced the violation too little.", R::aboveOne()},
       {"muMax", &O::muMax, "", "Largest penalty weight.", R::positive()},
       {"muLBInit", &O::muLBInit, "", "Initial weight of the log barrier.", R::positive()},
       {"muLBDec", &O::muLBDec, "", "Factor of the barrier weight per outer iteration.", R::betweenZeroAndOne()},
       {"lambdaMax", &O::lambdaMax, "", "Bound on the multipliers; <= 0: none."},
       {"interiorPadding", &O::interiorPadding, "", "Margin by which slackGN fulfills inequalities.", R::finite()},
       {"boundedNewton", &O::boundedNewton, "", "Respects the bounds of the problem."},
       {"finiteDifference", &O::finiteDifference, "rad or m",
        "> 0: replaces the Jacobian by central differences with this step."},
       {"method", &O::method, "", "The method, an OptMethod."}});
  return table;
}

}  // namespace kinegraph
