#include "kinegraph/parsers/xml/axis_motion.h"

#include <cmath>
#include <optional>
#include <utility>

namespace kinegraph::inline parsers_internal {

namespace {

/// Index (0 x, 1 y, 2 z) and sign, if `axis` is exactly a coordinate axis.
std::optional<std::pair<int, double>> coordinateAxis(const Vector3d& axis) {
  for (int i = 0; i < 3; ++i) {
    if (std::abs(axis[i]) == 1.) return std::pair(i, axis[i]);
  }
  return std::nullopt;
}

}  // namespace

AxisMotion rotationAbout(const Vector3d& axis) {
  static const char* const hinges[] = {"hingeX", "hingeY", "hingeZ"};
  const auto coordinate = coordinateAxis(axis);
  return {coordinate && coordinate->second > 0. ? hinges[coordinate->first] : "hinge"};
}

AxisMotion translationAlong(const Vector3d& axis) {
  static const char* const slides[] = {"transX", "transY", "transZ"};
  if (const auto coordinate = coordinateAxis(axis)) return {slides[coordinate->first], coordinate->second};
  return {"transX", 1., Quaterniond::FromTwoVectors(Vector3d::UnitX(), axis)};
}

}  // namespace kinegraph::inline parsers_internal
