#include "kinegraph/task_planning/task_tools.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <set>

#include "kinegraph/geometry/shapes/mass.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph {

namespace {

constexpr double kFine = 1e-3;  ///< m

/// Returns the frames fixed to a body, the body first.
std::vector<Frame> fixedTo(const Frame& body) {
  std::vector<Frame> parts = {body};
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Frame& child : parts[i].getChildren())
      if (child.getJointType() == JointType::none) parts.push_back(child);
  return parts;
}

using Polygon = std::vector<Eigen::Vector2d>;  ///< convex, counterclockwise

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) { return a.x() * b.y() - a.y() * b.x(); }

/// The convex hull of points in the plane (Andrew's monotone chain).
Polygon hullOf(Polygon points) {
  const auto isBefore = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::ranges::sort(points, isBefore);
  Polygon hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t first = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= first + 2 && cross(hull.back() - hull[hull.size() - 2], point - hull.back()) <= 0.)
        hull.pop_back();
      hull.push_back(point);
    }
    if (hull.size() > 1) hull.pop_back();  // the other side begins there
    std::ranges::reverse(points);
  }
  return hull;
}

/// The part of a polygon inside of a rectangle around the origin (Sutherland and Hodgman).
Polygon clipped(Polygon polygon, const Eigen::Vector2d& half) {
  for (int edge = 0; edge < 4; ++edge) {
    const int axis = edge / 2;
    const double sign = edge % 2 ? -1. : 1.;
    const auto room = [&](const Eigen::Vector2d& p) { return half[axis] - sign * p[axis]; };
    Polygon kept;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Eigen::Vector2d &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
      if (room(a) >= 0.) kept.push_back(a);
      if (room(a) * room(b) < 0.) kept.push_back(a + room(a) / (room(a) - room(b)) * (b - a));
    }
    polygon = std::move(kept);
  }
  return polygon;
}

/// The distance of a point from a polygon, a line or a point, 0 inside; infinite if the polygon is empty.
double gapTo(const Eigen::Vector2d& point, const Polygon& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  bool is_inside = polygon.size() > 2;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Eigen::Vector2d &a = polygon[i], way = polygon[(i + 1) % polygon.size()] - a;
    is_inside = is_inside && cross(way, point - a) >= 0.;
    const double share = std::clamp(way.dot(point - a) / std::max(way.squaredNorm(), 1e-30), 0., 1.);
    nearest = std::min(nearest, (point - a - share * way).norm());
  }
  return is_inside ? 0. : nearest;
}

/// Returns the frames with an active joint, from a frame upwards.
std::set<std::string> movingAbove(const Frame& frame) {
  std::set<std::string> moving;
  for (std::optional<Frame> up = frame; up; up = up->getParent())
    if (up->data().moves()) moving.insert(up->getName());
  return moving;
}

double frictionOf(const Frame& frame) {
  constexpr double kUsual = 1.;
  const Node* said = frame.attributes().find("friction");
  const double* friction = said ? said->value.as<double>() : nullptr;
  return friction ? *friction : kUsual;
}

/// A mass and its position in the frame.
struct PointMass {
  double mass = 0.;
  Vector3d at = Vector3d::Zero();
};

PointMass saidMass(const Frame& part) {
  const auto& inertia = part.data().inertia;
  return inertia ? PointMass{inertia->mass, inertia->com} : PointMass();
}

PointMass surfaceMass(const Frame& part) {
  if (shapePoints(part).empty()) return {};
  const ShellMass shell = shellMass(*part.data().shape->geometry);
  return {shell.area, shell.com};
}

}  // namespace

Vector3d centerOfBody(const Frame& body) {
  const std::vector<Frame> parts = fixedTo(body);
  for (const auto massOf : {saidMass, surfaceMass}) {
    PointMass all;
    for (const Frame& part : parts) {
      const PointMass one = massOf(part);
      all.mass += one.mass;
      all.at += one.mass * (part.getPose(body).transform() * one.at);
    }
    if (all.mass > 0.) return all.at / all.mass;
  }
  return Vector3d::Zero();
}

FramePairs wedgedPairs(const Config& C, const std::vector<std::string>& hands, const std::vector<std::string>& objects,
                       double depth) {
  FramePairs pairs;
  for (const std::string& obj : objects) {
    const std::string hand = holderOf(C, obj, hands);
    if (hand.empty()) continue;
    const std::set<std::string> arm = movingAbove(C.getFrame(hand));
    Config scene = C;
    std::set<std::string> parts;
    for (const Frame& part : fixedTo(scene.getFrame(obj))) parts.insert(part.getName());
    scene.getFrame(obj).unLink();
    for (const Config::NearPair& pair : scene.getCollisions(-depth)) {
      const std::string a = scene.getFrame(pair.a).getName(), b = scene.getFrame(pair.b).getName();
      if (parts.contains(a) == parts.contains(b)) continue;
      const std::set<std::string> above = movingAbove(C.getFrame(parts.contains(a) ? b : a));
      if (std::ranges::any_of(above, [&](const std::string& joint) { return arm.contains(joint); }))
        pairs.emplace_back(a, b);
    }
  }
  return pairs;
}

void ignorePairs(Config& C, const FramePairs& pairs) {
  for (const auto& [a, b] : pairs) C.getFrame(a).data().no_contact.push_back(&C.getFrame(b).data());
  if (!pairs.empty()) C.scene()->structureChanged();
}

void includePairs(Config& C, const FramePairs& pairs) {
  for (const auto& [a, b] : pairs) {
    std::vector<FrameData*>& ignored = C.getFrame(a).data().no_contact;
    const auto found = std::ranges::find(ignored, &C.getFrame(b).data());
    if (found != ignored.end()) ignored.erase(found);
  }
  if (!pairs.empty()) C.scene()->structureChanged();
}

bool isCentered(const Vector3d& center) { return center.squaredNorm() < kFine * kFine; }

bool isSupported(const Frame& obj, const Frame& place) {
  const RigidTransform X = place.getPose().inverse().transform();
  std::vector<Vector3d> points;
  for (const Frame& part : shapesOf(obj))
    for (const Vector3d& point : shapePoints(part)) points.push_back(X * (part.getPose().transform() * point));
  double lowest = std::numeric_limits<double>::infinity();
  const double side = (X.R * Vector3d::UnitZ()).z() < 0. ? -1. : 1.;  // the place may be upside down
  for (const Vector3d& point : points) lowest = std::min(lowest, side * point.z());
  std::vector<Eigen::Vector2d> sole;
  for (const Vector3d& point : points)
    if (side * point.z() < lowest + kFine) sole.push_back(point.head<2>());
  const Vector3d center = X * (obj.getPose().transform() * centerOfBody(obj));
  return gapTo(center.head<2>(), clipped(hullOf(std::move(sole)), .5 * placeSides(place))) <= kFine;
}

std::vector<Frame> shapesOf(const Frame& body) {
  std::vector<Frame> parts = fixedTo(body);
  std::erase_if(parts, [](const Frame& part) { return shapePoints(part).empty(); });
  return parts;
}

int flatAxis(const Frame& bar, const Frame& tool) {
  Eigen::AlignedBox3d around;
  for (const Frame& part : shapesOf(tool))
    for (const Vector3d& point : shapePoints(part)) around.extend(part.getPose(bar).transform() * point);
  const int along = longAxis(bar);
  const Vector3d sizes = around.sizes();
  const int one = along == 0 ? 1 : 0, other = along == 2 ? 1 : 2;
  return sizes[other] <= sizes[one] ? other : one;
}

double tippingHeight(const Frame& obj, const Frame& place, double depth) {
  const double friction = .5 * (frictionOf(obj) + frictionOf(place));
  return friction > 0. ? depth / (2. * friction) : std::numeric_limits<double>::infinity();
}

}  // namespace kinegraph
