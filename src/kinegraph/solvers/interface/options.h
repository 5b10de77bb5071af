#pragma once

#include <string>

#include "kinegraph/common/option_table.h"

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

/// An entry of the table of methods.
struct OptMethodName {
  OptMethod method;
  const char* name;
  const char* doc;  ///< one line
};

/// All methods with their names and descriptions.
inline constexpr OptMethodName kOptMethods[] = {
    {OptMethod::none, "none", "Not available; an error."},
    {OptMethod::gradientDescent, "gradientDescent", "Steps along the gradient. No constraints."},
    {OptMethod::rprop, "rprop", "Steps by the signs of the gradient. No constraints."},
    {OptMethod::LBFGS, "LBFGS", "Limited-memory quasi-Newton (BFGS). No constraints."},
    {OptMethod::newton, "newton", "Damped Gauss-Newton steps. No constraints."},
    {OptMethod::augmentedLag, "augmentedLag", "The default: the augmented Lagrangian. Constraints."},
    {OptMethod::logBarrier, "logBarrier", "A log barrier, from a strictly feasible start. Constraints."},
    {OptMethod::slackGN_logBarrier, "slackGN_logBarrier", "slackGN, then logBarrier. Constraints."},
    {OptMethod::squaredPenalty, "squaredPenalty", "Squared penalties of growing weight. Constraints."},
    {OptMethod::singleSquaredPenalty, "singleSquaredPenalty", "Squared penalties of one weight. Constraints."},
    {OptMethod::slackGN, "slackGN", "Gauss-Newton on the violation of the constraints; ignores costs."},
    {OptMethod::NLopt, "NLopt", "NLopt, with the extra kinegraph[nlopt]. Constraints."},
    {OptMethod::Ipopt, "Ipopt", "IPOPT, with the extra kinegraph[ipopt]. Constraints."},
    {OptMethod::slackGN_Ipopt, "slackGN_Ipopt", "slackGN, then Ipopt. Constraints."},
    {OptMethod::Ceres, "Ceres", "Not available; an error."},
    {OptMethod::LSBO, "LSBO", "Not available; an error."},
    {OptMethod::greedy, "greedy", "Not available; an error."},
    {OptMethod::NelderMead, "NelderMead", "The simplex method, without derivatives. No constraints."},
    {OptMethod::CMA, "CMA", "Covariance matrix adaptation, without derivatives. No constraints."},
    {OptMethod::LS_CMA, "LS_CMA", "Not available; an error."},
    {OptMethod::ES, "ES", "Not available; an error."},
};

/// Returns the name, or the number of a method that is not in the table.
std::string optMethodName(OptMethod method);

/// Options of a solver; solverOptionTable() documents each field. Names and meanings are those of the package robotic.
/// Some defaults differ, because they let the methods converge.
struct SolverOptions {
  int verbose = 1;
  double stopTolerance = 1e-4;
  double stopFTolerance = 1e-4;
  double stopGTolerance = -1.;
  int stopEvals = 1000;
  int stopInners = 1000;
  int stopOuters = 1000;
  double stepMax = 1.;
  double damping = .1;
  double stepInc = 1.5;
  double stepDec = .5;
  double wolfe = 1e-3;
  double muInit = 1.;
  double muInc = 10.;
  double muMax = 1e7;
  double muLBInit = .1;
  double muLBDec = .2;
  double lambdaMax = -1.;
  double interiorPadding = .01;
  bool boundedNewton = true;
  double finiteDifference = -1.;
  OptMethod method = OptMethod::augmentedLag;

  /// Returns the largest accepted violation: stopGTolerance or, if that is negative, stopTolerance, at most 1e-4.
  double constraintTolerance() const;

  /// Throws ValueError with the first invalid field.
  void validate() const;
};

/// Returns name, unit, meaning and range of each field, for messages, bindings and documents.
const OptionTable<SolverOptions, OptMethod>& solverOptionTable();

}  // namespace kinegraph
