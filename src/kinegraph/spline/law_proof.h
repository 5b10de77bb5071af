#pragma once

#include <array>

#include "kinegraph/spline/law_grid.h"

namespace kinegraph {

/// How much of its limits a motion uses at most in an interval of a grid where s'^2 is a quadratic with the Bernstein
/// coefficients `b`: velocity, acceleration, jerk, each as a share. Bounds: polynomials keep within their Bernstein
/// coefficients. Jerks are looked at where they are limited.
std::array<double, 3> limitShares(const LawGrid& grid, int interval, const std::array<double, 3>& b,
                                  const MotionLimits& limits);

}  // namespace kinegraph
