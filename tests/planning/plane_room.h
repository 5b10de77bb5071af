#pragma once

#include <cmath>

#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {

/// A disc that moves in a plane.
inline Config disc(double radius) {
  Config C;
  C.addText("world: {}  disc(world): {joint: transXY, limits: [-2, -2, 2, 2]}");
  C.addFrame("body", "disc").setShape(ShapeType::cylinder, {.2, radius}).setContact(1);
  return C;
}

/// A disc, and a wall with a door of that width.
inline Config room(double door) {
  Config C = disc(.2);
  for (const double side : {-1., 1.}) {
    Frame wall = C.addFrame(side > 0. ? "right" : "left");
    wall.setShape(ShapeType::box, {.1, 3., 1.}).setPosition({0., side * (1.5 + .5 * door), 0.});
    wall.setContact(1);
  }
  return C;
}

struct Asked {
  Config C;
  JointSpace space{*C.model()};
  State scene = C.state();

  PathQuery request(int threads = 1, std::uint64_t seed = 0) {
    PathQuery request{
        .constraints = {&scene, &space}, .starts = {{VectorXd{{-1., 1.2}}}}, .goals = {{VectorXd{{1., 1.}}}}};
    request.threads = threads;
    request.seed = seed;
    return request;
  }
};

/// The least distance at configurations every 0.1 mm.
inline double leastDistance(Config& C, const std::vector<VectorXd>& points) {
  double least = 1.;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const int parts = 1 + int((points[i] - points[i - 1]).norm() / 1e-4);
    for (int k = 0; k <= parts; ++k) {
      C.setJointState(points[i - 1] + double(k) / parts * (points[i] - points[i - 1]));
      for (const Config::NearPair& pair : C.getCollisions(.1)) least = std::min(least, pair.distance);
    }
  }
  return least;
}

/// The length of a rope from (-1, 1.2) to (1, 1) around both corners of a door of .5, (-+.05, .25), at the disc's
/// radius: two tangents, two arcs, a line.
inline double tightenedLength() {
  const double to_start = std::hypot(.95, .95), to_goal = std::hypot(.95, .75), r = .2;
  const double arcs =
      1.5 * M_PI - (.75 * M_PI + std::acos(r / to_start)) + .5 * M_PI + (std::atan2(.75, .95) - std::acos(r / to_goal));
  return std::sqrt(to_start * to_start - r * r) + std::sqrt(to_goal * to_goal - r * r) + r * arcs + .1;
}

}  // namespace kinegraph
