#include "kinegraph/task_planning/pull_start.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_doors.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kPull = .2;       ///< m: default length of a pull
constexpr double kGap = .01;       ///< m: shorter displacements have no direction
constexpr double kLow = .005;      ///< m: height of a pulling bar above the ground
constexpr double kApart = 1e-3;    ///< m: between a bar and the pulled object
constexpr int kSteps = 4;          ///< of a pull, so that the arm does not jump
constexpr int kAttempts = 3;       ///< of IK for each grip
constexpr int kManyAttempts = 10;  ///< of IK otherwise
constexpr std::array kAlong = {0.,  -.2,  .2, -.35,
                               .35, -.45, .45};           ///< positions of grips along a bar, shares of its length
constexpr std::array kInclined = {0., -.4, .4, -.8, .8};  ///< rad: inclinations of the hand from the vertical

/// The extent of a shape from its frame along a direction of the world, m.
double extentAlong(const Frame& frame, const Vector3d& direction) {
  const Vector3d local = frame.getRotationMatrix().transpose() * direction;
  double most = 0.;
  for (const Vector3d& point : shapePoints(frame)) most = std::max(most, local.dot(point));
  return most;
}

bool isPull(const TaskAction& action) { return action[0] == "hook_start"; }

bool isOn(const Frame& obj, const std::string& place) {
  const std::optional<Frame> below = obj.getParent();
  return below && below->getName() == place;
}

double yawOf(const Pose& pose) {
  const Matrix3d R = pose.q.toRotationMatrix();
  return std::atan2(R(1, 0), R(0, 0));
}

}  // namespace

bool pullsWithBar(const Config& C, const std::vector<TaskAction>& actions) {
  return std::ranges::any_of(actions,
                             [&](const TaskAction& a) { return isPull(a) && longAxis(C.getFrame(a[3])) >= 0; });
}

Vector3d usualPull(const Config& C, const TaskAction& end, const std::string& variant) {
  const Frame obj = C.getFrame(end[1]);
  Vector3d displacement = C.getFrame(end[5]).getPosition() - obj.getPosition();
  displacement.z() = 0.;
  if (variant == "x" || variant == "y") {
    const Vector3d side = obj.getRotationMatrix().col(variant == "x" ? 0 : 1);
    displacement = side.dot(displacement) < 0. ? Vector3d(-side) : side;
  }
  return kPull / std::max(displacement.norm(), kGap) * displacement;
}

PullStart::PullStart(const Config& C, const std::vector<TaskAction>& actions, const std::vector<std::string>& variants,
                     std::function<int(const std::string&)> slot, Rng* rng)
    : C_(C),
      actions_(actions),
      variants_(variants),
      slot_(std::move(slot)),
      rng_(rng),
      share_(rng ? rng->uniform(.5, 1.5) : 1.) {
  for (const TaskAction& action : actions) {
    const Frame obj = C.getFrame(action[1]);
    at_.emplace(action[1], obj.getPose());
    if (isPull(action)) grip_.emplace(action[4], C.getFrame(action[4]).getPose(C.getFrame(action[5])));
  }
}

std::optional<VectorXd> PullStart::after(std::size_t i, const VectorXd& q, VectorXd& x) {
  const TaskAction& action = actions_[i];
  if (action[0] == "pick") return pick(i, q, x);
  if (action[0] == "place") return place(i, q, x);
  if (isPull(action)) return beginPull(i, q, x);
  if (action[0] == "hook_end") return endPull(i, q, x);
  return std::nullopt;
}

/// Picks an object; a tool with a grip that also reaches its next pull.
std::optional<VectorXd> PullStart::pick(std::size_t i, const VectorXd& q, VectorXd& x) {
  const std::string &obj = actions_[i][1], &hand = actions_[i][3];
  const auto next = nextPullWith(obj, i);
  const auto pull = next ? pullOf(*next, x) : std::nullopt;
  for (const Pose& grip : gripsOf(i)) {
    grip_[obj] = grip;
    if (pull && !reachWithTool(actions_[*next], pull->begin, q, kAttempts)) continue;
    const auto found = reach(hand, at_.at(obj) * grip.inverse(), q, kAttempts);
    if (!found) continue;
    x.segment<7>(slot_(cat("grasp_", hand, "_", obj, "_", i + 1))) = grip.numbers();
    return found;
  }
  return std::nullopt;
}

/// Places an object. On the place that it was picked from, it returns to its pose; `rng` moves it a little aside.
std::optional<VectorXd> PullStart::place(std::size_t i, const VectorXd& q, VectorXd& x) {
  constexpr double kAside = .1;
  const std::string &obj = actions_[i][1], &hand = actions_[i][2], &to = actions_[i][3];
  const int slot = slot_(cat("place_", to, "_", obj, "_", i + 1));
  const Frame thing = C_.getFrame(obj), place = C_.getFrame(to);
  if (slot < 0 || !grip_.contains(obj)) return std::nullopt;
  if (isOn(thing, to)) {
    const Pose there = thing.getPose(place);
    const auto aside = [&] { return rng_ ? rng_->uniform(-kAside, kAside) : 0.; };
    x.segment<3>(slot) << there.p.x() + aside(), there.p.y() + aside(), yawOf(there);
  }
  const double above = .5 * (place.getSize()[2] + thing.getSize()[2]);
  const Pose on(Vector3d(x[slot], x[slot + 1], above), Quaterniond(axisRotation(2, x[slot + 2])));
  at_[obj] = place.getPose() * on;
  return reach(hand, at_.at(obj) * grip_.at(obj).inverse(), q, kManyAttempts);
}

std::optional<VectorXd> PullStart::beginPull(std::size_t i, const VectorXd& q, VectorXd& x) {
  const TaskAction& action = actions_[i];
  const auto pull = pullOf(i, x);
  if (!pull) return std::nullopt;
  const Pose& obj = at_.at(action[1]);
  x.segment<7>(slot_(cat("grasp_", action[3], "_", action[1], "_", i + 1))) = (pull->begin.inverse() * obj).numbers();
  return reachWithTool(action, pull->begin, q, kManyAttempts);
}

/// Moves in steps, so that the arm stays in the same IK branch.
std::optional<VectorXd> PullStart::endPull(std::size_t i, const VectorXd& q, VectorXd& x) {
  const TaskAction& action = actions_[i];
  std::size_t begin = i;
  while (begin > 0 && !(isPull(actions_[begin]) && actions_[begin][1] == action[1])) --begin;
  const auto pull = pullOf(begin, x);
  if (!pull) return std::nullopt;
  Pose bar = pull->begin;
  VectorXd found = q;
  for (int step = 0; step < kSteps; ++step) {
    bar.p += pull->displacement / kSteps;
    found = reachWithTool(actions_[begin], bar, found, 1).value_or(found);
  }
  Pose& obj = at_.at(action[1]);
  const Vector3d ahead = obj.q.conjugate() * pull->displacement;
  x[slot_(cat("push_", action[2], "_", action[1], "_", i + 1))] = std::atan2(-ahead.x(), ahead.y());
  obj.p += pull->displacement;
  const Pose there = C_.getFrame(action[3]).getPose().inverse() * obj;
  x.segment<3>(slot_(cat("place_", action[3], "_", action[1], "_", i + 1))) << there.p.x(), there.p.y(), yawOf(there);
  return found;
}

/// The initial guess of a pull; none without a bar or a displacement.
std::optional<PullStart::Pull> PullStart::pullOf(std::size_t begin, const VectorXd& x) const {
  const TaskAction& action = actions_[begin];
  std::size_t end = begin;
  while (end < actions_.size() && !(actions_[end][0] == "hook_end" && actions_[end][1] == action[1])) ++end;
  if (end == actions_.size() || longAxis(C_.getFrame(action[3])) < 0) return std::nullopt;
  const Pose& obj = at_.at(action[1]);
  const std::string& to = actions_[end][3];
  Vector3d displacement = share_ * usualPull(C_, actions_[end], variants_[begin]);
  if (!isOn(C_.getFrame(action[1]), to)) {
    const int slot = slot_(cat("place_", to, "_", action[1], "_", end + 1));
    displacement = C_.getFrame(to).getPose().transform() * Vector3d(x[slot], x[slot + 1], 0.) - obj.p;
    displacement.z() = 0.;
  }
  if (displacement.norm() < kGap) return std::nullopt;
  return Pull{barBehind(action, obj, displacement), displacement};
}

std::optional<std::size_t> PullStart::nextPullWith(const std::string& tool, std::size_t from) const {
  for (std::size_t i = from; i < actions_.size(); ++i) {
    if (isPull(actions_[i]) && actions_[i][4] == tool) return i;
    if (isPlace(actions_[i]) && actions_[i][1] == tool) return std::nullopt;
  }
  return std::nullopt;
}

/// The pose of a bar across the displacement, with the tool flat and ahead of it, a little above the ground.
Pose PullStart::barBehind(const TaskAction& begin, const Pose& obj, const Vector3d& displacement) const {
  const Frame thing = C_.getFrame(begin[1]), bar = C_.getFrame(begin[3]), tool = C_.getFrame(begin[4]);
  const int along = longAxis(bar), up = flatAxis(bar, tool), third = 3 - along - up;
  const Vector3d ahead = displacement.normalized(), side = Vector3d::UnitZ().cross(ahead);
  const Vector3d body = bar.getPose().inverse().transform() * (tool.getPose().transform() * centerOfBody(tool));
  Matrix3d R;
  for (const double sign : {1., -1.}) {  // of the two ways to lie across, that with the tool ahead
    R.col(along) = sign * side;
    R.col(up) = Vector3d::UnitZ();
    R.col(third) = ((up + 1) % 3 == along ? 1. : -1.) * R.col(up).cross(R.col(along));
    if ((R * body).dot(ahead) >= 0.) break;
  }
  const std::vector<double> size = bar.getSize();
  Vector3d at = obj.p - (extentAlong(thing, -ahead) + .5 * size[std::size_t(third)] + kApart) * ahead;
  at.z() = obj.p.z() - extentAlong(thing, -Vector3d::UnitZ()) + .5 * size[std::size_t(up)] + kLow;
  return {at, Quaterniond(R)};
}

/// Poses of a picked object in the hand: fingers along the axis of the variant, from above, at several places along a
/// bar.
std::vector<Pose> PullStart::gripsOf(std::size_t pick) const {
  const std::size_t axis = std::string_view("xyz").find(variants_[pick]);
  const Frame obj = C_.getFrame(actions_[pick][1]);
  const Matrix3d R = at_.at(actions_[pick][1]).q.toRotationMatrix();
  const Vector3d fingers = axis < 3 ? Vector3d(R.col(Eigen::Index(axis))) : Vector3d(R.col(0));
  const Vector3d ahead = Vector3d::UnitZ().cross(fingers);
  if (ahead.norm() < .5) return {};  // fingers would close from above and below
  const int bar = longAxis(obj);
  std::vector<Pose> grips;
  for (const double inclined : kInclined)
    for (const double along : kAlong)
      for (const double side : {1., -1.}) {
        if (bar < 0 && along != 0.) continue;
        Matrix3d hand;
        hand.col(0) = side * fingers;
        hand.col(2) = std::cos(inclined) * Vector3d::UnitZ() + std::sin(inclined) * ahead.normalized();
        hand.col(1) = hand.col(2).cross(hand.col(0));
        const Vector3d at = bar < 0 ? Vector3d(Vector3d::Zero())
                                    : Vector3d(along * obj.getSize()[std::size_t(bar)] * Vector3d::Unit(bar));
        grips.push_back(Pose(at, Quaterniond(Matrix3d(R.transpose() * hand))).inverse());
      }
  if (rng_) std::ranges::rotate(grips, grips.begin() + std::ptrdiff_t(rng_->bits() % grips.size()));
  return grips;
}

/// Solves IK for a frame at a pose, with doors fixed.
std::optional<VectorXd> PullStart::reach(const std::string& hand, const Pose& there, const VectorXd& q,
                                         int attempts) const {
  Config scene = C_;
  scene.setJointState(q);
  const StillDoors still = withStillDoors(scene, doorsOf(scene));
  IkOptions options;
  options.collisions = false;
  options.attempts = attempts;
  const IkResult result = solveIk(still.scene, {IkTarget::toPose(hand, there)}, options);
  if (!result.feasible()) return std::nullopt;
  VectorXd found = q;
  found(still.dofs) = result.q;
  return found;
}

std::optional<VectorXd> PullStart::reachWithTool(const TaskAction& begin, const Pose& bar, const VectorXd& q,
                                                 int attempts) const {
  const Frame hook = C_.getFrame(begin[3]), tool = C_.getFrame(begin[4]);
  return reach(begin[5], bar * (grip_.at(begin[4]) * hook.getPose(tool)).inverse(), q, attempts);
}

}  // namespace kinegraph::inline task_planning_internal
