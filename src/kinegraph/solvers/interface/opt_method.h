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

/// A row of the table of methods.
struct OptMethodName {
  OptMethod method;
  const char* name;
  const char* doc;  ///< a line
};

/// All methods, and what is to be known of them.
inline constexpr OptMethodName kOptMethods[] = {
    {OptMethod::none, "none", "Of older scripts; an error."},
    {OptMethod::gradientDescent, "gradientDescent", "Steps along the gradient. No constraints."},
    {OptMethod::rprop, "rprop", "Steps by the signs of the gradient. No constraints."},
    {OptMethod::LBFGS, "LBFGS", "Quasi-Newton with little memory. No constraints."},
    {OptMethod::newton, "newton", "Damped Gauss-Newton steps. No constraints."},
    {OptMethod::augmentedLag, "augmentedLag", "The default: the augmented Lagrangian. Constraints."},
    {OptMethod::logBarrier, "logBarrier", "A log barrier, from a start inside. Constraints."},
    {OptMethod::slackGN_logBarrier, "slackGN_logBarrier", "slackGN, then logBarrier. Constraints."},
    {OptMethod::squaredPenalty, "squaredPenalty", "Squared penalties that grow. Constraints."},
    {OptMethod::singleSquaredPenalty, "singleSquaredPenalty", "One squared penalty. Constraints."},
    {OptMethod::slackGN, "slackGN", "Gauss-Newton steps to the constraints; no costs."},
    {OptMethod::NLopt, "NLopt", "NLopt, with the extra kinegraph[nlopt]. Constraints."},
    {OptMethod::Ipopt, "Ipopt", "IPOPT, with the extra kinegraph[ipopt]. Constraints."},
    {OptMethod::slackGN_Ipopt, "slackGN_Ipopt", "slackGN, then Ipopt. Constraints."},
    {OptMethod::Ceres, "Ceres", "Of older scripts; an error."},
    {OptMethod::LSBO, "LSBO", "Of older scripts; an error."},
    {OptMethod::greedy, "greedy", "Of older scripts; an error."},
    {OptMethod::NelderMead, "NelderMead", "A simplex, without derivatives. No constraints."},
    {OptMethod::CMA, "CMA", "Evolution of a covariance, without derivatives. No constraints."},
    {OptMethod::LS_CMA, "LS_CMA", "Of older scripts; an error."},
    {OptMethod::ES, "ES", "Of older scripts; an error."},
};

/// Its number where it is none of the table.
std::string optMethodName(OptMethod method);

}  // namespace kinegraph
