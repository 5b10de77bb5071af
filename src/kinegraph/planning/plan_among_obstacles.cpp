#include "kinegraph/planning/plan_among_obstacles.h"

#include <algorithm>
#include <chrono>

#include "kinegraph/planning/dynamic_obstacles/dynamic_timing.h"
#include "kinegraph/planning/plan_timing.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kPlaces = 32;          // of each obstacle that a way goes around
constexpr int kOtherSeeds = 2;       // ways that are planned with other random numbers where none could be timed
constexpr int kOtherEffort = 20000;  // of the search of another way, at most
constexpr int kDraws = 1000;         // of postures to which no obstacle comes
constexpr std::size_t kRefuges = 6;  // of them, by which ways are tried
constexpr double kApart = .3;        // in joint space, from each other
constexpr double kEnough = 1.1;      // of the time without moving obstacles: then no other way is tried

/// Times that are spread over a motion of obstacles.
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
        still_(scene_->standing()),
        check_(*scene_, options.margin),
        cancellation_([this, &cancellation] {
          return (cancellation && cancellation()) || secondsSinceBegin() > options_.time_limit;
        }),
        user_cancellation_(cancellation) {}

  MotionPlan run() {
    keepWhatStartKeeps();
    tryIn(still_, options_.seed, "among what stands still");
    const bool may_improve = was_reached_ && !isDone();
    if (may_improve && scene_->end() > 0.) {
      tryIn(scene_->standing({scene_->end()}), options_.seed, "around where obstacles end");
      tryIn(scene_->standing(spreadTimes(scene_->end())), options_.seed, "around all places of obstacles");
    }
    for (int i = 1; i <= kOtherSeeds && may_improve && !best_.feasible(); ++i)
      tryIn(still_, options_.seed + std::uint64_t(i), "with other random numbers");
    if (may_improve && !best_.feasible()) tryRefuges();
    if (!best_.feasible()) best_ = std::move(failure_);
    if (best_.scene) best_.scene = std::make_shared<const State>(still_.state());  // without copies of obstacles
    best_.dynamic_scene = scene_;
    best_.warnings.insert(best_.warnings.end(), notes_.begin(), notes_.end());
    return std::move(best_);
  }

 private:
  double secondsSinceBegin() const { return std::chrono::duration<double>(Clock::now() - began_).count(); }
  bool isDone() const { return (best_.feasible() && best_.duration() <= kEnough * least_) || cancellation_(); }

  /// A start that is nearer to an obstacle than the margin: that distance is kept.
  void keepWhatStartKeeps() {
    if (options_.start_velocity.size() > 0 && !options_.start_velocity.isZero(0.)) return;
    const double most = options_.margin + 2. * Clearance::kGuard, now = check_.clearance(start_, 0., most);
    if (now >= most || now < 0.) return;
    check_.setMargin(std::max(0., now - 2. * Clearance::kGuard));
    notes_.push_back(cat("the start is ", formatLength(now), " from a moving obstacle, and so the motion keeps that"));
  }

  void tryIn(const Config& scene, std::uint64_t seed, const char* how) {
    if (cancellation_()) return;
    PlanOptions still = options_;
    still.obstacle_trajectories.clear();
    still.seed = seed;
    if (was_reached_) still.max_evaluations = std::min(still.max_evaluations, kOtherEffort);
    still.time_limit = options_.timeLeft(secondsSinceBegin());
    MotionPlan plan = planFromVelocity(scene, goal_, still, start_, user_cancellation_, known_);
    if (!plan.feasible()) {
      if (!was_reached_) failure_ = std::move(plan);
      return;
    }
    consider(std::move(plan), how);
  }

  /// Times a way, and keeps it if it arrives first.
  void consider(MotionPlan plan, const char* how) {
    const Clock::time_point began = Clock::now();
    const long before = check_.evaluations;
    if (!was_reached_) least_ = plan.duration();
    const DynamicTiming timing = timeAmongObstacles(plan.timed, limits_, check_, cancellation_);
    const bool fits = timing.was_found && !check_.contact(plan.timed.curve(), timing.scaling, limits_.acceleration);
    plan.stages.push_back({"dynamic_obstacles", std::chrono::duration<double>(Clock::now() - began).count(),
                           check_.evaluations - before, cat("a way ", how, fits ? "" : " that could not be timed")});
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

  // --- stepping aside ----------------------------------------------------------------------------------------------

  bool isAlwaysFree(const VectorXd& q) {
    const std::vector<double>& breaks = scene_->breaks();
    for (std::size_t i = 1; i < breaks.size(); ++i)
      if (!check_.staysFree(q, breaks[i - 1], breaks[i])) return false;
    return check_.isFree(q, breaks.back());
  }

  /// Postures to which no obstacle comes, away from each other: in turn the nearest one to the start, and the one that is
  /// the smallest detour on a straight way to the goal.
  std::vector<VectorXd> refuges(const VectorXd& goal) {
    const JointSpace space(*still_.model());
    const State state = still_.state();
    ClearanceCheck still(state, space, {.margin = options_.margin, .guard = Clearance::kGuard});
    Rng rng(options_.seed);
    std::vector<VectorXd> found;
    for (int i = 0; i < kDraws; ++i) {
      const double share = rng.uniform();
      const VectorXd sampled = space.sample(rng, start_), &from = i % 4 ? start_ : goal;
      const VectorXd q = from + share * share * space.difference(from, sampled);
      if (isAlwaysFree(q) && still.isFree(q)) found.push_back(q);
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

  /// Ways by a posture to which no obstacle comes, to wait there.
  void tryRefuges() {
    if (failed_goal_.size() == 0 || !JointSpace(*still_.model()).dofsWithoutRange().empty()) return;
    PlanOptions still = options_;
    still.obstacle_trajectories.clear();
    still.max_evaluations = std::min(still.max_evaluations, kOtherEffort);
    KnownCurves known = known_;
    known.to_goal.clear();
    for (const VectorXd& refuge : refuges(failed_goal_)) {
      if (cancellation_()) return;
      still.time_limit = options_.timeLeft(secondsSinceBegin());
      const MotionPlan aside = planFromVelocity(still_, MotionGoal(refuge), still, start_, user_cancellation_, known);
      PlanOptions at_rest = still;
      at_rest.time_limit = options_.timeLeft(secondsSinceBegin());
      at_rest.start_velocity = at_rest.start_acceleration = {};
      MotionPlan onward = planFromVelocity(still_, goal_, at_rest, refuge, user_cancellation_, {});
      if (!aside.feasible() || !onward.feasible()) continue;
      onward.timed = inTurn(aside.timed, onward.timed);
      onward.path = onward.raw_path = onward.timed.path;
      onward.length += aside.length;
      onward.verified_margin = std::min(aside.verified_margin, onward.verified_margin);
      consider(std::move(onward), "by a place where nothing comes");
    }
  }

  // --- what comes of it --------------------------------------------------------------------------------------------

  static void setScaling(MotionPlan& plan, const DynamicTiming& timing) {
    const TimedPath& timed = plan.timed;
    VectorXd times = timed.times;
    for (Eigen::Index i = 0; i < times.size(); ++i)
      times[i] = timing.scaling.timeOf(timed.curve().marks()[std::size_t(i)]);
    const double length = std::max(timed.curve().length(), 1e-300);
    for (const DynamicTiming::Wait& wait : timing.waits)
      plan.warnings.push_back(cat("waits for ", wait.seconds, " s from ", wait.begin, " s on, at ",
                                  std::lround(100. * wait.place / length), " % of the way"));
    plan.timed =
        TimedPath::fromParts(RetimeStatus::timed, "", timed.path, std::move(times), timed.curve(), timing.scaling);
  }

  void fail(MotionPlan& plan, const DynamicTiming& timing) const {
    plan.status = cancellation_()
                      ? (user_cancellation_ && user_cancellation_() ? PlanStatus::cancelled : PlanStatus::timeout)
                      : PlanStatus::no_timing_found;
    plan.message = timing.was_found ? "the timing that was found could not be verified" : timing.message;
    plan.path.resize(0, 0);
    plan.timed = {};
    plan.goal = -1;
  }

  const MotionGoal& goal_;
  const PlanOptions& options_;
  const VectorXd start_;
  const KnownCurves& known_;
  const MotionLimits limits_;
  const std::shared_ptr<const DynamicScene> scene_;
  const Config still_;  ///< the scene without obstacles
  DynamicCheck check_;
  const Clock::time_point began_ = Clock::now();
  const CancellationToken cancellation_;
  const CancellationToken& user_cancellation_;
  MotionPlan best_, failure_;
  VectorXd failed_goal_;  ///< where the first way ends
  std::vector<std::string> notes_;
  double least_ = 0.;         ///< duration without moving obstacles
  bool was_reached_ = false;  ///< there is a way among what stands still
};

}  // namespace

MotionPlan planAmongObstacles(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                              const VectorXd& start, const CancellationToken& cancellation, const KnownCurves& known) {
  return PlanAmongObstacles(config, goal, options, start, cancellation, known).run();
}

}  // namespace kinegraph
