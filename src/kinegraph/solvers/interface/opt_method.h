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

}  // namespace kinegraph
