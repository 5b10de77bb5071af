#pragma once

#include <string>

namespace kinegraph {

/// Solution methods. The numbers are those of the Python enum `ry.OptMethod`.
enum class OptMethod : int {
  none = 0,
  gradientDescent = 1,
  rprop = 2,
  LBFGS = 3,
  newton = 4,
  augmentedLag = 5,
  logBarrier = 6,
  slackGN_logBarrier = 7,
  squaredPenalty = 8,
  singleSquaredPenalty = 9,
  slackGN = 10,
  NLopt = 11,
  Ipopt = 12,
  slackGN_Ipopt = 13,
  Ceres = 14,
  LSBO = 15,
  greedy = 16,
  NelderMead = 17,
  CMA = 18,
  LS_CMA = 19,
  ES = 20,
};

std::string optMethodName(OptMethod method);

/// Settings of a solver. Names and roles are those that scripts know; where a default differs from older packages, it
/// is because the method converges where theirs stopped.
struct SolverOptions {
  OptMethod method = OptMethod::augmentedLag;
  int verbose = 1;               ///< 0 silent, 1 a summary, 2 a line per round, 3 a line per step
  double stopTolerance = 1e-4;   ///< a step with no larger entry counts as converged
  double stopFTolerance = 1e-4;  ///< kept for scripts; convergence is decided by step and violation
  double stopGTolerance =
      -1.;  ///< largest violation of a (scaled) constraint that counts as converged; < 0: stopTolerance, at most 1e-4
  int stopEvals = 1000;           ///< limit on evaluations
  int stopInners = 1000;          ///< limit on steps
  int stopOuters = 1000;          ///< limit on multiplier updates
  double stepMax = 1.;            ///< largest entry of a step (rad, m)
  double damping = .1;            ///< initial Levenberg damping; it is adapted from there on
  double stepInc = 1.5;           ///< growth of the step of gradientDescent
  double stepDec = .5;            ///< and how it shrinks
  double wolfe = 1e-3;            ///< a step is taken if the decrease is at least this part of the predicted one
  double muInit = 1.;             ///< first penalty weight
  double muInc = 10.;             ///< its growth, where a round did not reduce the violation enough
  double muMax = 1e7;             ///< its largest value
  double muLBInit = .1;           ///< first weight of the log barrier
  double muLBDec = .2;            ///< its factor from round to round
  double lambdaMax = -1.;         ///< bound on multipliers; < 0: none
  double interiorPadding = .01;   ///< how far inside of inequalities slackGN aims
  bool boundedNewton = true;      ///< respect the bounds of the problem
  double finiteDifference = -1.;  ///< > 0: the Jacobian by central differences with this step

  double constraintTolerance() const;

  /// Throws ValueError naming the first field that makes no sense.
  void validate() const;
};

}  // namespace kinegraph
