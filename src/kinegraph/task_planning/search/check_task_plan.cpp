#include "kinegraph/task_planning/search/plan_task.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/task_planning/motions/guided_motion.h"
#include "kinegraph/task_planning/motions/meant_contacts.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/open_hands.h"
#include "kinegraph/task_planning/shape_points.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph {

namespace {

using Lines = std::vector<std::string>;
using Pairs = std::set<std::pair<std::string, std::string>>;

constexpr double kEdge = 5e-3;   ///< m: distance of the center of an object from the edges of its place
constexpr double kJump = 1e-9;   ///< rad or m: larger steps without time are jumps
constexpr double kShare = 1e-6;  ///< relative tolerance of limits, for rounding

double cosineOf(double degrees) { return std::cos(degrees * std::numbers::pi / 180.); }

/// Returns the violation of velocity and acceleration limits of a motion from rest to rest, or "". Chords of the motion
/// are
/// checked: a motion within the limits has chords within them.
std::string timingViolation(const MatrixXd& path, const VectorXd& times, const VectorXd& q, const MatrixXd& limits) {
  if ((path.row(0).transpose() - q).cwiseAbs().maxCoeff() > kJump) return "the motion jumps at its beginning";
  std::vector<double> steps;
  std::vector<VectorXd> velocity;
  bool jumps = false;
  for (Eigen::Index i = 0; i + 1 < path.rows(); ++i) {
    const double step = times[i + 1] - times[i];
    const VectorXd chord = path.row(i + 1) - path.row(i);
    if (step < 0.) return "time goes back";
    if (step > 0.) {
      steps.push_back(step);
      velocity.push_back(chord / step);
    } else {
      jumps = jumps || chord.cwiseAbs().maxCoeff() > kJump;
    }
  }
  if (jumps) return "the motion jumps";
  if (limits.size() == 0 || steps.empty()) return "";
  const auto exceeds = [&](const VectorXd& values, int row) {
    return ((values.cwiseAbs().transpose() - limits.row(row) * (1. + kShare)).array() > 0.).any();
  };
  if (std::ranges::any_of(velocity, [&](const VectorXd& v) { return exceeds(v, 0); }))
    return "a joint is faster than its limit";
  bool is_hasty = exceeds(velocity.front() / (.5 * steps.front()), 1) ||  // from rest, to rest
                  exceeds(velocity.back() / (.5 * steps.back()), 1);
  for (std::size_t i = 0; i + 1 < steps.size(); ++i)
    is_hasty = is_hasty || exceeds((velocity[i + 1] - velocity[i]) / (.5 * (steps[i + 1] + steps[i])), 1);
  return is_hasty ? "a joint accelerates more than its limit" : "";
}

/// The vertical component of an axis (x, y, z, xNeg, ...); 1 if it points up.
double shareOf(const Vector3d& heights, const std::string& face) {
  const std::size_t axis = std::string_view("xyz").find(face.empty() ? '?' : face[0]);
  if (axis == std::string_view::npos)
    throw ValueError(cat("checkTaskPlan: '", face, "' is no face; expected one of x, y, z, xNeg, yNeg, zNeg"));
  return heights[Eigen::Index(axis)] * (face.ends_with("Neg") ? -1. : 1.);
}

Pairs overlaps(const Config& scene) {
  Pairs pairs;
  for (const Config::NearPair& pair : scene.getCollisions(-kOverlap))
    pairs.emplace(scene.getFrame(pair.a).getName(), scene.getFrame(pair.b).getName());
  return pairs;
}

/// Plays a plan, action by action.
class PlanPlayer {
 public:
  PlanPlayer(const Config& C, const TaskPlan& plan, double margin)
      : scene_(C),
        plan_(plan),
        margin_(margin),
        doors_(doorsOf(C)),
        wedged_(wedgedPairs(C, wordsOf(plan.start, "is_gripper"), wordsOf(plan.start, "is_object"), kOverlap)),
        ignored_(overlaps(C)) {
    for (const auto& [a, b] : wedged_) depth_.push_back(-gapOf(C, a, b));
    for (const TaskAction& action : plan.actions)
      if (isPlace(action) || endsSliding(action)) resting_.emplace(action[1], restingRotation(C.getFrame(action[1])));
    ignorePairs(scene_, wedged_);
  }

  Lines violations() {
    VectorXd q = scene_.getJointState();
    for (std::size_t i = 0; i < plan_.actions.size(); ++i) {
      const TaskAction& action = plan_.actions[i];
      const RowRange rows = plan_.segments[i];
      const MatrixXd path = plan_.path.middleRows(rows.begin, rows.size());
      const VectorXd times = plan_.times.segment(rows.begin, rows.size());
      const std::string text = planText({action});
      if (const std::string broken = motionViolation(action, path, times, q); !broken.empty()) {
        violations_.push_back(cat(text, ": ", broken));
        return violations_;
      }
      q = path.row(path.rows() - 1);
      before_ = action;
      scene_.setJointState(q);
      if (is_freed_) endWedges(text);
      apply(action, text);
      for (const auto& [a, b] : overlaps(scene_))
        if (!ignored_.contains({a, b})) report(text, cat(a, " and ", b, " overlap at rest"));
    }
    checkFaces();
    checkDoors();
    return violations_;
  }

 private:
  /// Ends the exemption of initial overlaps, after the object has been put down and the hand has left it.
  void endWedges(const std::string& text) {
    includePairs(scene_, wedged_);
    for (const auto& [a, b] : wedged_)
      if (-gapOf(scene_, a, b) > kOverlap) report(text, cat(a, " and ", b, " overlap still"));
    wedged_.clear();
    is_freed_ = false;
  }

  bool isWedged(const std::string& obj) const {
    const auto isPart = [&](const std::string& name) { return name == obj || !holderOf(scene_, name, {obj}).empty(); };
    return std::ranges::any_of(wedged_, [&](const auto& pair) { return isPart(pair.first) || isPart(pair.second); });
  }

  /// Initial overlaps of held objects must not become deeper.
  std::string wedgeViolation(const MatrixXd& path) {
    for (std::size_t i = 0; i < wedged_.size(); ++i) {
      for (Eigen::Index row = 0; row < path.rows(); ++row) {
        scene_.setJointState(path.row(row));
        const auto& [a, b] = wedged_[i];
        if (const double depth = -gapOf(scene_, a, b); depth > depth_[i] + kOverlap)
          return cat(a, " and ", b, " overlap by ", fixed(depth, 4), " m, more than at the start");
      }
    }
    return "";
  }

  void report(const std::string& action, const std::string& what) { violations_.push_back(cat(action, ": ", what)); }

  std::string motionViolation(const TaskAction& action, const MatrixXd& path, const VectorXd& times,
                              const VectorXd& q) {
    std::string broken = timingViolation(path, times, q, plan_.limits);
    if (broken.empty()) broken = contactOf(action, path);
    if (broken.empty()) broken = wedgeViolation(path);
    if (broken.empty()) broken = slidingViolation(action, path);
    if (broken.empty()) broken = doorViolation(action, path);
    if (broken.empty()) broken = carryingViolation(action, path, times);
    return broken;
  }

  std::string contactOf(const TaskAction& action, const MatrixXd& path) const {
    if (margin_ <= kMarginSlack || endsSliding(action) || isGuided(action)) return firstContact(scene_, path);
    const Surroundings around(scene_, path.row(0), path.row(path.rows() - 1), action, before_,
                              wordsOf(plan_.start, "is_gripper"));
    return around.violation(path, margin_ - kMarginSlack);
  }

  /// Touched objects move only in a push: straight, away from the pusher, without rotation and without being lifted.
  std::string slidingViolation(const TaskAction& action, const MatrixXd& path) {
    static const double kAway = cosineOf(30.);   // of the motion with the direction from the pusher to the object
    static const double kPress = cosineOf(45.);  // of the motion with the contact normal: the friction cone
    for (const auto& [obj, pusher] : pushed_) {
      const std::vector<Vector3d> at = positionsAlong(scene_, path, obj);
      const Vector3d here = at.front(), moved = at.back() - here;
      if (!endsSliding(action) || action[1] != obj) {
        if (std::ranges::any_of(at, [&](const Vector3d& p) { return (p - here).norm() > kOffPlace; }))
          return cat("'", obj, "' moves without being pushed");
        continue;
      }
      if (!slidesStraight(scene_, path, obj)) return cat("'", obj, "' does not slide straight");
      Vector3d away = here - positionsAlong(scene_, path.topRows(1), pusher).front();
      away.z() = 0.;
      scene_.setJointState(path.row(0));
      const Vector3d pressed = eval(scene_, FeatureSymbol::pairCollision_normal, {obj, pusher}).y;
      const double length = moved.norm();
      if (length > kOffPlace &&
          (away.dot(moved) < kAway * away.norm() * length || pressed.dot(moved) < kPress * length))
        return cat("'", obj, "' is not pushed from behind");
    }
    return "";
  }

  /// Doors move only in actions that open or close them, while a hand holds the handle.
  std::string doorViolation(const TaskAction& action, const MatrixXd& path) {
    for (const TaskDoor& door : doors_) {
      const bool is_moved = isGuided(action) && action[1] == door.name;
      const double most = path.col(door.dof).maxCoeff(), least = path.col(door.dof).minCoeff();
      if (!is_moved && most - least > kJump) return cat("'", door.name, "' moves without being opened or closed");
      const auto held = held_.find(door.name);
      if (held == held_.end()) {
        if (is_moved) return cat("'", action[3], "' does not hold '", door.name, "'");
        continue;
      }
      const auto& [handle, hand, taken] = held->second;
      if (is_moved && (action[2] != handle || action[3] != hand))
        return cat("'", action[3], "' does not hold '", action[2], "'");
      const Slip slip = mostSlip(taken, path, hand, handle);
      if (slip.distance > kOffPlace)
        return cat("'", hand, "' slips on '", handle, "' by ", fixed(slip.distance, 4), " m");
      if (slip.cosine < levelCosine()) return cat("'", hand, "' turns on '", handle, "'");
    }
    return "";
  }

  /// Objects that stand on a held object, or in a moving drawer, must not tilt or accelerate much. Each waypoint is
  /// checked.
  std::string carryingViolation(const TaskAction& action, const MatrixXd& path, const VectorXd& times) {
    static const double kUpright = cosineOf(5.);
    const Lines objects = wordsOf(plan_.start, "is_object");
    Lines carried = carriedBy(scene_, wordsOf(plan_.start, "is_gripper"), objects);
    if (isGuided(action))
      for (std::string& obj : movedBy(scene_, action[1], objects)) carried.push_back(std::move(obj));
    std::map<std::string, Vector3d> upright;
    for (const std::string& obj : carried) upright[obj] = scene_.getFrame(obj).getRotationMatrix().col(2);
    for (Eigen::Index row = 0; row < path.rows() && !carried.empty(); ++row) {
      scene_.setJointState(path.row(row));
      for (const std::string& obj : carried)
        if (scene_.getFrame(obj).getRotationMatrix().col(2).dot(upright[obj]) < kUpright)
          return cat("'", obj, "' tilts on what carries it");
    }
    for (const std::string& obj : carried)
      if (accelerationOf(scene_, path, times, obj) > kSteady)
        return cat("'", obj, "' is accelerated too much for what carries it");
    return "";
  }

  /// Applies the effect of an action to the scene, and reports its violations.
  void apply(const TaskAction& action, const std::string& text) {
    if (action[0] == "hook_start" && holderOf(scene_, action[3], {action[5]}).empty())
      report(text, cat("'", action[5], "' does not hold '", action[4], "'"));
    if (isPick(action) || action[0] == "handover" || startsSliding(action)) {
      if (const double apart = handGap(scene_, action[1], action[3]); apart > kOffPlace)
        report(text, cat("the hand is ", fixed(apart, 4), " m away from what it takes"));
      hang(scene_, action[1], action[3]);
      is_freed_ = is_freed_ || (action[0] == "handover" && isWedged(action[1]));
      if (startsSliding(action)) pushed_[action[1]] = action[3];
    } else if (isPlace(action) || endsSliding(action)) {
      hang(scene_, action[1], action[3]);
      checkStanding(action[1], action[3], action[0] == "lay" ? action[4] : "", text);
      pushed_.erase(action[1]);
      is_freed_ = is_freed_ || (isPlace(action) && isWedged(action[1]));
    } else if (isHold(action)) {
      const auto is_door = [&](const TaskDoor& door) { return door.name == action[1]; };
      if (std::ranges::none_of(doors_, is_door) || holderOf(scene_, action[2], {action[1]}).empty())
        report(text, cat("'", action[2], "' is no handle of a door"));
      if (const double apart = handGap(scene_, action[2], action[3]); apart > kOffPlace)
        report(text, cat("the hand is ", fixed(apart, 4), " m away from what it takes"));
      held_.insert_or_assign(action[1], Held{action[2], action[3], scene_});
    } else if (isGuided(action)) {
      checkDoor(action[1], action[0] == "open" ? "opened" : "closed", text);
      held_.erase(action[1]);
    } else if (action[0] == "pose") {
      checkPose(action[1], action[3], text);
    }
  }

  void checkStanding(const std::string& obj, const std::string& to, const std::string& face, const std::string& text) {
    const Frame thing = scene_.getFrame(obj), place = scene_.getFrame(to);
    const Vector3d above = place.getRotationMatrix().col(2);
    const Vector3d axes = thing.getRotationMatrix().transpose() * above * (above.z() < 0. ? -1. : 1.);
    const std::string with_face = face.empty() ? "" : cat(", with ", face, " up");
    const bool is_as_before = (resting_.at(obj) * axes).z() > levelCosine();
    const bool is_level = axes.cwiseAbs().maxCoeff() >= levelCosine() || (face.empty() && is_as_before);
    if (!is_level || (!face.empty() && shareOf(axes, face) < levelCosine()))
      report(text, cat("it does not stand level", with_face));
    if (const double gap = standingGap(scene_, obj, to); std::abs(gap) > kOffPlace)
      report(text, cat("it is ", fixed(gap, 4), " m above its place"));
    const Vector3d relative = place.getRotationMatrix().transpose() * (thing.getPosition() - place.getPosition());
    const Eigen::Vector2d sides = placeSides(place);
    const double inside = (.5 * sides - relative.head<2>().cwiseAbs()).minCoeff();
    if (inside < std::min(kEdge, .25 * sides.minCoeff()) - 1e-6)
      report(text, cat("its center is ", fixed(inside, 4), " m inside the edge"));
    else if (!isSupported(thing, place))
      report(text, "it falls over: its center of mass is not above what it stands on");
  }

  void checkPose(const std::string& obj, const std::string& goal, const std::string& text) {
    const Frame thing = scene_.getFrame(obj), wanted = scene_.getFrame(goal);
    const double apart = (thing.getPosition() - wanted.getPosition()).norm();
    const double cosine = .5 * ((thing.getRotationMatrix().transpose() * wanted.getRotationMatrix()).trace() - 1.);
    if (apart <= kOffPlace && cosine >= levelCosine()) return;
    const double degrees = std::acos(std::clamp(cosine, -1., 1.)) * 180. / std::numbers::pi;
    report(text, cat("it is ", fixed(apart, 4), " m and ", fixed(degrees, 2), " degrees from the pose"));
  }

  void checkDoor(const std::string& name, const std::string& wanted, const std::string& text) {
    const auto door = std::ranges::find(doors_, name, &TaskDoor::name);
    if (door == doors_.end()) return;
    const double q = scene_.getJointState()[door->dof];
    if (door->stateAt(q) != wanted)
      report(text,
             cat("'", name, "' is not ", wanted, ": it is at ", fixed(100. * door->share(q), 1), " % of its range"));
  }

  /// Checks the goals about doors.
  void checkDoors() {
    for (const Literal& literal : plan_.goal) {
      if (literal.arguments.size() != 1) continue;
      const auto door = std::ranges::find(doors_, literal.arguments[0], &TaskDoor::name);
      const bool is_state = literal.predicate == "opened" || literal.predicate == "closed";
      if (door == doors_.end() || !is_state) continue;
      if ((door->stateAt(scene_.getJointState()[door->dof]) == literal.predicate) == literal.negated)
        violations_.push_back(cat("at the end ", literal.str(), " does not hold"));
    }
  }

  /// Checks the goals about faces.
  void checkFaces() {
    for (const Literal& literal : plan_.goal) {
      if (literal.predicate != "up" || literal.arguments.size() != 2) continue;
      const Vector3d heights = scene_.getFrame(literal.arguments[1]).getRotationMatrix().row(2);
      if ((shareOf(heights, literal.arguments[0]) >= levelCosine()) == literal.negated)
        violations_.push_back(cat("at the end ", literal.str(), " does not hold"));
    }
  }

  struct Held {
    std::string handle, hand;
    Config taken;  ///< the scene at that time
  };

  Config scene_;
  const TaskPlan& plan_;
  const double margin_;  ///< of pairs whose contact is not meant, m
  TaskAction before_;    ///< the last action
  const std::vector<TaskDoor> doors_;
  std::map<std::string, Held> held_;           ///< by door: the handle and its hand
  FramePairs wedged_;                          ///< pairs that overlap initially because of a held object
  std::vector<double> depth_;                  ///< their initial depths, m
  bool is_freed_ = false;                      ///< the held object was put down
  const Pairs ignored_;                        ///< overlaps of the initial scene
  std::map<std::string, std::string> pushed_;  ///< by object: its pusher
  std::map<std::string, Matrix3d> resting_;    ///< rotations in which objects lay before the plan
  Lines violations_;
};

/// Returns the literals of a goal that do not hold in a state.
Lines unmetGoals(const std::vector<Literal>& goal, const std::vector<Literal>& state) {
  Lines wrong;
  for (const Literal& literal : goal) {
    Literal fact = literal;
    fact.negated = false;
    if (contains(state, fact) == literal.negated)
      wrong.push_back(cat("the goal ", literal.str(), " does not hold after the last action"));
  }
  return wrong;
}

/// Throws ValueError if the plan does not fit the scene.
void requirePlan(const Config& C, const TaskPlan& plan) {
  const int dofs = C.getJointDimension();
  if (plan.segments.size() != plan.actions.size())
    throw ValueError(cat("checkTaskPlan: ", plan.segments.size(), " segments for ", plan.actions.size(), " actions"));
  if (plan.times.size() != plan.path.rows() || (plan.path.rows() > 0 && plan.path.cols() != dofs))
    throw ValueError(cat("checkTaskPlan: the path has shape (", plan.path.rows(), ", ", plan.path.cols(),
                         "), and there are ", plan.times.size(), " times; expected a row of ", dofs,
                         " numbers for each"));
  if (plan.limits.size() > 0 && (plan.limits.rows() != 2 || plan.limits.cols() != dofs))
    throw ValueError(cat("checkTaskPlan: the limits have shape (", plan.limits.rows(), ", ", plan.limits.cols(),
                         "); expected (2, ", dofs, ")"));
  for (const RowRange& rows : plan.segments)
    if (rows.begin < 0 || rows.size() < 1 || rows.end > plan.path.rows())
      throw ValueError(cat("checkTaskPlan: rows ", rows.begin, " to ", rows.end, " of a path of ", plan.path.rows()));
  for (const TaskAction& action : plan.actions) requireWords(action);
}

}  // namespace

std::vector<std::string> checkTaskPlan(const Config& C, const TaskPlan& plan,
                                       const std::vector<std::vector<Literal>>& states, std::optional<double> margin) {
  requirePlan(C, plan);
  Lines wrong = states.empty() ? Lines() : unmetGoals(plan.goal, states.back());
  const Config open = withOpenHands(C);
  const Config scene = plan.scenes.empty() ? open : withFingersOf(open, plan.scenes.front());
  const Lines more = PlanPlayer(scene, plan, margin.value_or(plan.margin)).violations();
  wrong.insert(wrong.end(), more.begin(), more.end());
  return wrong;
}

}  // namespace kinegraph
