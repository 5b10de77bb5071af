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
      {{"verbose", &O::verbose, "", "0 silent, 1 a summary, 2 a line per round, 3 a line per step."},
       {"stopTolerance", &O::stopTolerance, "rad or m", "A step with no larger entry counts as converged.",
        R::positive()},
       {"stopFTolerance", &O::stopFTolerance, "",
        "Where steps are refused again and again, costs that fall by a smaller part an evaluation end it as stalled.",
        R::notNegative()},
       {"stopGTolerance", &O::stopGTolerance, "",
        "Largest violation of a (scaled) constraint that counts as none; < 0: stopTolerance, at most 1e-4."},
       {"stopEvals", &O::stopEvals, "", "Limit on evaluations, for each solve.", R::atLeastOne()},
       {"stopInners", &O::stopInners, "",
        "Limit on steps: of sequential quadratic programming so many, of the augmented Lagrangian 20 times as many."},
       {"stopOuters", &O::stopOuters, "", "Limit on rounds, which update the multipliers."},
       {"stepMax", &O::stepMax, "rad or m", "Largest entry of a step, until long steps have proved good.",
        R::positive()},
       {"damping", &O::damping, "", "Initial Levenberg damping; it is adapted from there on.", R::notNegative()},
       {"stepInc", &O::stepInc, "", "Growth of the step of gradientDescent.", R::atLeastOne()},
       {"stepDec", &O::stepDec, "", "How the step of gradientDescent shrinks.", R::betweenZeroAndOne()},
       {"wolfe", &O::wolfe, "", "A step is taken if the decrease is at least this part of the predicted one.",
        R::belowOne()},
       {"muInit", &O::muInit, "", "First penalty weight.", R::positive()},
       {"muInc", &O::muInc, "", "Its growth, where a round did not reduce the violation enough.", R::aboveOne()},
       {"muMax", &O::muMax, "", "Its largest value.", R::positive()},
       {"muLBInit", &O::muLBInit, "", "First weight of the log barrier.", R::positive()},
       {"muLBDec", &O::muLBDec, "", "Its factor from round to round.", R::betweenZeroAndOne()},
       {"lambdaMax", &O::lambdaMax, "", "Bound on multipliers; <= 0: none."},
       {"interiorPadding", &O::interiorPadding, "", "How far inside of inequalities slackGN aims.", R::finite()},
       {"boundedNewton", &O::boundedNewton, "", "Respects the bounds of the problem."},
       {"finiteDifference", &O::finiteDifference, "rad or m",
        "> 0: the Jacobian by central differences with this step."},
       {"method", &O::method, "", "Which of OptMethod."}});
  return table;
}

}  // namespace kinegraph
