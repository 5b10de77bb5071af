#pragma once

#include <Eigen/Dense>
#include <vector>

namespace kinegraph::inline task_planning_internal {

/// A convex polygon in the plane, counterclockwise, m.
using Polygon = std::vector<Eigen::Vector2d>;

/// Returns the convex hull of points (Andrew's monotone chain).
Polygon hullOf(Polygon points);

/// Returns the part of a polygon inside of a rectangle around the origin (Sutherland and Hodgman).
Polygon clipped(Polygon polygon, const Eigen::Vector2d& half);

/// Returns the distance of a point from a polygon, a line or a point, m: 0 inside, infinite if the polygon is empty.
double gapTo(const Eigen::Vector2d& point, const Polygon& polygon);

/// Returns the distance of a point from the nearest edge, m: positive inside, negative outside, and not positive for
/// lines and points; minus infinity if the polygon is empty.
double depthIn(const Eigen::Vector2d& point, const Polygon& polygon);

}  // namespace kinegraph::inline task_planning_internal
