#include "kinegraph/task_planning/placements.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <set>

#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using Eigen::Vector2d;

constexpr double kSoleHeight = .01;                ///< m: the lowest part of an object is its footprint
constexpr double kRoundness = .02;                 ///< relative tolerance of the radius of round footprints
constexpr double kLargePlace = .6;                 ///< m: places with longer sides are large
constexpr double kEnough = .04;                    ///< m: more room between objects is not better
constexpr double kSpread = .06;                    ///< m: maximum room between objects that are put down together
constexpr double kLeastRoom = .004;                ///< m: minimum room around a whole footprint
constexpr double kSearchRadius = .5, kRing = .04;  ///< m: radius of the search on large places, and its steps
constexpr int kGrid = 25;                          ///< candidates along each side of a place
constexpr int kDirections = 16;
constexpr double kFlat = 1e-3;  ///< m: what is not higher than this above a place is no obstacle

/// A rectangle along the axes of a place.
struct Rectangle {
  Vector2d center, half;
};

double roomBetween(const Rectangle& a, const Rectangle& b) {
  return ((a.center - b.center).cwiseAbs() - a.half - b.half).maxCoeff();
}

/// The room of an object at the edges of its place.
double roomInside(const Rectangle& rectangle, const Vector2d& half) {
  return (half - rectangle.half - rectangle.center.cwiseAbs()).minCoeff();
}

/// The frames with an active joint, from a frame upwards.
std::set<std::string> jointsAbove(const Frame& frame) {
  std::set<std::string> moving;
  for (std::optional<Frame> up = frame; up; up = up->getParent())
    if (up->data().moves()) moving.insert(up->getName());
  return moving;
}

/// Plans placements action by action.
class Packing {
 public:
  Packing(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants)
      : C_(C), actions_(actions), variants_(variants) {
    for (const TaskAction& action : actions)
      if (action[0] == "place") places_.insert(action[3]);
  }

  std::vector<std::optional<Placement>> all() {
    std::vector<std::optional<Placement>> placements;
    for (std::size_t i = 0; i < actions_.size(); ++i) {
      const TaskAction& action = actions_[i];
      placements.emplace_back();
      if (action[0] != "place") continue;
      const Vector2d half = .5 * placeSides(C_.getFrame(action[3]));
      const bool is_large = 2. * half.minCoeff() > kLargePlace;
      placements.back() = is_large ? nearby(i, half) : packed(i, half);
      at_[action[1]] = C_.getFrame(action[3]).getPose().transform() *
                       Vector3d(placements.back()->at.x(), placements.back()->at.y(), 0.);
    }
    return placements;
  }

 private:
  Matrix3d rotationOf(const std::string& obj) const {
    for (std::size_t i = 0; i < std::min(variants_.size(), actions_.size()); ++i)
      if (actions_[i][0] == "place" && actions_[i][1] == obj && variants_[i] == "upright") return Matrix3d::Identity();
    return restingRotation(C_.getFrame(obj));
  }

  /// The placement of an object among those that the sequence puts on the same place.
  Placement packed(std::size_t i, const Vector2d& half) {
    const std::string &obj = actions_[i][1], &to = actions_[i][3];
    auto& known = packed_[to];
    if (known.empty()) {
      std::vector<std::string> objects;
      for (const TaskAction& action : actions_)
        if (action[0] == "place" && action[3] == to && std::ranges::find(objects, action[1]) == objects.end())
          objects.push_back(action[1]);
      known = layout(to, objects, half, i);
    }
    return known.at(obj);
  }

  std::map<std::string, Placement> layout(const std::string& to, const std::vector<std::string>& objects,
                                          const Vector2d& half, std::size_t before) const {
    std::vector<Footprint> footprints;
    for (const std::string& obj : objects) footprints.push_back(footprintOf(C_.getFrame(obj), rotationOf(obj)));
    double height = 0.;
    for (const Footprint& footprint : footprints) height = std::max(height, footprint.height);
    const std::vector<Rectangle> obstacles = obstaclesOn(to, height, half, before);
    std::vector<Placement> chosen = rows(footprints, half);
    if (leastRoom(chosen, footprints, obstacles, half) < (obstacles.empty() ? kLeastRoom : kEnough)) {
      const std::vector<Placement> others = oneByOne(footprints, obstacles, half);
      if (leastRoom(others, footprints, obstacles, half) > leastRoom(chosen, footprints, obstacles, half))
        chosen = others;
    }
    std::map<std::string, Placement> placements;
    for (std::size_t k = 0; k < objects.size(); ++k) {
      chosen[k].is_whole = roomOf(k, chosen, footprints, obstacles, half) >= kLeastRoom;
      placements[objects[k]] = chosen[k];
    }
    return placements;
  }

  static Rectangle rectangleOf(const Placement& placement, const Footprint& footprint) {
    const Vector2d half = footprint.is_round ? Vector2d::Constant(footprint.radius) : footprint.half();
    return {placement.at, placement.angle == 0. ? half : Vector2d(half.y(), half.x())};
  }

  /// The room around one of several objects.
  static double roomOf(std::size_t k, const std::vector<Placement>& placements,
                       const std::vector<Footprint>& footprints, const std::vector<Rectangle>& obstacles,
                       const Vector2d& half) {
    const Rectangle own = rectangleOf(placements[k], footprints[k]);
    double room = 2. * roomInside(own, half);
    for (const Rectangle& obstacle : obstacles) room = std::min(room, roomBetween(own, obstacle));
    for (std::size_t other = 0; other < placements.size(); ++other)
      if (other != k) room = std::min(room, roomBetween(own, rectangleOf(placements[other], footprints[other])));
    return room;
  }

  static double leastRoom(const std::vector<Placement>& placements, const std::vector<Footprint>& footprints,
                          const std::vector<Rectangle>& obstacles, const Vector2d& half) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < placements.size(); ++k)
      least = std::min(least, roomOf(k, placements, footprints, obstacles, half));
    return least;
  }

  /// Objects in rows and columns around the middle, with the most room between them.
  static std::vector<Placement> rows(const std::vector<Footprint>& footprints, const Vector2d& half) {
    const int count = int(footprints.size());
    std::vector<Placement> best;
    double most = -std::numeric_limits<double>::infinity();
    for (int columns = count; columns >= 1; --columns) {
      const int lines = (count + columns - 1) / columns;
      for (const double angle : {0., .5 * std::numbers::pi}) {
        Vector2d largest = Vector2d::Zero();
        for (const Footprint& footprint : footprints)
          largest = largest.cwiseMax(rectangleOf({.angle = angle}, footprint).half);
        const Vector2d cell =
            (2. * half.array() / Eigen::Array2d(columns, lines)).min(2. * largest.array() + kSpread).matrix();
        std::vector<Placement> placements;
        for (int k = 0; k < count; ++k) {
          const int line = k / columns, in_line = std::min(columns, count - line * columns);
          placements.push_back(
              {.at = {(k % columns - .5 * (in_line - 1)) * cell.x(), (line - .5 * (lines - 1)) * cell.y()},
               .angle = angle});
        }
        const double room = std::min(leastRoom(placements, footprints, {}, half), kSpread);
        if (room > most + 1e-9) most = room, best = std::move(placements);
      }
    }
    return best;
  }

  /// Objects one after the other, the large ones first, each where it has the most room.
  static std::vector<Placement> oneByOne(const std::vector<Footprint>& footprints,
                                         const std::vector<Rectangle>& obstacles, const Vector2d& half) {
    std::vector<std::size_t> order(footprints.size());
    for (std::size_t k = 0; k < order.size(); ++k) order[k] = k;
    std::ranges::stable_sort(order, std::greater(), [&](std::size_t k) { return footprints[k].radius; });
    std::vector<Placement> placements(footprints.size());
    std::vector<Rectangle> taken = obstacles;
    for (const std::size_t k : order) {
      double most = -std::numeric_limits<double>::infinity(), middle = 0.;
      for (const double angle : {0., .5 * std::numbers::pi})
        for (int a = 0; a < kGrid; ++a)
          for (int b = 0; b < kGrid; ++b) {
            Placement placement{.angle = angle};
            const Vector2d range = half - rectangleOf(placement, footprints[k]).half;
            placement.at = Vector2d(range.x() * (2. * a / (kGrid - 1) - 1.), range.y() * (2. * b / (kGrid - 1) - 1.));
            const Rectangle own = rectangleOf(placement, footprints[k]);
            double room = std::min(2. * roomInside(own, half), kEnough);
            for (const Rectangle& other : taken) room = std::min(room, roomBetween(own, other));
            const double off = placement.at.norm();
            if (room < most - 1e-9 || (room < most + 1e-9 && off >= middle - 1e-9)) continue;
            most = room, middle = off, placements[k] = placement;
          }
      taken.push_back(rectangleOf(placements[k], footprints[k]));
    }
    return placements;
  }

  /// A free spot on a large place near the object.
  Placement nearby(std::size_t i, const Vector2d& half) {
    const std::string &obj = actions_[i][1], &to = actions_[i][3];
    const Footprint footprint = footprintOf(C_.getFrame(obj), rotationOf(obj));
    const RigidTransform to_place = C_.getFrame(to).getPose().inverse().transform();
    const Vector3d world = at_.contains(obj) ? at_.at(obj) : C_.getFrame(obj).getPosition();
    const Vector2d inside = (half.array() - footprint.radius - kEnough).max(0.);  // it may come from elsewhere
    const Vector2d start = Vector3d(to_place * world).head<2>().cwiseMax(-inside).cwiseMin(inside);
    std::vector<Rectangle> obstacles = obstaclesOn(to, footprint.height, half, i);
    for (const Rectangle& other : taken_[to]) obstacles.push_back(other);
    Placement best{.is_near = true};
    double most = -std::numeric_limits<double>::infinity();
    for (double radius = 0.; radius <= kSearchRadius && most < kEnough; radius += kRing)
      for (int k = 0; k < (radius == 0. ? 1 : kDirections) && most < kEnough; ++k) {
        const double angle = 2. * std::numbers::pi * k / kDirections;
        const Rectangle own{start + radius * Vector2d(std::cos(angle), std::sin(angle)),
                            Vector2d::Constant(footprint.radius)};
        double room = std::min(roomInside(own, half), kEnough);
        for (const Rectangle& other : obstacles) room = std::min(room, roomBetween(own, other));
        if (room > most + 1e-9) most = room, best.at = own.center;
      }
    best.is_whole = roomInside({best.at, Vector2d::Constant(footprint.radius)}, half) >= kLeastRoom;
    taken_[to].push_back({best.at, Vector2d::Constant(footprint.radius)});
    return best;
  }

  /// What stands on a place, or next to it, when an action begins, and places of other actions.
  std::vector<Rectangle> obstaclesOn(const std::string& to, double height, const Vector2d& half,
                                     std::size_t before) const {
    std::set<std::string> moved;
    for (std::size_t i = 0; i < actions_.size(); ++i)
      if (isPlace(actions_[i]) ? actions_[i][3] == to || i <= before : i < before && !isHold(actions_[i]))
        moved.insert(objectOf(actions_[i]));
    const Frame place = C_.getFrame(to);
    const std::set<std::string> joints = jointsAbove(place);
    const RigidTransform X = place.getPose().inverse().transform();
    double top = -std::numeric_limits<double>::infinity();
    for (const Vector3d& corner : boxCorners(place)) top = std::max(top, corner.z());
    std::vector<Rectangle> obstacles;
    for (const Frame& frame : C_.getFrames()) {
      const auto& shape = frame.data().shape;
      const bool is_target = places_.contains(frame.getName());
      if (!shape || frame == place || (!shape->contact && !is_target) || jointsAbove(frame) != joints) continue;
      bool is_moved = false;
      for (std::optional<Frame> up = frame; up; up = up->getParent()) is_moved |= moved.contains(up->getName());
      if (is_moved) continue;
      Eigen::AlignedBox3d around;
      const RigidTransform of_frame = frame.getPose().transform();
      for (const Vector3d& corner : boxCorners(frame)) around.extend(X * (of_frame * corner));
      if (around.isEmpty() || around.max().z() < top + (is_target ? -.02 : kFlat) || around.min().z() > top + height)
        continue;
      const Rectangle rectangle{.5 * (around.min() + around.max()).head<2>(),
                                .5 * (around.max() - around.min()).head<2>()};
      if (is_target && around.contains(Vector3d(0., 0., around.center().z())) &&
          rectangle.half.minCoeff() >= half.minCoeff())
        continue;  // the larger place below this one
      if (roomBetween(rectangle, {Vector2d::Zero(), half}) < kEnough) obstacles.push_back(rectangle);
    }
    return obstacles;
  }

  const Config& C_;
  const std::vector<TaskAction>& actions_;
  const std::vector<std::string>& variants_;
  std::set<std::string> places_;
  std::map<std::string, std::map<std::string, Placement>> packed_;  ///< by place and object
  std::map<std::string, std::vector<Rectangle>> taken_;             ///< spots chosen on large places
  std::map<std::string, Vector3d> at_;                              ///< positions of objects in the world
};

}  // namespace

Footprint footprintOf(const Frame& body, const Matrix3d& rotation) {
  const RigidTransform X = RigidTransform{rotation, Vector3d::Zero()} * body.getPose().inverse().transform();
  std::vector<Vector3d> points;
  for (const Frame& part : shapesOf(body)) {
    const RigidTransform of_part = part.getPose().transform();
    for (const Vector3d& point : isBox(part) ? boxCorners(part) : shapePoints(part))
      points.push_back(X * (of_part * point));
  }
  Footprint footprint;
  if (points.empty()) return footprint;
  const auto [lowest, highest] = std::ranges::minmax(points, {}, [](const Vector3d& p) { return p.z(); });
  footprint.height = highest.z() - lowest.z();
  Eigen::AlignedBox2d around;
  for (const Vector3d& point : points) {
    if (point.z() > lowest.z() + kSoleHeight) continue;
    around.extend(point.head<2>());
    footprint.radius = std::max(footprint.radius, point.head<2>().norm());
  }
  footprint.low = around.min();
  footprint.high = around.max();
  const Vector2d half = footprint.half();
  footprint.is_round = half.minCoeff() > (1. - kRoundness) * footprint.radius;
  return footprint;
}

std::vector<std::optional<Placement>> placementsOf(const Config& C, const std::vector<TaskAction>& actions,
                                                   const std::vector<std::string>& variants) {
  return Packing(C, actions, variants).all();
}

}  // namespace kinegraph::inline task_planning_internal
