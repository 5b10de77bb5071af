#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/task_planning/facing.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/pull_start.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_waypoints.h"
#include "kinegraph/task_planning/waypoint_slot.h"

// Initial guesses of waypoint problems.
namespace kinegraph {

namespace {

constexpr double kMaxRotation = 1.6;  ///< rad: maximum rotation of sampled placements
constexpr double kResolved = .03;     ///< m: depth of overlaps at a guess that the solver resolves

Vector4d rotationAbout(const Vector3d& axis, double angle) {
  Vector4d q;
  q << std::cos(.5 * angle), std::sin(.5 * angle) * axis;
  return q;
}

/// The shortest rotation that points an axis of an object up.
Vector4d upright(const Vector3d& axis) {
  if (axis.z() < -1. + 1e-12) return rotationAbout(axis.cross(Vector3d::UnitY()), std::numbers::pi);
  Vector4d q;
  q << 1. + axis.z(), axis.cross(Vector3d::UnitZ());
  return q / std::sqrt(q.squaredNorm());
}

/// The quaternion that points an axis of an object up, then rotates about it by an angle.
Vector4d faceUp(const std::string& face, double about) {
  const int k = int(std::string_view("xyz").find(face[0]));
  const Vector4d q = rotationAbout(Vector3d::UnitZ(), about),
                 r = upright((face.ends_with("Neg") ? -1. : 1.) * Vector3d::Unit(k));
  const Vector3d v = q.tail<3>(), b = r.tail<3>();
  Vector4d product;
  product << q[0] * r[0] - v.dot(b), q[0] * b + r[0] * v + v.cross(b);
  return product;
}

/// An orientation of a hand: the direction of its z axis, and a rotation about it.
struct HandGuess {
  Vector3d up = Vector3d::UnitZ();
  double angle = 0.;  ///< rad
};

/// Solves IK for a hand at a target, oriented like the guess if possible. Returns q if there is no solution. Doors are
/// fixed.
VectorXd near(const Config& C, const std::string& hand, const Vector3d& target, const VectorXd& q,
              const HandGuess& guess = {}) {
  Config all = C;
  all.setJointState(q);
  all.setJointState(facing(all, hand, target));
  StillDoors still = withStillDoors(all, doorsOf(all));
  IkOptions options;
  options.collisions = false;
  options.attempts = 10;
  const IkTarget there = IkTarget::toPosition(hand, target);
  const IkTarget up = IkTarget::toDirection(hand, Vector3d::UnitZ(), guess.up);
  for (const std::vector<IkTarget>& wanted : {std::vector{there, up}, std::vector{there}}) {
    IkResult result = solveIk(still.scene, wanted, options);
    if (!result.feasible()) continue;
    if (guess.angle != 0.) {
      still.scene.setJointState(result.q);
      const Matrix3d R = still.scene.getFrame(hand).getRotationMatrix();
      const Vector3d x = Eigen::AngleAxisd(guess.angle, R.col(2)).matrix() * R.col(0);
      const IkTarget rotated = IkTarget::toDirection(hand, Vector3d::UnitX(), x);
      if (const IkResult other = solveIk(still.scene, {there, up, rotated}, options); other.feasible()) result = other;
    }
    VectorXd found = q;
    found(still.dofs) = result.q;
    return found;
  }
  return q;
}

/// Returns the least distance between the arm of a hand and all else at q, an object that is taken excluded; at most
/// `most`, m.
double roomAt(const Config& C, const VectorXd& q, const std::string& hand, const std::string& obj, double most) {
  Config scene = C;
  scene.setJointState(q);
  std::set<std::string> joints;
  for (std::optional<Frame> frame = scene.getFrame(hand); frame; frame = frame->getParent())
    if (frame->data().moves() && frame->data().joint->active) joints.insert(frame->getName());
  const auto isOnArm = [&](std::optional<Frame> frame) {
    for (; frame; frame = frame->getParent())
      if (joints.contains(frame->getName())) return true;
    return false;
  };
  const auto isTaken = [&](std::optional<Frame> frame) {
    for (; frame; frame = frame->getParent())
      if (frame->getName() == obj) return true;
    return false;
  };
  double least = most;
  for (const Config::NearPair& pair : scene.getCollisions(most)) {
    const Frame a = scene.getFrame(pair.a), b = scene.getFrame(pair.b);
    if (isOnArm(a) != isOnArm(b) && !isTaken(a) && !isTaken(b)) least = std::min(least, pair.distance);
  }
  return least;
}

/// Solves IK for a hand that takes an object, from above if it has `room` there, m; else rotated about the vertical by
/// other right angles, else level. A negative room is a depth of overlaps. `first`: the number of right angles of the
/// first guess.
VectorXd takes(const Config& C, const std::string& hand, const std::string& obj, const Vector3d& target,
               const VectorXd& q, int first, double room) {
  constexpr double kBetter = 1e-3;  // m
  Config before = C;
  before.setJointState(q);
  Vector3d back = before.getFrame(hand).getPosition() - target;
  back.z() = 0.;
  std::vector<Vector3d> directions = {Vector3d::UnitZ()};
  if (back.norm() > kBetter) directions.push_back(back.normalized());
  VectorXd best;
  double most = 0.;
  for (const Vector3d& up : directions)
    for (const int angles : {0, 2, 1, 3}) {
      const VectorXd found = near(C, hand, target, q, {up, .5 * std::numbers::pi * ((first + angles) % 4)});
      const double there = roomAt(C, found, hand, obj, room);
      if (best.size() == 0 || there > most + kBetter) {
        best = found;
        most = there;
      }
      if (most >= room) return best;
    }
  return best;
}

/// The same for a grasp by a part of a body whose position is given: the hand is oriented along the guess.
VectorXd takesPart(const Config& C, const std::string& hand, const std::string& obj, const Vector3d& position,
                   const GraspGuess& guess, const VectorXd& q, int first, double room) {
  const Matrix3d R = C.getFrame(obj).getRotationMatrix();
  const Vector3d target = position + R * guess.at, x = R * guess.closing, z = R * guess.back;
  Config all = C;
  all.setJointState(q);
  all.setJointState(facing(all, hand, target));
  StillDoors still = withStillDoors(all, doorsOf(all));
  IkOptions options;
  options.collisions = false;
  options.attempts = 10;
  VectorXd best;
  double most = 0.;
  for (const double sign : {1., -1.}) {
    const Vector3d closing = (first == 2 ? -sign : sign) * x;
    const IkResult result =
        solveIk(still.scene,
                {IkTarget::toPosition(hand, target), IkTarget::toDirection(hand, Vector3d::UnitZ(), z),
                 IkTarget::toDirection(hand, Vector3d::UnitX(), closing)},
                options);
    if (!result.feasible()) continue;
    VectorXd found = q;
    found(still.dofs) = result.q;
    const double there = roomAt(C, found, hand, obj, room);
    if (best.size() == 0 || there > most) best = found, most = there;
    if (most >= room) break;
  }
  return best.size() > 0 ? best : near(C, hand, target, q, {z, 0.});
}

/// Samples a rotation other than none, in right angles: half of the time, the other way round.
int rightAngles(Rng& rng) { return rng.uniform() < .5 ? 2 : rng.uniform() < .5 ? 1 : 3; }

/// Samples joints within their limits, from which another solution at a handle may be found. Doors are fixed.
VectorXd elsewhere(const Config& C, const VectorXd& q, Rng& rng) {
  Config scene = C;
  scene.setRandom(rng);
  VectorXd sampled = scene.getJointState();
  for (const TaskDoor& door : doorsOf(C)) sampled[door.dof] = q[door.dof];
  return sampled;
}

/// Solves IK for a hook at a target, with the hand at the origin of the tool.
VectorXd nearWithTool(const Config& C, const TaskAction& action, const Vector3d& target, const VectorXd& q) {
  const std::string &hook = action[startsSliding(action) ? 3 : 2], &tool = action[4], &hand = action[5];
  Config scene = C;
  scene.getFrame(tool).setParent(scene.getFrame(hand)).setJoint(JointType::rigid);
  scene.getFrame(tool).setRelativePose(Pose());
  return near(scene, hook, target, q);
}

}  // namespace

/// Initializes a slot. Returns the offset from the center of the place, for placements.
Vector3d TaskWaypoints::startSlot(const Slot& slot, VectorXd& x, Rng* rng, bool grasps) const {
  const int first = slot.first;
  const auto sample = [&](double low, double high) { return rng ? rng->uniform(low, high) : 0.; };
  if (slot.kind == SlotKind::place) {
    for (int i = 0; i < 2; ++i) x[first + i] = sample(-.9 * slot.half[i], .9 * slot.half[i]);
    x[first + 2] = sample(-kMaxRotation, kMaxRotation);
    if (!rng && slot.placement) x.segment<3>(first) << slot.placement->at, slot.placement->angle;
  } else if (slot.kind == SlotKind::lay) {
    for (int i = first; i < first + 2; ++i) x[i] = sample(-.1, .1);
    x[first + 2] = .1;
    x.segment<4>(first + 3) = faceUp(slot.face, sample(-kMaxRotation, kMaxRotation));
  } else if (slot.kind == SlotKind::grasp) {
    x.segment<7>(first) << 0., 0., 0., 1., 0., 0., 0.;
    if (rng && grasps) {
      for (int i = first + 3; i < first + 7; ++i) x[i] = rng->normal();
      double squares = 0.;
      for (int i = first + 3; i < first + 7; ++i) squares += x[i] * x[i];
      x.segment<4>(first + 3) /= std::sqrt(squares);
    }
  }
  return {x[first], slot.kind == SlotKind::push ? 0. : x[first + 1], 0.};
}

VectorXd TaskWaypoints::start(Rng* rng, bool grasps) const {
  VectorXd x = m->komo->path().variables();
  std::map<std::string, Vector3d> offsets;
  for (const Slot& slot : slots_) {
    const Vector3d offset = startSlot(slot, x, rng, grasps);
    if (slot.kind == SlotKind::place || slot.kind == SlotKind::lay) offsets[slot.frame] = offset;
  }
  std::optional<PullStart> pulls;
  const auto slotOf = [&](const std::string& name) {
    const auto slot = std::ranges::find(slots_, name, &Slot::frame);
    return slot == slots_.end() ? -1 : slot->first;
  };
  if (pullsWithBar(C, actions)) pulls.emplace(C, actions, variants, slotOf, rng);
  VectorXd q = C.getJointState();
  const Eigen::Index n = q.size();
  std::map<std::string, Vector3d> at;
  for (const Frame& frame : C.getFrames()) at.emplace(frame.getName(), frame.getPosition());
  for (std::size_t i = 0; i < actions.size(); ++i) {
    if (isHold(actions[i]) && rng && grasps) q = elsewhere(C, q, *rng);
    const bool is_turned = rng && !grasps && (isPick(actions[i]) || isHold(actions[i]));
    const VectorXd usual = startOf(i, q, at, offsets, is_turned ? rightAngles(*rng) : 0);
    q = pulls ? pulls->after(i, q, x).value_or(usual) : usual;
    x.segment(slot_dofs_ + Eigen::Index(i) * n, n) = q;
  }
  return x;
}

/// Guesses the joints after an action from those before it, and moves the positions `at` of the objects that it moves.
/// `angles`: the rotation of a hand that takes something, about the vertical, in right angles.
VectorXd TaskWaypoints::startOf(std::size_t i, const VectorXd& before, std::map<std::string, Vector3d>& at,
                                const std::map<std::string, Vector3d>& offsets, int angles) const {
  const TaskAction& action = actions[i];
  if (isPick(action) && at.contains(action[1])) {
    const double room = angles > 0 ? margin : -kResolved;
    if (const auto guess = graspGuess(C, action[1], action[3], variants[i]))
      return takesPart(C, action[3], action[1], at.at(action[1]), *guess, before, angles, room);
    return takes(C, action[3], action[1], at.at(action[1]), before, angles, room);
  }
  if (isPlace(action)) {
    const auto offset = offsets.find(cat("place_", action[3], "_", action[1], "_", i + 1));
    Vector3d target = at.at(action[3]);
    if (offset != offsets.end()) target += offset->second;
    target.z() += .05;
    at[action[1]] = target;
    return near(C, action[2], target, before);
  }
  if (action[0] == "hook_start") return nearWithTool(C, action, at.at(action[1]), before);
  if (action[0] == "hook_end") {
    at[action[1]] = at.at(action[3]);
    return nearWithTool(C, action, at.at(action[3]), before);
  }
  if (isHold(action))
    return takes(C, action[3], action[2], at.at(action[2]), before, angles, angles > 0 ? margin : -kResolved);
  const auto door = isGuided(action) ? std::ranges::find(doors_, action[1], &TaskDoor::name) : doors_.end();
  if (door == doors_.end()) return before;
  VectorXd q = before;
  q[door->dof] = door->at(action[0] == "open" ? .5 * (kOpenLeast + kOpenMost) : kClose);
  Config scene = C;
  scene.setJointState(q);
  for (const Frame& moved : scene.getFrame(action[1]).getSubtree()) at[moved.getName()] = moved.getPosition();
  return near(C, action[3], at.at(action[2]), q);
}

}  // namespace kinegraph
