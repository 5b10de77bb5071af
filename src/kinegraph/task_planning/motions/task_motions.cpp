#include "kinegraph/task_planning/motions/task_motions.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/ik/ik_target.h"
#include "kinegraph/ik/solve_ik.h"
#include "kinegraph/scene/dynamics.h"
#include "kinegraph/task_planning/motions/contact_speed.h"
#include "kinegraph/task_planning/motions/guided_motion.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/task_actions.h"
#include "kinegraph/trajectories/retime.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr std::array kStraight = {.07, .05, .03};  ///< m: lengths of straight approaches and retreats, the best first
constexpr int kPieces = 2;                         ///< of a straight approach or retreat
constexpr double kAside = .04;                     ///< m: length of the approach and retreat of a hook behind an object
constexpr double kPulled = 1.;       ///< m/s^2: maximum acceleration of pulled objects, so that they do not tip
constexpr double kLargeMotion = .8;  ///< rad or m: an approach or retreat that moves a joint farther is dropped
constexpr double kSame = 1e-7;       ///< rad or m: closer configurations are equal
constexpr double kPeriod = .01;      ///< s between two waypoints
constexpr double kEasyMargin = 2.;   ///< factor on the margin: tried first
constexpr std::array kMarginShares = {1., .7, .4};  ///< of the margin that are tried for a path
constexpr int kEasyShare = 40, kShare = 20;         ///< shares of the evaluations for paths with margins
constexpr double kHeld = 4.;                        ///< m/s^2: maximum acceleration of objects held by friction
constexpr double kBlend = .05;                      ///< rad or m: tolerance of rounded corners
constexpr double kTenths = 10.;                     ///< per m: scale of positions that hold to .1 mm
constexpr double kFineBlend = 2e-3;                 ///< the same for doors
constexpr double kUnhurried = 1.02;  ///< factor on the minimum time: a spline keeps its limits only at gridpoints
constexpr double kSpeedIn = .5;      ///< s to full speed
constexpr int kRestarts = 2;
constexpr int kSearch = 200000;  ///< evaluations of one search for a path
constexpr int kSearchBehindDoors = 40000;
constexpr int kPushRows = 50;  ///< samples at which a straight push is checked

double farthest(const VectorXd& a, const VectorXd& b) { return (a - b).cwiseAbs().maxCoeff(); }

MatrixXd rowsOf(const std::vector<VectorXd>& configurations) {
  MatrixXd rows(Eigen::Index(configurations.size()), configurations.at(0).size());
  for (std::size_t i = 0; i < configurations.size(); ++i) rows.row(Eigen::Index(i)) = configurations[i];
  return rows;
}

/// `count` rows from a to b, both included.
MatrixXd line(const VectorXd& a, const VectorXd& b, int count) {
  MatrixXd rows(count, a.size());
  const VectorXd step = (b - a) / double(count - 1);
  for (int i = 0; i < count; ++i) rows.row(i) = a + double(i) * step;
  rows.row(count - 1) = b;
  return rows;
}

/// The action whose retreat, reversed, is the approach of an action: placing approaches from above, picking along the
/// axis of the hand.
TaskAction reversedAction(const TaskAction& action) {
  if (isPick(action)) return {"place", action[1], action[3], action[2]};
  if (isHold(action)) return {"open", action[1], action[2], action[3]};
  if (isPlace(action)) return {"pick", action[1], action[3], action[2]};
  if (action[0] == "hook_start") return {"hook_end", action[1], action[3], action[2], action[4], action[5]};
  return {};
}

/// Samples a motion; its ends are bit-identical to those of the path.
TimedRows rowsOf(const TimedPath& timed, const MatrixXd& configurations) {
  const int count = std::max(int(std::ceil(timed.duration() / kPeriod)) + 1, 2);
  TimedRows rows{MatrixXd(count, configurations.cols()), VectorXd(count)};
  const double step = timed.duration() / double(count - 1);
  for (int i = 0; i < count; ++i) rows.times[i] = double(i) * step;
  rows.times[count - 1] = timed.duration();
  for (int i = 0; i < count; ++i) rows.path.row(i) = timed.eval(rows.times[i]).q;
  rows.path.row(0) = configurations.row(0);
  rows.path.row(count - 1) = configurations.row(configurations.rows() - 1);
  return rows;
}

/// Drops repeated configurations; the last one stays, because the next motion begins there.
MatrixXd withoutRepeats(const MatrixXd& configurations) {
  std::vector<Eigen::Index> kept = {0};
  for (Eigen::Index k = 1; k < configurations.rows(); ++k)
    if ((configurations.row(k) - configurations.row(k - 1)).cwiseAbs().maxCoeff() > kSame) kept.push_back(k);
  if (kept.size() > 1) kept.pop_back();
  kept.push_back(configurations.rows() - 1);
  return configurations(kept, Eigen::all);
}

VectorXd perDof(const char* name, const VectorXd& given, const VectorXd& otherwise) {
  if (given.size() == 0) return otherwise;
  for (const double limit : given)
    if (!(limit > 0.)) throw ValueError(cat("planTask: ", name, " is ", limit, "; expected positive numbers"));
  if (given.size() == 1) return VectorXd::Constant(otherwise.size(), given[0]);
  if (given.size() == otherwise.size()) return given;
  throw ValueError(
      cat("planTask: ", name, " has ", given.size(), " numbers; expected one, or ", otherwise.size(), ", one per dof"));
}

}  // namespace

TaskMotions::TaskMotions(SpeculativeExecutor& executor, MatrixXd limits, const Manner& manner,
                         const std::vector<Literal>& start, std::uint64_t seed)
    : executor_(executor),
      limits_(std::move(limits)),
      margin_(manner.margin),
      contact_speed_(manner.contact_speed),
      has_doors_(!wordsOf(start, "is_guided").empty()),
      hands_(wordsOf(start, "is_gripper")),
      objects_(wordsOf(start, "is_object")),
      seed_(seed) {}

TaskMotions::Found TaskMotions::between(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                        const TaskAction& action, const TaskAction& before,
                                        const CancellationToken& stopped, const std::function<int()>& threads) const {
  TaskMotions motions = *this;
  motions.stopped_ = stopped;
  motions.threads_ = threads;
  Found found = motions.search(C, q0, q1, action, before);
  found.evaluations = motions.evaluations_;
  return found;
}

TaskMotions::Found TaskMotions::search(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                       const TaskAction& action, const TaskAction& before) {
  if (!has_doors_) return planFree(C, q0, q1, action, before);
  if (isGuided(action)) return planGuided(C, q0, q1, action);
  Config all = C;
  all.setJointState(q0);
  const StillDoors still = withStillDoors(all, doorsOf(all));
  TaskMotions motions = *this;
  motions.limits_ = limits_(Eigen::all, still.dofs);
  Found found = motions.planFree(still.scene, q0(still.dofs), q1(still.dofs), action, before);
  evaluations_ = motions.evaluations_;
  if (found.motion) {
    MatrixXd path = q0.transpose().replicate(found.motion->path.rows(), 1);
    path(Eigen::all, still.dofs) = found.motion->path;
    found.motion->path = std::move(path);
  }
  return found;
}

/// A hand moves a door by its handle: along the straight line of the joints projected to the grip, or along another
/// path.
TaskMotions::Found TaskMotions::planGuided(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                           const TaskAction& action) {
  const std::string &handle = action[2], &hand = action[3];
  Config taken = C;
  taken.setJointState(q0);
  const std::vector<MotionConstraint> grip = gripConstraints(taken, hand, handle);
  MatrixXd configurations = guidedConfigurations(C, q0, q1, grip);
  if (configurations.rows() == 0 || !isFree(C, configurations)) {
    const MotionPlan found = findPath(C, q0, q1, grip);
    if (!found.feasible())
      return {std::nullopt, 0., cat("no motion was found that holds '", handle, "': ", found.message)};
    configurations = found.path;
  }
  const MotionLimits limits{limits_.row(0), limits_.row(1), {}};
  for (const auto& [corners, tolerance] :
       {std::pair(Corners::spline, 0.), std::pair(Corners::blend, kFineBlend), std::pair(Corners::stop, 0.)}) {
    RetimeOptions options;
    options.corners = corners;
    if (tolerance > 0.) options.tolerance = tolerance;
    const TimedPath timed = retime(withoutRepeats(configurations), limits, options);
    if (!timed.feasible()) continue;
    TimedRows rows = rowsOf(timed, configurations);
    rows.times *= kUnhurried;
    const Slip slip = mostSlip(taken, rows.path, hand, handle);
    if (slip.distance > 1.6 * kSlip || slip.cosine < levelCosine() || !isFree(C, rows.path)) continue;
    return {slower(C, std::move(rows), movedBy(C, action[1], objects_), kSteady / 1.01), margin_, ""};
  }
  return {std::nullopt, 0., cat("'", hand, "' slips on '", handle, "'")};
}

TaskMotions::Found TaskMotions::planFree(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                         const TaskAction& action, const TaskAction& before) {
  const std::vector<std::string> carried = carriedBy(C, hands_, objects_);
  if (endsSliding(action)) {
    Found found = planPush(C, q0, q1, action[1]);
    if (found.motion) found.motion = steady(C, std::move(*found.motion), carried);
    found.margin = margin_;  // it is exempt
    if (found.motion && action[0] == "hook_end")
      found.motion = slower(C, std::move(*found.motion), {action[1]}, kPulled);
    return found;
  }
  std::vector<MotionConstraint> level;
  for (const std::string& obj : carried) {
    const Vector3d up = C.getFrame(obj).getRotationMatrix().col(2);
    level.push_back({.feature = FeatureSymbol::vectorZ, .frames = {obj}, .target = up});
  }
  const Surroundings around(C, q0, q1, action, before, hands_);
  const TaskAction last = before.empty() ? pickAtStart(C, q0) : before;
  const std::vector<ContactPoint> contacts = contactPoints(C, q0, q1, action, last);
  const auto finished = [&](Found found) {
    TimedRows& rows = *found.motion;
    rows.times = slowerNearContacts(C, rows.path, rows.times, limits_, contacts, contact_speed_);
    found.motion = steady(C, std::move(rows), carried);
    return found;
  };
  Speculative<PathResult> direct;  // without retreat and approach
  if (level.empty()) {
    std::vector<VectorXd> configurations = retreat(C, around, q0, last);
    const std::vector<VectorXd> tail = retreat(C, around, q1, reversedAction(action));
    if (configurations.size() + tail.size() > 2) {
      const MotionPlan found = findPath(C, configurations.back(), tail.back(), {}, [&] {
        direct = pathSpeculatively(C, q0, q1);
        direct.begin(Priority::normal);
      });
      if (found.feasible()) {
        for (Eigen::Index i = 0; i < found.path.rows(); ++i) configurations.push_back(found.path.row(i));
        configurations.insert(configurations.end(), tail.rbegin(), tail.rend());
        if (Found lifted = timed(around, rowsOf(configurations)); lifted.motion) return finished(std::move(lifted));
      }
    }
  }
  const MotionPlan found = direct ? countedPlan(direct.get()) : findPath(C, q0, q1, level);
  if (!found.feasible()) return {std::nullopt, 0., cat("no motion was found: ", found.message)};
  Found path = timed(around, found.path);
  return path.motion ? finished(std::move(path)) : path;
}

/// A straight motion of an object on its ground: the straight motion of the joints, or one that keeps the object on the
/// line.
TaskMotions::Found TaskMotions::planPush(const Config& C, const VectorXd& q0, const VectorXd& q1,
                                         const std::string& obj) {
  const Surroundings around(C, q0, q1, {}, {}, {});
  const MatrixXd direct = rowsOf({q0, q1});
  if (slidesStraight(C, line(q0, q1, kPushRows), obj) && isFree(C, direct)) return timed(around, direct);
  const std::vector<Vector3d> ends = positionsAlong(C, direct, obj);
  const Vector3d along = (ends[1] - ends[0]) / std::max((ends[1] - ends[0]).norm(), 1e-9);
  MatrixXd aside(2, 3);
  aside << -along.y(), along.x(), 0., 0., 0., 1.;
  Config D = C;
  D.setJointState(q1);
  const Matrix3d R = D.getFrame(obj).getRotationMatrix();
  std::vector<MotionConstraint> line = {
      {.feature = FeatureSymbol::position, .frames = {obj}, .scale = aside, .target = ends[0]},
      {.feature = FeatureSymbol::vectorX, .frames = {obj}, .target = Vector3d(R.col(0))},
      {.feature = FeatureSymbol::vectorZ, .frames = {obj}, .target = Vector3d(R.col(2))}};
  const MotionPlan found = findPath(C, q0, q1, line);
  if (!found.feasible()) {  // planMotion takes the contact with the ground for a collision
    line[0].scale = MatrixXd(kTenths * aside);
    const MatrixXd configurations = guidedConfigurations(C, q0, q1, line);
    if (configurations.rows() > 0 && isFree(C, configurations)) {
      RetimeOptions options;
      options.corners = Corners::spline;
      const TimedPath smooth = retime(withoutRepeats(configurations), {limits_.row(0), limits_.row(1), {}}, options);
      if (smooth.feasible()) {
        TimedRows rows = rowsOf(smooth, configurations);
        rows.times *= kUnhurried;
        if (slidesStraight(C, rows.path, obj) && isFree(C, rows.path)) return {std::move(rows), 0., ""};
      }
    }
    return {std::nullopt, 0., cat("no straight push was found: ", found.message)};
  }
  return timed(around, found.path);
}

MotionPlan TaskMotions::findPath(const Config& C, const VectorXd& start, const VectorXd& goal,
                                 const std::vector<MotionConstraint>& constraints,
                                 const std::function<void()>& at_first_failure) {
  PlanOptions options;
  options.restarts = has_doors_ ? 1 : kRestarts;
  options.seed = seed_;
  options.constraints = constraints;
  options.timing = false;
  MotionPlan found;
  bool is_first = true;
  for (const double margin : margins()) {
    options.margin = margin;
    options.prove_infeasibility = margin == 0. && !at_first_failure;  // not if there is an alternative
    const int most = has_doors_ ? kSearchBehindDoors : kSearch;       // a closed door shall cost little
    options.max_evaluations = margin == 0. ? most : margin > margin_ ? most / kEasyShare : most / kShare;
    options.threads = threads_();
    found = planMotion(C, MotionGoal(goal), options, start, stopped_);
    for (const PlanStage& stage : found.stages) evaluations_ += stage.evaluations;
    if (found.feasible()) break;
    if (is_first && at_first_failure) at_first_failure();
    is_first = false;
  }
  return found;
}

/// The margins with which a path is searched for: more than the margin, the margin, less, and none if there is no room.
std::vector<double> TaskMotions::margins() const {
  if (!(margin_ > 0.)) return {0.};
  return {kEasyMargin * margin_, margin_, kMarginShares[1] * margin_, 0.};
}

/// The same ahead of time, if a thread is free.
Speculative<TaskMotions::PathResult> TaskMotions::pathSpeculatively(const Config& C, const VectorXd& start,
                                                                    const VectorXd& goal) const {
  return executor_.defer<PathResult>([motions = *this, scene = std::make_shared<const Config>(C), start,
                                      goal](const CancellationToken& stopped) mutable {
    motions.evaluations_ = 0;
    motions.threads_ = [] { return 1; };
    motions.stopped_ = [stopped, outer = motions.stopped_] { return stopped() || (outer && outer()); };
    MotionPlan plan = motions.findPath(*scene, start, goal);
    return PathResult{std::move(plan), motions.evaluations_};
  });
}

MotionPlan TaskMotions::countedPlan(PathResult& result) {
  evaluations_ += result.evaluations;
  return std::move(result.plan);
}

/// The pick before the first action, if a hand holds an object that still stands.
TaskAction TaskMotions::pickAtStart(const Config& C, const VectorXd& q0) const {
  Config start = C;
  start.setJointState(q0);
  return pickBefore(start, hands_, objects_);
}

/// The configurations of a straight motion away from q after an action, q first: a hand retreats from a placed object
/// along its axis or up, it lifts a picked one, and a hook retreats from a pulled object. It keeps the margin if it
/// can, and is as long as possible; q alone if none is collision-free. It is also collision-free in reverse.
std::vector<VectorXd> TaskMotions::retreat(const Config& C, const Surroundings& around, const VectorXd& q,
                                           const TaskAction& action) const {
  const bool is_pulled = !action.empty() && action[0] == "hook_end";
  if (!isPick(action) && !isPlace(action) && !isGuided(action) && !is_pulled) return {q};
  const std::string& hand = is_pulled ? action[5] : isPlace(action) ? action[2] : action[3];
  const std::string palm = palmOf(C, hand);
  Config D = C;
  D.setJointState(q);
  std::vector<Vector3d> directions;
  if (is_pulled) {
    Vector3d back = -eval(D, FeatureSymbol::pairCollision_normal, {action[1], action[2]}).y;
    back.z() = 0.;
    directions.push_back(back.normalized());
  } else if (!isPick(action) && !palm.empty()) {
    const Vector3d back = D.getFrame(palm).getPosition() - D.getFrame(hand).getPosition();
    directions.push_back(back / std::sqrt(back.x() * back.x() + back.y() * back.y() + back.z() * back.z()));
  }
  if (!isPick(action) && !is_pulled && palm.empty() && opening(C, hand))  // the z axis of a hand points back
    directions.push_back(D.getFrame(hand).getRotationMatrix().col(2));
  if (isPick(action) || (isPlace(action) && opening(C, hand))) directions.push_back(Vector3d::UnitZ());
  std::vector<std::vector<VectorXd>> pieces;
  for (const double length : kStraight)
    for (const Vector3d& direction : directions) {
      std::vector<VectorXd> piece = straight(D, q, hand, (is_pulled ? kAside : length) * direction);
      if (piece.size() == 1) continue;
      if (around.isFree(rowsOf(piece), margin_)) return piece;
      pieces.push_back(std::move(piece));
    }
  for (const std::vector<VectorXd>& piece : pieces)
    if (around.isFree(rowsOf(piece), 0.)) return piece;
  return {q};
}

/// A straight motion of a hand without rotation, by inverse kinematics; q alone if there is none.
std::vector<VectorXd> TaskMotions::straight(const Config& C, const VectorXd& q, const std::string& hand,
                                            const Vector3d& step) const {
  Config D = C;
  D.setJointState(q);
  const Pose from = D.getFrame(hand).getPose();
  IkOptions options;
  options.collisions = false;
  options.attempts = 1;
  std::vector<VectorXd> piece = {q};
  for (int k = 1; k <= kPieces; ++k) {
    Pose pose = from;
    pose.p += double(k) / kPieces * step;
    const IkResult result = solveIk(D, {IkTarget::toPose(hand, Pose::fromNumbers(pose.numbers()))}, options);
    if (!result.feasible() || farthest(result.q, piece.back()) > kLargeMotion) return {q};
    piece.push_back(result.q);
    D.setJointState(result.q);
  }
  return piece;
}

/// Slows a motion down so that held objects do not slip, and objects that stand on them stay in place.
TimedRows TaskMotions::steady(const Config& C, TimedRows rows, const std::vector<std::string>& carried) const {
  double share = 1.;
  Config start = C;
  start.setJointState(rows.path.row(0));
  for (const std::string& obj : objects_) {
    const std::string hand = holderOf(C, obj, hands_);
    if (hand.empty()) continue;
    const bool is_carried = std::ranges::find(carried, obj) != carried.end();
    const double held = opening(C, hand) ? steadyAcceleration(start.getFrame(hand), start.getFrame(obj)) : kHeld;
    const double most = is_carried ? kSteady / 1.01 : std::min(kHeld, held);
    share = std::max(share, accelerationOf(C, rows.path, rows.times, obj) / most);
  }
  rows.times *= std::sqrt(share);
  return rows;
}

/// Slows a motion down so that objects are accelerated by at most `most` m/s^2.
TimedRows TaskMotions::slower(const Config& C, TimedRows rows, const std::vector<std::string>& objects,
                              double most) const {
  double share = 1.;
  for (const std::string& obj : objects) share = std::max(share, accelerationOf(C, rows.path, rows.times, obj) / most);
  rows.times *= std::sqrt(share);
  return rows;
}

/// Times a path. Corners are rounded as far as the margin allows; the result has the margin that was verified, and no
/// motion if the path is not collision-free.
TaskMotions::Found TaskMotions::timed(const Surroundings& around, const MatrixXd& configurations) const {
  const MatrixXd kept = withoutRepeats(configurations);
  const MotionLimits limits{limits_.row(0), limits_.row(1), {}};
  std::vector<double> possible = {0.};
  for (const double share : kMarginShares) {
    if (!around.isFree(kept, share * margin_ - kMarginSlack)) continue;
    possible.insert(possible.begin(), share * margin_);
    break;
  }
  for (const double wanted : possible)
    for (const Corners corners : {Corners::blend, Corners::stop}) {
      RetimeOptions options;
      options.corners = corners;
      options.tolerance = kBlend;
      options.is_free = [&](const MatrixXd& points, double) { return around.isFree(points, wanted - kMarginSlack); };
      const TimedPath found = retime(kept, limits, options);
      if (!found.feasible()) continue;
      TimedRows rows = rowsOf(found, configurations);
      if (around.isFree(rows.path, wanted - kMarginSlack)) return {std::move(rows), wanted, ""};
    }
  RetimeOptions stops;
  stops.corners = Corners::stop;
  TimedRows rows = rowsOf(retime(kept, limits, stops), configurations);
  std::string contact = around.violation(rows.path, 0.);
  if (!contact.empty()) return {std::nullopt, 0., std::move(contact)};
  return {std::move(rows), 0., ""};
}

MatrixXd taskMotionLimits(const Config& C, const VectorXd& velocity, const VectorXd& acceleration) {
  VectorXd model = getVelocityLimits(C);
  for (double& limit : model)
    if (!std::isfinite(limit)) limit = 1.;
  MatrixXd limits(2, model.size());
  limits.row(0) = perDof("velocity", velocity, model);
  limits.row(1) = perDof("acceleration", acceleration, VectorXd(limits.row(0).transpose() / kSpeedIn));
  return limits;
}

}  // namespace kinegraph::inline task_planning_internal
