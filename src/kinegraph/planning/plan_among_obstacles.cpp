#include "kinegraph/planning/plan_among_obstacles.h"

#include <algorithm>
#include <chrono>

#include "kinegraph/planning/dynamic_obstacles/dynamic_timing.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline planning_internal {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPlaces = 32;            // of each obstacle that a path avoids
constexpr int kOtherSeeds = 2;         // further paths with other random numbers if none could be timed
constexpr int kFurtherBudget = 20000;  // evaluations of the search of a further path
constexpr int kSamples = 1000;         // for refuges
constexpr std::size_t kRefuges = 6;    // that are tried
constexpr double kApart = .3;          // between refuges, in joint space
constexpr double kEnough = 1.1;        // of the duration without dynamic obstacles: a faster motion ends the search

/// Equally spaced times of the motion of obstacles.
std::vector<double> spreadTimes(double end) {
  std::vector<double> times;
  for (int k = 0; k <= kPlaces; ++k) times.push_back(end * k / kPlaces);
  return times;
}

class PlanAmongObstacles {
 public:
  PlanAmongObstacles(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                     const CancellationToken& cancellation, const KnownCurves& known)
      : goal_(goal),
        options_(options),
        start_(start),
        known_(known),
        limits_(limitsFromStart(planLimits(config, options), options)),
        scene_(std::make_shared<const DynamicScene>(config, options.obstacle_trajectories, "planMotion")),
        static_(scene_->staticScene()),
        check_(*scene_, options.margin),
        cancellation_([this, &cancellation] {
          return (cancellation && cancellation()) || secondsSinceBegin() > options_.time_limit;
        }),
        user_cancellation_(cancellation) {}

  MotionPlan run() {
    keepStartClearance();
    tryIn(static_, options_.seed, "among static obstacles");
    const bool may_improve = was_reached_ && !isDone();
    if (may_improve && scene_->end() > 0.) {
      tryIn(scene_->staticScene({scene_->end()}), options_.seed, "around the final places of obstacles");
      tryIn(scene_->staticScene(spreadTimes(scene_->end())), options_.seed, "around all places of obstacles");
    }
    for (int i = 1; i <= kOtherSeeds && may_improve && !best_.feasible(); ++i)
      tryIn(static_, options_.seed + std::uint64_t(i), "with other random numbers");
    if (may_improve && !best_.feasible()) tryRefuges();
    if (!best_.feasible()) best_ = std::move(failure_);
    if (best_.scene) best_.scene = std::make_shared<const State>(static_.state());  // without copies of obstacles
    best_.dynamic_scene = scene_;
    best_.warnings.insert(best_.warnings.end(), warnings_.begin(), warnings_.end());
    return std::move(best_);
  }

 private:
  double secondsSinceBegin() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
  bool isDone() const { return (best_.feasible() && best_.duration() <= kEnough * least_) || cancellation_(); }

  /// If the start is closer to an obstacle than the margin, the motion keeps that distance instead.
  void keepStartClearance() {
    if (options_.start_velocity.size() > 0 && !options_.start_velocity.isZero(0.)) return;
    const double most = options_.margin + 2. * Clearance::kGuard, now = check_.clearance(start_, 0., most);
    if (now >= most || now < 0.) return;
    check_.setMargin(std::max(0., now - 2. * Clearance::kGuard));
    warnings_.push_back(
        cat("the start is ", formatLength(now), " from a dynamic obstacle; the motion keeps that distance"));
  }

  void tryIn(const Config& scene, std::uint64_t seed, const char* how) {
    if (cancellation_()) return;
    PlanOptions static_options = options_;
    static_options.obstacle_trajectories.clear();
    static_options.seed = seed;
    if (was_reached_) static_options.max_evaluations = std::min(static_options.max_evaluations, kFurtherBudget);
    static_options.time_limit = options_.timeLeft(secondsSinceBegin());
    MotionPlan plan = planFromVelocity(scene, goal_, static_options, start_, user_cancellation_, known_);
    if (!plan.feasible()) {
      if (!was_reached_) failure_ = std::move(plan);
      return;
    }
    consider(std::move(plan), how);
  }

  /// Times a path, and keeps it if it arrives first.
  void consider(MotionPlan plan, const char* how) {
    const Clock::time_point began = Clock::now();
    const long before = check_.evaluations;
    if (!was_reached_) least_ = plan.duration();
    const DynamicTiming timing = timeAmongObstacles(plan.timed_path, limits_, check_, cancellation_);
    const bool fits =
        timing.was_found && !check_.contact(plan.timed_path.curve(), timing.scaling, limits_.acceleration);
    plan.stages.push_back({"dynamic_timing", std::chrono::duration<double>(Clock::now() - began).count(),
                           check_.evaluations - before, cat("a path ", how, fits ? "" : " that could not be timed")});
    if (!was_reached_) failed_goal_ = plan.path.bottomRows(1).transpose();
    if (fits) {
      setScaling(plan, timing);
    } else {
      fail(plan, timing);
    }
    if (!was_reached_ && !fits) failure_ = plan;
    was_reached_ = true;
    if (fits && (!best_.feasible() || plan.duration() < best_.duration())) best_ = std::move(plan);
  }

  // --- refuges -----------------------------------------------------------------------------------------------------

  bool isAlwaysFree(const VectorXd& q) {
    const std::vector<double>& breaks = scene_->breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i)
      if (!check_.staysFree(q, breaks[i - 1], breaks[i])) return false;
    return check_.isFree(q, breaks.back());
  }

  /// Samples refuges, and selects some that are apart: in turn the closest one to the start, and the one with the
  /// smallest excess length over the line to the goal.
  std::vector<VectorXd> refuges(const VectorXd& goal) {
    const JointSpace space(*static_.model());
    const State state = static_.state();
    ClearanceCheck static_check(state, space, {.margin = options_.margin, .guard = Clearance::kGuard});
    Rng rng(options_.seed);
    std::vector<VectorXd> found;
    for (int i = 0; i < kSamples; ++i) {
      const double share = rng.uniform();
      const VectorXd sampled = space.sample(rng, start_), &from = i % 4 ? start_ : goal;
      const VectorXd q = from + share * share * space.difference(from, sampled);
      if (isAlwaysFree(q) && static_check.isFree(q)) found.push_back(q);
    }
    std::vector<VectorXd> chosen;
    while (chosen.size() < kRefuges && !found.empty()) {
      const double with_goal = chosen.size() % 2 ? 1. : 0.;
      const auto next = std::ranges::min_element(found, {}, [&](const VectorXd& q) {
        return space.distance(start_, q) + with_goal * space.distance(q, goal);
      });
      chosen.push_back(*next);
      std::erase_if(found, [&](const VectorXd& q) { return space.distance(q, chosen.back()) < kApart; });
    }
    return chosen;
  }

  /// Tries paths via refuges.
  void tryRefuges() {
    if (failed_goal_.size() == 0 || !JointSpace(*static_.model()).dofsWithoutRange().empty()) return;
    PlanOptions static_options = options_;
    static_options.obstacle_trajectories.clear();
    static_options.max_evaluations = std::min(static_options.max_evaluations, kFurtherBudget);
    KnownCurves known = known_;
    known.to_goal.clear();
    for (const VectorXd& refuge : refuges(failed_goal_)) {
      if (cancellation_()) return;
      static_options.time_limit = options_.timeLeft(secondsSinceBegin());
      const MotionPlan aside =
          planFromVelocity(static_, MotionGoal(refuge), static_options, start_, user_cancellation_, known);
      PlanOptions at_rest = static_options;
      at_rest.time_limit = options_.timeLeft(secondsSinceBegin());
      at_rest.start_velocity = at_rest.start_acceleration = {};
      MotionPlan onward = planFromVelocity(static_, goal_, at_rest, refuge, user_cancellation_, {});
      if (!aside.feasible() || !onward.feasible()) continue;
      onward.timed_path = concatenated(aside.timed_path, onward.timed_path);
      onward.path = onward.raw_path = onward.timed_path.path;
      onward.length += aside.length;
      onward.verified_margin = std::min(aside.verified_margin, onward.verified_margin);
      consider(std::move(onward), "via a refuge");
    }
  }

  // --- results -----------------------------------------------------------------------------------------------------

  static void setScaling(MotionPlan& plan, const DynamicTiming& timing) {
    const TimedPath& timed = plan.timed_path;
    VectorXd times = timed.times;
    for (Eigen::Index i = 0; i < times.size(); ++i)
      times[i] = timing.scaling.timeOf(timed.curve().marks()[std::size_t(i)]);
    const double length = std::max(timed.curve().length(), 1e-300);
    for (const DynamicTiming::Wait& wait : timing.waits)
      plan.warnings.push_back(cat("waits for ", wait.seconds, " s at time ", wait.begin, " s, at ",
                                  std::lround(100. * wait.place / length), " % of the path"));
    plan.timed_path =
        TimedPath::fromParts(RetimeStatus::timed, "", timed.path, std::move(times), timed.curve(), timing.scaling);
  }

  void fail(MotionPlan& plan, const DynamicTiming& timing) const {
    plan.status = cancellation_()
                      ? (user_cancellation_ && user_cancellation_() ? PlanStatus::cancelled : PlanStatus::timeout)
                      : PlanStatus::no_timing_found;
    plan.message = timing.was_found ? "the timing that was found could not be verified" : timing.message;
    plan.path.resize(0, 0);
    plan.timed_path = {};
    plan.goal = -1;
  }

  const MotionGoal& goal_;
  const PlanOptions& options_;
  const VectorXd start_;
  const KnownCurves& known_;
  const MotionLimits limits_;
  const std::shared_ptr<const DynamicScene> scene_;
  const Config static_;  ///< the scene without dynamic obstacles
  DynamicCheck check_;
  const Clock::time_point began_ = Clock::now();
  const CancellationToken cancellation_;
  const CancellationToken& user_cancellation_;
  MotionPlan best_, failure_;
  VectorXd failed_goal_;  ///< end of the first path
  std::vector<std::string> warnings_;
  double least_ = 0.;         ///< duration without dynamic obstacles
  bool was_reached_ = false;  ///< there is a path among static obstacles
};

}  // namespace

MotionPlan planAmongObstacles(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                              const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known) {
  return PlanAmongObstacles(config, goal, options, start, cancellation, known).run();
}

}  // namespace kinegraph::inline planning_internal
