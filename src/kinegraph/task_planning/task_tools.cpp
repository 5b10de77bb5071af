#include "kinegraph/task_planning/task_tools.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "kinegraph/geometry/shapes/mass.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/task_planning/polygon.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kFine = 1e-3;                         ///< m
constexpr double kGripTorque = .0075 * kHoldingForce;  ///< N m, that pads of 2 cm withstand

/// Returns the frames fixed to a body, the body first.
std::vector<Frame> fixedTo(const Frame& body) {
  std::vector<Frame> parts = {body};
  for (std::size_t i = 0; i < parts.size(); ++i)
    for (const Frame& child : parts[i].getChildren())
      if (child.getJointType() == JointType::none) parts.push_back(child);
  return parts;
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

using Body = ShapeKind::Body;

bool isOfKind(const Frame& frame, Body body) {
  return frame.getShapeType() != ShapeType::none && shapeKind(frame.getShapeType()).body == body;
}

/// Whether a shape is round about its z axis, and rests on its side or its ends.
bool isRolling(const Frame& frame) { return isOfKind(frame, Body::cylinder) || isOfKind(frame, Body::capsule); }

bool hasSurface(const Frame& part) { return isBox(part) || !shapePoints(part).empty(); }

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
  if (!hasSurface(part)) return {};
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

double massOfBody(const Frame& body) {
  double mass = 0.;
  for (const Frame& part : fixedTo(body)) mass += saidMass(part).mass;
  return mass;
}

double leverOf(const Frame& body) {
  const double mass = massOfBody(body);
  const double usual = mass > 0. ? kGripTorque / (mass * kGravity.norm()) : std::numeric_limits<double>::infinity();
  const Node* said = body.attributes().find("lever");
  const double* lever = said ? said->value.as<double>() : nullptr;
  return lever ? std::min(*lever, usual) : usual;
}

double leverIn(const Frame& hand, const Frame& body) {
  const Vector3d center = body.getPose().transform() * centerOfBody(body) - hand.getPosition();
  const double across = std::abs(center.cross(Vector3d::UnitZ()).dot(hand.getRotationMatrix().col(0)));
  return std::max(across, .5 * std::sqrt(std::max(center.head<2>().squaredNorm() - across * across, 0.)));
}

double steadyAcceleration(const Frame& hand, const Frame& body) {
  constexpr double kShare = .6;  // of the torque that the weight leaves
  constexpr double kSpare = .2;  // of all torque: so much is taken to be left
  const double mass = massOfBody(body);
  const Vector3d center = body.getPose().transform() * centerOfBody(body) - hand.getPosition();
  const double arm = center.cross(hand.getRotationMatrix().col(0)).norm();
  if (!(mass * arm > 0.)) return std::numeric_limits<double>::infinity();
  const double left = kGripTorque - mass * kGravity.norm() * leverIn(hand, body);
  return kShare * std::max(left, kSpare * kGripTorque) / (mass * arm);
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

double supportOf(const Frame& obj, const Frame& place) {
  const RigidTransform X = place.getPose().inverse().transform();
  std::vector<Vector3d> points;
  for (const Frame& part : shapesOf(obj))
    for (const Vector3d& point : shapePoints(part)) points.push_back(X * (part.getPose().transform() * point));
  double lowest = std::numeric_limits<double>::infinity();
  const double side = (X.R * Vector3d::UnitZ()).z() < 0. ? -1. : 1.;  // the place may be upside down
  for (const Vector3d& point : points) lowest = std::min(lowest, side * point.z());
  Polygon sole;
  for (const Vector3d& point : points)
    if (side * point.z() < lowest + kFine) sole.push_back(point.head<2>());
  const Vector3d center = X * (obj.getPose().transform() * centerOfBody(obj));
  if (isBall(obj)) return (.5 * placeSides(place) - center.head<2>().cwiseAbs()).minCoeff();
  return depthIn(center.head<2>(), clipped(hullOf(std::move(sole)), .5 * placeSides(place)));
}

bool isBall(const Frame& obj) {
  return obj.getShapeType() != ShapeType::none && shapeKind(obj.getShapeType()).body == ShapeKind::Body::ball;
}

Matrix3d restingRotation(const Frame& obj) {
  constexpr double kRests = .94;  // cosine: other shapes that stand still rest on any side
  if (isBall(obj)) return Matrix3d::Identity();
  const bool is_round = isRolling(obj);
  Vector3d up = obj.getRotationMatrix().row(2);
  Eigen::Index axis = 0;
  up.cwiseAbs().maxCoeff(&axis);
  if (is_round && axis != 2) {
    up = Vector3d(up.x(), up.y(), 0.).normalized();
  } else if (is_round || isBox(obj) || std::abs(up[axis]) > kRests || !movingAbove(obj).empty()) {
    up = (up[axis] < 0. ? -1. : 1.) * Vector3d::Unit(axis);
  }
  if (up == Vector3d::UnitZ()) return Matrix3d::Identity();
  const Vector3d about = up.cross(Vector3d::UnitZ());
  Matrix3d R =
      Eigen::AngleAxisd(std::atan2(about.norm(), up.z()), about.norm() > kFine ? about.normalized() : Vector3d::UnitX())
          .toRotationMatrix();
  if (is_round && axis != 2) R = Eigen::AngleAxisd(-std::atan2(R(1, 2), R(0, 2)), Vector3d::UnitZ()) * R;
  return R;
}

double depthOfShape(const Frame& part, const RigidTransform& X) {
  if (isRolling(part)) {
    const std::vector<double> size = part.getSize();
    const double up = std::abs(X.R(2, 2)), level = std::sqrt(std::max(1. - up * up, 0.));
    const double caps = isOfKind(part, Body::capsule) ? size[1] : size[1] * level;
    return .5 * size[0] * up + caps - X.p.z();
  }
  double lowest = -std::numeric_limits<double>::infinity();
  for (const Vector3d& point : isBox(part) ? boxCorners(part) : shapePoints(part))
    lowest = std::max(lowest, -Vector3d(X * point).z());
  return lowest;
}

double depthBelow(const Frame& obj, const Matrix3d& rotation) {
  double depth = 0.;
  bool is_first = true;
  for (const Frame& part : shapesOf(obj)) {
    if (!part.data().shape->contact && !(part == obj)) continue;
    const double below = depthOfShape(part, RigidTransform{rotation, Vector3d::Zero()} * part.getPose(obj).transform());
    depth = is_first ? below : std::max(depth, below);
    is_first = false;
  }
  return depth;
}

bool isSupported(const Frame& obj, const Frame& place) { return supportOf(obj, place) >= -kFine; }

std::vector<Frame> shapesOf(const Frame& body) {
  std::vector<Frame> parts = fixedTo(body);
  std::erase_if(parts, [](const Frame& part) { return !hasSurface(part); });
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

}  // namespace kinegraph::inline task_planning_internal
