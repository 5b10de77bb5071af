#pragma once

#include <span>
#include <string>

namespace kinegraph::inline common_internal {

/// Guesses whether an angle that should be in rad is in degrees: a multiple of .5 from `least` up to two turns of
/// degrees. Computed angles in rad are no such multiples.
bool mayBeDegrees(double angle, double least);

/// Guesses whether sides that should be in m are in mm: all are at least 2, and one is at least 10. Halls are, objects
/// and links are not.
bool mayBeMillimeters(std::span<const double> sides);

/// Guesses whether a position that should be in m is in mm: a coordinate is from 100 to 10 000.
bool isMillimeterPosition(double x, double y, double z);

/// "did you mean radians? 90 degrees are 1.5708 rad"
std::string askForRadians(double angle);

/// "did you mean meters? 400 mm are 0.4 m"
std::string askForMeters(double length);

}  // namespace kinegraph::inline common_internal
