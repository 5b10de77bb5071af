#include "kinegraph/task_planning/place_frames.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kLevel = .999;                       ///< cosine of level tops
constexpr double kLeastPlace = .05;                   ///< m: narrower tops are no places
constexpr double kTouch = .002;                       ///< m: an object that stands on a place is not farther away
constexpr double kOffAbove = .004, kOffBeside = .02;  ///< m: an object farther away is off its place

/// The joint that moves a frame and belongs to no drawer; "" for frames that stand still.
std::string jointOf(const Frame& frame, const std::set<std::string>& drawers) {
  for (std::optional<Frame> up = frame; up; up = up->getParent()) {
    const JointType type = up->getJointType();
    if (type != JointType::none && type != JointType::rigid && !drawers.contains(up->getName())) return up->getName();
  }
  return "";
}

/// The names of the places among the frames below one.
std::string placesBelow(const Frame& frame, const std::set<std::string>& drawers) {
  std::vector<std::string> names;
  for (const Frame& part : frame.getSubtree())
    if (!(part == frame) && hasTop(part) && placeFlaw(part, {}, drawers).empty()) names.push_back(part.getName());
  return join(names, ", ");
}

/// The place of an object relative to the top of a place.
struct Standing {
  double above = 0.;    ///< m: height of the lowest point of the object above the top
  double outside = 0.;  ///< m: distance of its origin from the sides; <= 0 inside
};

Standing standingOf(const Frame& obj, const Frame& place) {
  const RigidTransform X = place.getPose().inverse().transform();
  double lowest = std::numeric_limits<double>::infinity(), top = -lowest;
  for (const Frame& part : shapesOf(obj))
    for (const Vector3d& point : isBox(part) ? boxCorners(part) : shapePoints(part))
      lowest = std::min(lowest, (X * (part.getPose().transform() * point)).z());
  for (const Vector3d& corner : boxCorners(place)) top = std::max(top, corner.z());
  const Eigen::Vector2d at = Vector3d(X * obj.getPosition()).head<2>();
  const double outside =
      isBox(place) ? (at.cwiseAbs() - .5 * placeSides(place)).maxCoeff() : at.norm() - .5 * diagonalOf(place, 2);
  return {lowest - top, outside};
}

}  // namespace

std::string placeFlaw(const Frame& frame, const std::set<std::string>& objects, const std::set<std::string>& drawers) {
  if (!hasTop(frame)) {
    const std::string parts = placesBelow(frame, drawers);
    return cat(frame.getShapeType() == ShapeType::none ? "it has no shape" : "it is neither a box nor a cylinder",
               parts.empty() ? "" : cat("; places below it are ", parts));
  }
  const bool is_level = std::abs(frame.getRotationMatrix()(2, 2)) > kLevel;
  if (objects.contains(frame.getName()) && (isBox(frame) || is_level)) return "";
  if (const std::string joint = jointOf(frame, drawers); !joint.empty()) return cat("the joint '", joint, "' moves it");
  if (!is_level) return "it is tilted";
  const double width = isBox(frame) ? placeSides(frame).minCoeff() : diagonalOf(frame, 2);
  if (width < kLeastPlace)
    return cat("it is ", fixed(width, 3), " m wide, and a place has ", fixed(kLeastPlace, 3), " m or more");
  return "";
}

bool isOff(const Frame& obj, const Frame& place) {
  if (!hasTop(place)) return false;
  const Standing standing = standingOf(obj, place);
  return standing.outside > kOffBeside || std::abs(standing.above) > kOffAbove;
}

std::string supportingPlace(const Config& C, const std::string& obj, const std::vector<std::string>& places) {
  double nearest = kTouch;
  std::string below;
  for (const std::string& place : places) {
    if (place == obj || C.getFrame(place).getRotationMatrix()(2, 2) < kLevel || !hasTop(C.getFrame(place))) continue;
    const Standing standing = standingOf(C.getFrame(obj), C.getFrame(place));
    if (standing.outside > 0. || !(std::abs(standing.above) < nearest)) continue;
    nearest = std::abs(standing.above);
    below = place;
  }
  return below;
}

}  // namespace kinegraph::inline task_planning_internal
