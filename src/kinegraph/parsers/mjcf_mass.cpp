#include "kinegraph/parsers/mjcf_mass.h"

#include <cmath>

namespace kinegraph {

namespace {

/// From the mean squares of the coordinates.
SolidMass solid(double volume, const Vector3d& mean_squares) {
  return {volume, mean_squares.sum() * Vector3d::Ones() - mean_squares};
}

}  // namespace

std::optional<SolidMass> solidMass(const std::string& shape, const std::vector<double>& s) {
  if (shape == "box") return solid(s[0] * s[1] * s[2], Vector3d(s[0] * s[0], s[1] * s[1], s[2] * s[2]) / 12.);
  if (shape == "sphere") return solid(4. / 3. * M_PI * std::pow(s[0], 3), Vector3d::Constant(s[0] * s[0] / 5.));
  if (shape == "ssBoxElip") {
    const Vector3d radii(s[3], s[4], s[5]);
    return solid(4. / 3. * M_PI * radii.prod(), radii.cwiseAbs2() / 5.);
  }
  if (shape != "cylinder" && shape != "capsule") return std::nullopt;
  const double length = s[0], r = s[1], tube = M_PI * r * r * length;
  const double across = r * r / 4., along = length * length / 12.;
  if (shape == "cylinder") return solid(tube, {across, across, along});
  const double ball = 4. / 3. * M_PI * r * r * r, volume = tube + ball;
  const double ball_along = r * r / 5. + length * length / 4. + 3. / 8. * length * r;  // its halves are at the two ends
  const double sideways = (tube * across + ball * r * r / 5.) / volume;
  return solid(volume, {sideways, sideways, (tube * along + ball * ball_along) / volume});
}

}  // namespace kinegraph
