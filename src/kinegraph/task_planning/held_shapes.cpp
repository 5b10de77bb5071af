#include "kinegraph/task_planning/held_shapes.h"

#include <algorithm>
#include <limits>

#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_tools.h"

// The shapes of objects that hands hold.
namespace kinegraph::inline task_planning_internal {

int GraspWords::axis() const { return way.size() == 1 && way[0] >= 'x' && way[0] <= 'z' ? way[0] - 'x' : -1; }

GraspWords graspWords(const std::string& obj, const std::string& variant) {
  const std::size_t of = variant.find(kOfPart);
  if (of == std::string::npos) return {variant, obj};
  return {variant.substr(0, of), variant.substr(of + kOfPart.size())};
}

std::vector<Frame> heldShapes(const Frame& obj) {
  std::vector<Frame> parts = shapesOf(obj);
  const auto collides = [](const Frame& part) { return part.data().shape->contact != 0; };
  if (std::ranges::any_of(parts, collides)) std::erase_if(parts, [&](const Frame& part) { return !collides(part); });
  return parts;
}

bool isCompound(const Frame& obj) {
  const std::vector<Frame> parts = heldShapes(obj);
  return parts.size() > 1 || (parts.size() == 1 && obj.getShapeType() == ShapeType::none);
}

bool isRoundBody(const Frame& frame) {
  if (frame.getShapeType() == ShapeType::none) return false;
  const ShapeKind::Body body = shapeKind(frame.getShapeType()).body;
  return body == ShapeKind::Body::cylinder || body == ShapeKind::Body::capsule;
}

Eigen::AlignedBox3d boxOfShape(const Frame& part) {
  if (!isBox(part)) return boxAround(part);
  const std::vector<double> size = part.getSize();
  const Vector3d half = .5 * Vector3d(size[0], size[1], size[2]);
  return {Vector3d(-half), half};
}

/// The box around a part in the axes of its object.
static Eigen::AlignedBox3d boxInBody(const Frame& part, const Frame& obj) {
  Eigen::AlignedBox3d around;
  for (int k = 0; k < 8; ++k)
    around.extend(part.getPose(obj).transform() * boxOfShape(part).corner(Eigen::AlignedBox3d::CornerType(k)));
  return around;
}

/// The part of the box around a part in which fingers that close along an axis of its object touch it: for a round one,
/// the middle of its side, and for a ball that of its surface.
static Eigen::AlignedBox3d touchedBox(const Frame& part, const Frame& obj, int axis) {
  constexpr double kMiddle = .3;  // of the radius
  Eigen::AlignedBox3d box = boxInBody(part, obj);
  Eigen::Index along = 0;
  part.getPose(obj).transform().R.col(2).cwiseAbs().maxCoeff(&along);
  if (!isBall(part) && (!isRoundBody(part) || along == axis)) return box;
  for (Eigen::Index beside = 0; beside < 3; ++beside) {
    if (beside == axis || (beside == along && !isBall(part))) continue;
    const double middle = box.center()[beside], half = .5 * kMiddle * box.sizes()[beside];
    box.min()[beside] = middle - half;
    box.max()[beside] = middle + half;
  }
  return box;
}

Eigen::AlignedBox3d boxOfBody(const Frame& obj) {
  Eigen::AlignedBox3d around;
  for (const Frame& part : heldShapes(obj)) around.extend(boxInBody(part, obj));
  return around;
}

Eigen::AlignedBox3d boxAcross(const Frame& obj, int axis) {
  constexpr double kReaches = .002;  // m
  const Eigen::AlignedBox3d around = boxOfBody(obj);
  Eigen::AlignedBox3d low, high;
  for (const Frame& part : heldShapes(obj)) {
    const Eigen::AlignedBox3d box = touchedBox(part, obj, axis);
    if (box.min()[axis] < around.min()[axis] + kReaches) low.extend(box);
    if (box.max()[axis] > around.max()[axis] - kReaches) high.extend(box);
  }
  low.max()[axis] = high.max()[axis];  // both cover the whole axis
  high.min()[axis] = low.min()[axis];
  return low.intersection(high);
}

HeldShape heldShape(const Config& C, const std::string& obj, const GraspWords& words) {
  const Frame body = C.getFrame(obj);
  if (words.isOfAllParts()) {
    const Eigen::AlignedBox3d across = words.axis() < 0 ? Eigen::AlignedBox3d() : boxAcross(body, words.axis());
    return {body, across.isEmpty() ? boxOfBody(body) : across};
  }
  const Frame frame = C.getFrame(words.part);
  return {frame, boxOfShape(frame)};
}

HeldHeights heldHeights(const Config& C, const std::string& obj, const GraspWords& words) {
  const bool is_across = words.isOfAllParts() && words.axis() >= 0;  // fingers hold less than the whole body
  const RigidTransform flipped{Vector3d(1., -1., -1.).asDiagonal(), Vector3d::Zero()};
  double ground = std::numeric_limits<double>::infinity(), low = ground, high = -ground;
  for (const Frame& shape : heldShapes(C.getFrame(obj))) {
    const RigidTransform X = shape.getPose().transform();
    const double lowest = -depthOfShape(shape, X);
    ground = std::min(ground, lowest);
    if (is_across || (!words.isOfAllParts() && shape.getName() != words.part)) continue;
    low = std::min(low, lowest);
    high = std::max(high, depthOfShape(shape, flipped * X));
  }
  if (is_across) {
    const HeldShape held = heldShape(C, obj, words);
    for (int k = 0; k < 8; ++k) {
      const Vector3d corner = held.frame.getPose().transform() * held.box.corner(Eigen::AlignedBox3d::CornerType(k));
      low = std::min(low, corner.z());
      high = std::max(high, corner.z());
    }
  }
  return high < low ? HeldHeights{} : HeldHeights{low - ground, high - low};
}

PartAccess::PartAccess(const Config& C, const std::string& obj, double wide)
    : C_(C),
      body_(C.getFrame(obj)),
      obj_(obj),
      wide_(wide),
      up_(body_.getRotationMatrix().row(2)),
      ground_(std::numeric_limits<double>::infinity()) {
  for (const Frame& part : heldShapes(body_)) parts_.push_back({part.getPose(body_).transform(), boxOfShape(part)});
  for (const Part& part : parts_)
    for (int k = 0; k < 8; ++k)
      ground_ = std::min(ground_, up_.dot(part.X * part.box.corner(Eigen::AlignedBox3d::CornerType(k))));
}

std::optional<GraspGuess> PartAccess::guess(const std::string& variant) const {
  const GraspWords words = graspWords(obj_, variant);
  const HeldShape shape = heldShape(C_, obj_, words);
  const RigidTransform X = shape.frame.getPose(body_).transform();
  std::vector<int> closing = {0, 1};  // around an axis
  if (words.axis() >= 0) closing = {words.axis()};
  std::optional<GraspGuess> best;
  double highest = 0.;
  for (const int along : closing)
    for (int axis = 0; axis < 3; ++axis)
      for (const double sign : {1., -1.}) {
        if (axis == along) continue;
        const Vector3d half = .5 * shape.box.sizes(), back = sign * X.R.col(axis);
        const double inside = half[axis] - std::min(kGraspInside, .5 * half[axis]);
        const GraspGuess one{X * shape.box.center() + inside * back, X.R.col(along), back};
        const double height = up_.dot(back);
        if ((best && height <= highest) || !isFree(one, half[along])) continue;
        best = one, highest = height;
      }
  return best;
}

/// Whether open fingers and the palm have room at a grasp.
bool PartAccess::isFree(const GraspGuess& grasp, double half) const {
  constexpr double kFinger = .008, kTip = -.004, kPalm = .045, kFingerRoom = .007, kFromBelow = -.3;  // m, cosine
  if (up_.dot(grasp.back) < kFromBelow) return false;
  for (const double side : {-1., 1.}) {
    for (const double beside : {half + kFinger, std::max(half, .5 * wide_) + kFinger})
      for (double along = kTip; along < kPalm; along += kFinger)
        if (!hasRoom(grasp.at + side * beside * grasp.closing + along * grasp.back, kFingerRoom)) return false;
    for (const double share : {0., .5, 1.})
      if (!hasRoom(grasp.at + side * share * .5 * wide_ * grasp.closing + kPalm * grasp.back, kFingerRoom))
        return false;
  }
  return true;
}

bool PartAccess::hasRoom(const Vector3d& point, double room) const {
  constexpr double kOverGround = .003;  // m
  if (up_.dot(point) < ground_ + kOverGround) return false;
  return std::ranges::all_of(parts_, [&](const Part& part) { return part.distance(point) > room; });
}

}  // namespace kinegraph::inline task_planning_internal
