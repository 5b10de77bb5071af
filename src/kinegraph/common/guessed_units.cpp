#include "kinegraph/common/guessed_units.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "kinegraph/common/text.h"

namespace kinegraph::inline common_internal {

namespace {

constexpr double kTwoTurns = 720.;  // degrees
constexpr double kLeastSide = 2., kLongSide = 10.;
constexpr double kFar = 100., kFarthest = 1e4;  // beyond: geographic coordinates

}  // namespace

bool mayBeDegrees(double angle, double least) {
  const double size = std::abs(angle);
  return size >= least && size <= kTwoTurns && 2. * angle == std::round(2. * angle);
}

bool mayBeMillimeters(std::span<const double> sides) {
  if (sides.empty()) return false;
  const auto [shortest, longest] = std::ranges::minmax(sides);
  return shortest >= kLeastSide && longest >= kLongSide;
}

bool isMillimeterPosition(double x, double y, double z) {
  const double most = std::max({std::abs(x), std::abs(y), std::abs(z)});
  return most >= kFar && most <= kFarthest;
}

std::string askForRadians(double angle) {
  return cat("did you mean radians? ", angle, " degrees are ", angle * std::numbers::pi / 180., " rad");
}

std::string askForMeters(double length) {
  return cat("did you mean meters? ", length, " mm are ", length / 1000., " m");
}

}  // namespace kinegraph::inline common_internal
