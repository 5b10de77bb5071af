#include "kinegraph/task_planning/search/task_proofs.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using Body = ShapeKind::Body;

constexpr double kDeep = 1.1e-3;  ///< m: plans have no deeper overlaps
constexpr double kStep = 2.5e-3;  ///< m: two millimeters of tolerance of plans, and rounding
constexpr double kInf = std::numeric_limits<double>::infinity();

bool isFixed(JointType type) { return type == JointType::none || type == JointType::rigid; }

/// The axes that a joint slides along; none of other joints.
std::vector<int> slidesAlong(JointType type) {
  switch (type) {
    case JointType::transX:
      return {0};
    case JointType::transY:
      return {1};
    case JointType::transZ:
      return {2};
    case JointType::transXY:
      return {0, 1};
    case JointType::trans3:
      return {0, 1, 2};
    default:
      return {};
  }
}

bool isRotational(JointType type) {
  return type == JointType::hingeX || type == JointType::hingeY || type == JointType::hingeZ ||
         type == JointType::hinge || type == JointType::quatBall;
}

void addJoint(const Frame& frame, Reach& reach) {
  const Joint& joint = *frame.data().joint;
  if (const std::vector<int> axes = slidesAlong(joint.type); !axes.empty()) {
    if (joint.lower.size() != Eigen::Index(axes.size())) {
      reach.half.setConstant(kInf);
      return;
    }
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const double low = joint.lower[Eigen::Index(k)], high = joint.upper[Eigen::Index(k)];
      reach.center[axes[k]] += .5 * (low + high);
      reach.half[axes[k]] += .5 * (high - low);
    }
  } else if (isRotational(joint.type)) {
    reach.radius += (reach.center.cwiseAbs() + reach.half).norm();
    reach.center = reach.half = Vector3d::Zero();
  } else {  // mobile bases and free joints have no bound
    reach.half.setConstant(kInf);
  }
}

/// The pose of a frame in its parent, or of a root in the world, with its joint at zero.
RigidTransform offsetOf(const Config& C, const Frame& frame) {
  Config D = C;
  Frame same = D.getFrame(frame.getName());
  if (!isFixed(same.getJointType())) {
    VectorXd q = VectorXd::Zero(same.getJointState().size());
    if (same.getJointType() == JointType::quatBall) q[0] = 1.;
    if (same.getJointType() == JointType::free) q[3] = 1.;
    same.setJointState(q);
  }
  return (same.getParent() ? same.getRelativePose() : same.getPose()).transform();
}

/// Radius of a ball around the origin of a frame that contains its shape, m.
double radiusOf(const Config& C, const std::string& name) {
  const Frame frame = C.getFrame(name);
  if (frame.getShapeType() == ShapeType::none || frame.getShapeType() == ShapeType::marker) return 0.;
  const std::vector<double> size = frame.getSize();
  switch (shapeKind(frame.getShapeType()).body) {
    case Body::box:
      return .5 * Vector3d(size[0], size[1], size[2]).norm();
    case Body::ball:
      return size.back();
    case Body::cylinder:
      return std::hypot(.5 * size[0], size[1]);
    case Body::capsule:
      return std::hypot(.5 * size[0], size[1]) + size[1];
    default: {
      double radius = 0.;
      for (const Vector3d& point : shapePoints(frame)) radius = std::max(radius, point.norm());
      return radius;
    }
  }
}

/// The same around a body with all shapes fixed to it.
double radiusOfBody(const Config& C, const std::string& name) {
  const Frame body = C.getFrame(name);
  double radius = radiusOf(C, name);
  for (const Frame& part : shapesOf(body))
    radius = std::max(radius, part.getPose(body).p.norm() + radiusOf(C, part.getName()));
  return radius;
}

/// Half of the smallest horizontal width of an upright object, m; none if it is unknown.
std::optional<double> innerRadius(const Config& C, const std::string& name) {
  const Frame frame = C.getFrame(name);
  if (frame.getShapeType() == ShapeType::none) return std::nullopt;
  const std::vector<double> size = frame.getSize();
  switch (shapeKind(frame.getShapeType()).body) {
    case Body::box:
      return .5 * std::min(size[0], size[1]);
    case Body::ball:
      return size.back();
    case Body::cylinder:
    case Body::capsule:
      return size[1];
    default:
      return std::nullopt;
  }
}

bool mayCollide(const Config& C, const std::string& name) {
  const auto& shape = C.getFrame(name).data().shape;
  return shape && shape->contact != 0;
}

class Proofs {
 public:
  Proofs(const Config& C, const std::vector<Literal>& start) : C_(C), start_(start), doors_(doorsOf(C)) {}

  std::vector<ImpossibleAction> of(const std::vector<TaskAction>& actions) {
    for (const TaskAction& action : actions) {
      if (isPick(action)) {
        provePick(action);
      } else if (action[0] == "place") {
        const Frame thing = C_.getFrame(action[1]);
        for (const Frame& part : thing.getSubtree())
          if (part.getName() == action[3] && movingWith(part) == thing)
            found_.push_back({action, {}, cat("'", action[1], "' cannot stand on its part '", action[3], "'")});
        const double half = .5 * diagonalOf(C_.getFrame(action[3]), 3);
        if (const auto travel = travelOf(action[3]))
          proveReach(action, action[2], action[3], *travel + half + 2. * bodyRadius(action[1]) + handRadius(action[2]));
      } else if (isHold(action)) {
        if (graspVariants(C_, action[2], action[3]).empty()) addMisfit(action, action[2]);
        if (const auto travel = travelOf(action[2]))
          proveReach(action, action[3], action[2], *travel + bodyRadius(action[2]) + handRadius(action[3]));
      } else if (isGuided(action)) {
        proveDoorMotion(action);
      } else if (action[0] == "hook_start") {
        proveHook(action);
      } else if (endsSliding(action)) {
        proveHeights(actions, action);
      } else if (action[0] == "handover" && graspVariants(C_, action[1], action[3]).empty()) {
        addMisfit(action, action[1]);
      }
    }
    proveRoom(actions);
    return std::move(found_);
  }

 private:
  double bodyRadius(const std::string& name) {
    const auto [known, is_new] = body_radius_.try_emplace(name, 0.);
    if (is_new) known->second = radiusOfBody(C_, name);
    return known->second;
  }

  /// The radius of a ball around the origin of a hand that contains the tips of its fingers, m.
  double handRadius(const std::string& hand) {
    const auto [known, is_new] = hand_radius_.try_emplace(hand, 0.);
    if (is_new) known->second = radiusOf(C_, hand) + fingerReach(C_, hand);
    return known->second;
  }

  void provePick(const TaskAction& action) {
    const std::string &obj = action[1], &place = action[2], &hand = action[3];
    if (graspVariants(C_, obj, hand).empty()) return addMisfit(action, obj);
    const std::optional<double> travel = travelOf(place);
    if (!travel) return;
    const double half = .5 * diagonalOf(C_.getFrame(place), 2);
    const double far = (C_.getFrame(obj).getPosition() - C_.getFrame(place).getPosition()).norm();
    const double room = 2. * bodyRadius(obj) + handRadius(hand);
    proveReach(action, hand, place, *travel + std::max(half, far) + room);
    if (staysInPlace(obj, place))
      proveReach(action, hand, obj, room, {Literal{"fresh", {obj}}});
    else if (isBeyondAll(obj, place))
      proveReach(action, hand, obj, room);
  }

  /// The distance by which doors and drawers can move a frame, m; none for a frame that moves by other joints.
  std::optional<double> travelOf(const std::string& name) const {
    const Vector3d at = C_.getFrame(name).getPosition();
    double travel = 0.;
    for (std::optional<Frame> up = C_.getFrame(name); up; up = up->getParent()) {
      if (up->getJointType() == JointType::none) continue;
      const auto door = std::ranges::find(doors_, up->getName(), &TaskDoor::name);
      if (door == doors_.end()) return std::nullopt;
      const double range = std::abs(door->open - door->closed) * std::abs(up->data().joint->scale);
      // Joints further up rotate a point that lower joints have moved by at most `travel`.
      travel +=
          isRotational(up->getJointType()) ? std::min(range, 2.) * ((at - up->getPosition()).norm() + travel) : range;
    }
    return travel;
  }

  /// A static obstacle that a door has to pass through, whatever stands in or on the door.
  void proveDoorMotion(const TaskAction& action) {
    const auto door = std::ranges::find(doors_, action[1], &TaskDoor::name);
    if (door == doors_.end()) return;
    const double now = C_.getJointState()[door->dof];
    const bool opens = action[0] == "open", is_ajar = door->stateAt(now) == "ajar";
    const auto prove = [&](const char* state, double from, double to) {
      const std::string what = blockedBetween(*door, from, to);
      if (!what.empty()) found_.push_back({action, {Literal{state, {door->name}}}, cat("'", door->name, "' ", what)});
    };
    prove(opens ? "closed" : "opened", kClosed, kOpened);
    if (is_ajar) prove("ajar", opens ? door->share(now) : kClosed, opens ? kOpened : door->share(now));
  }

  /// Returns "meets 'post' at 40 % of its range" if a door collides between two shares of its range, else "".
  std::string blockedBetween(const TaskDoor& door, double from, double to) const {
    constexpr int kSamples = 40;
    const std::vector<std::string> parts = partsOf(C_, door.name);
    const auto is_part = [&](const Frame& f) { return std::ranges::find(parts, f.getName()) != parts.end(); };
    Config scene = C_;
    for (int i = 0; i <= kSamples; ++i) {
      const double share = from + (to - from) * i / kSamples;
      VectorXd q = C_.getJointState();
      q[door.dof] = door.at(share);
      scene.setJointState(q);
      for (const Config::NearPair& pair : scene.getCollisions(-kDeep)) {
        const Frame a = scene.getFrame(pair.a), b = scene.getFrame(pair.b);
        if (is_part(a) == is_part(b) || !isStatic(is_part(a) ? b : a)) continue;
        return cat("meets '", (is_part(a) ? b : a).getName(), "' at ", fixed(100. * share, 0), " % of its range");
      }
    }
    return "";
  }

  /// The frame with the joint that moves a part.
  static Frame movingWith(const Frame& part) {
    Frame frame = part;
    while (frame.getJointType() == JointType::none && frame.getParent()) frame = *frame.getParent();
    return frame;
  }

  static bool isStatic(const Frame& frame) {
    for (std::optional<Frame> up = frame; up; up = up->getParent())
      if (up->getJointType() != JointType::none) return false;
    return true;
  }

  /// Whether an object stays at its initial place, on a static frame, as long as it is `fresh`.
  bool staysInPlace(const std::string& obj, const std::string& place) const {
    return contains(start_, {"fresh", {obj}}) && contains(start_, {"on", {place, obj}}) && isStatic(C_.getFrame(place));
  }

  /// Whether no hand reaches an object at its initial place, so that it stays there.
  bool isBeyondAll(const std::string& obj, const std::string& place) {
    if (!contains(start_, {"on", {place, obj}}) || !isStatic(C_.getFrame(place))) return false;
    return std::ranges::all_of(wordsOf(start_, "is_gripper"), [&](const std::string& hand) {
      return beyond(hand, obj) > 2. * bodyRadius(obj) + handRadius(hand);
    });
  }

  /// The distance of a frame from the reach of a hand, m.
  double beyond(const std::string& hand, const std::string& name) {
    if (!reach_.contains(hand)) reach_[hand] = reachOf(C_, hand);
    return reach_[hand].distance(C_.getFrame(name).getPosition());
  }

  /// An object that is too far away for the hook of a tool, however the hand holds the tool.
  void proveHook(const TaskAction& action) {
    const std::string &obj = action[1], &tool = action[4], &hand = action[5];
    if (!staysInPlace(obj, action[2])) return;
    double size = radiusOf(C_, tool);
    const Frame root = C_.getFrame(tool);
    for (const Frame& part : root.getSubtree())
      size = std::max(size, part.getPose(root).p.norm() + radiusOf(C_, part.getName()));
    const double room = 2. * size + bodyRadius(obj) + handRadius(hand);
    proveReach(action, hand, obj, room, {Literal{"fresh", {obj}}}, cat(", with '", tool, "', too"));
  }

  /// Pushed and pulled objects stay at their height, so that they reach no place at another height.
  void proveHeights(const std::vector<TaskAction>& actions, const TaskAction& action) {
    const std::optional<double> there = topOf(action[3]);
    std::set<std::string> from;
    for (const TaskAction& other : actions)
      if (startsSliding(other) && other[1] == action[1]) from.insert(other[2]);
    for (const std::string& place : from) {
      const std::optional<double> here = topOf(place);
      if (here && there && std::abs(*here - *there) > kStep)
        found_.push_back({action,
                          {Literal{"on", {place, action[1]}}},
                          cat("'", action[1], "' cannot slide from '", place, "' to '", action[3], "', which is ",
                              fixed(std::abs(*there - *here), 3), " m ", *there > *here ? "higher" : "lower")});
    }
  }

  /// The height of a static, level box, m.
  std::optional<double> topOf(const std::string& place) const {
    const Frame frame = C_.getFrame(place);
    if (!isStatic(frame)) return std::nullopt;
    const double level = std::abs(frame.getRotationMatrix()(2, 2));
    if (!isBox(frame) || level < 1. - 1e-9) return std::nullopt;
    return frame.getPosition().z() + .5 * frame.getSize()[2];
  }

  /// A place that is more than `room` (m) beyond the reach of a hand.
  void proveReach(const TaskAction& action, const std::string& hand, const std::string& place, double room,
                  const std::vector<Literal>& facts = {}, const std::string& with = {}) {
    const double missing = beyond(hand, place) - room;
    if (missing > 0.)
      found_.push_back(
          {action, facts,
           cat("'", place, "' is at least ", fixed(missing, 2), " m beyond the reach of '", hand, "'", with)});
  }

  void addMisfit(const TaskAction& action, const std::string& obj) {
    found_.push_back({action, {}, cat(graspMisfit(C_, obj, action[3]), " along all of its axes")});
  }

  /// The centers of two objects on a place are at least the sum of their inner radii apart, and at most its diagonal.
  void proveRoom(const std::vector<TaskAction>& actions) {
    std::vector<std::pair<std::string, std::vector<std::string>>> onto;
    for (const TaskAction& action : actions) {
      if (action[0] != "place") continue;
      auto place = std::ranges::find(onto, action[3], [](const auto& entry) { return entry.first; });
      if (place == onto.end()) place = onto.insert(onto.end(), {action[3], {}});
      if (std::ranges::find(place->second, action[1]) == place->second.end()) place->second.push_back(action[1]);
    }
    for (const auto& [to, objects] : onto)
      for (const std::string& a : objects)
        for (const std::string& b : objects)
          if (a != b) provePair(actions, to, a, b);
  }

  void provePair(const std::vector<TaskAction>& actions, const std::string& to, const std::string& a,
                 const std::string& b) {
    const std::optional<double> one = innerRadius(C_, a), other = innerRadius(C_, b);
    const double most = diagonalOf(C_.getFrame(to), 2);
    if (!one || !other || *one + *other <= most || !mayCollide(C_, a) || !mayCollide(C_, b)) return;
    const auto& [first, second] = std::minmax(a, b);
    const std::string cause =
        cat("'", first, "' and '", second, "' do not fit on '", to, "' together: their centers are ",
            fixed(*one + *other, 3), " m apart or more, and ", fixed(most, 3), " m at most there");
    for (const TaskAction& action : actions)
      if (action[0] == "place" && action[1] == a && action[3] == to)
        found_.push_back({action, {Literal{"on", {to, b}}}, cause});
  }

  const Config& C_;
  const std::vector<Literal>& start_;
  const std::vector<TaskDoor> doors_;
  std::map<std::string, Reach> reach_;
  std::map<std::string, double> body_radius_, hand_radius_;
  std::vector<ImpossibleAction> found_;
};

}  // namespace

double Reach::distance(const Vector3d& point) const {
  if (!half.allFinite()) return -kInf;
  return ((point - center).cwiseAbs() - half).cwiseMax(0.).norm() - radius;
}

Reach reachOf(const Config& C, const std::string& name) {
  Reach reach;
  for (std::optional<Frame> frame = C.getFrame(name); frame; frame = frame->getParent()) {
    if (!isFixed(frame->getJointType())) addJoint(*frame, reach);
    const RigidTransform X = offsetOf(C, *frame);
    reach.center = X * reach.center;
    if (reach.half.allFinite()) reach.half = Vector3d(X.R.cwiseAbs() * reach.half);
  }
  return reach;
}

std::vector<ImpossibleAction> impossibleActions(const Config& C, const std::vector<TaskAction>& actions,
                                                const std::vector<Literal>& start) {
  return Proofs(C, start).of(actions);
}

}  // namespace kinegraph::inline task_planning_internal
