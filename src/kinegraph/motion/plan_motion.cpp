#include "kinegraph/motion/plan_motion.h"

#include <algorithm>
#include <chrono>

#include "kinegraph/motion/improve_way.h"
#include "kinegraph/motion/leave_contact.h"
#include "kinegraph/motion/passage_proof.h"
#include "kinegraph/motion/plan_goals.h"
#include "kinegraph/motion/plan_timing.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;

constexpr const char* kWho = "planMotion";
constexpr double kMargins[] = {.1, .05, .03, .02, .01, .005};  // m, tried in turn where clearance is asked for

double secondsSince(Clock::time_point began) { return std::chrono::duration<double>(Clock::now() - began).count(); }

/// A start or goal as the search sees it: where it is blocked by a slight contact, the posture behind it.
struct Gate {
  MotionEnd end;
  VectorXd inside;  ///< from where the search begins
  bool leaves = false;
  double deepest = 0.;  ///< of the contact that is left, m
};

class Planner {
 public:
  Planner(const Config& config, const PlanOptions& options, const MotionWatch& watch)
      : config_(config),
        options_(options),
        limits_(planLimits(config, options)),
        crew_(options.threads),
        watch_([this, &watch] { return (watch && watch() && (cancelled_ = true)) || isLate(); }) {
    plan_.space = std::make_shared<const JointSpace>(*config.program());
    plan_.scene = std::make_shared<const State>(config.state());
    demands_ = {.scene = plan_.scene.get(),
                .space = plan_.space.get(),
                .clearance = {.margin = options.margin},
                .constraints = options.constraints,
                .constraint_tolerance = options.constraint_tolerance};
  }

  MotionPlan run(const MotionGoal& goal, const VectorXd& start) {
    plan_.margin = options_.margin;
    if (lookAtEnds(goal, start) && findWay()) finish();
    return std::move(plan_);
  }

 private:
  bool isLate() const { return secondsSince(began_) > options_.time_limit; }

  void endStage(const char* name, long evaluations, std::string note = {}) {
    plan_.stages.push_back({name, secondsSince(stage_began_), evaluations, std::move(note)});
    stage_began_ = Clock::now();
  }

  bool fail(PlanStatus status, std::string message) {
    plan_.status = status;
    plan_.message = std::move(message);
    return false;
  }

  bool failStopped(const std::string& message) {
    return cancelled_ ? fail(PlanStatus::cancelled, cat("cancelled; ", message))
                      : fail(PlanStatus::out_of_time, cat("time limit of ", options_.time_limit, " s; ", message));
  }

  // --- the ends ----------------------------------------------------------------------------------------------------

  /// A blocked end that only touches, or overlaps slightly, is left first.
  Gate gateOf(Steering& steering, MotionEnd end, const std::string& what) {
    Gate gate{end, end.q};
    plan_.space->normalize(gate.inside);
    const bool slight = !end.near.empty() && end.near.front().distance >= -options_.touching;
    if (end.isFree() || !slight) return gate;
    const std::optional<VectorXd> inside = leaveContact(config_, steering, end, options_.margin);
    if (!inside) return gate;
    plan_.notes.push_back(cat("the ", what, " is in contact: ", pairsInWords(*config_.program(), end.near),
                              what == "start" ? "; the motion first leaves it" : "; the motion comes to it last"));
    gate.inside = *inside;
    gate.leaves = true;
    gate.deepest = end.near.front().distance - 2. * Clearance::kTolerance;
    gate.end = checkEnd(steering, *config_.program(), *inside, options_.margin, what, kWho);
    gate.end.q = end.q;
    return gate;
  }

  bool lookAtEnds(const MotionGoal& goal, const VectorXd& start) {
    Steering& steering = crew_.of(0, demands_);
    start_ = gateOf(steering, checkEnd(steering, *config_.program(), start, options_.margin, "start", kWho), "start");
    if (!start_.end.isFree()) return fail(PlanStatus::start_blocked, start_.end.problem);
    GoalPostures postures = goalPostures(config_, goal, start_.end.q, steering, options_, watch_);
    if (!postures.was_reached)
      return watch_() ? failStopped(postures.message) : fail(PlanStatus::unreached, postures.message);
    std::string problem;
    for (std::size_t i = 0; i < postures.ends.size(); ++i) {
      Gate gate = gateOf(steering, postures.ends[i], "goal");
      if (gate.end.isFree()) {
        goals_.push_back(gate);
        goal_numbers_.push_back(int(i));
      } else if (problem.empty()) {
        problem = gate.end.problem;
      }
    }
    endStage("ends", steering.evaluations(),
             cat(goals_.size(), " of ", postures.ends.size(), " goal postures are free"));
    if (goals_.empty()) return fail(PlanStatus::goal_blocked, problem);
    if (plan_.notes.size() > 3) plan_.notes.resize(3);
    return true;
  }

  /// Around gates that keep less than the margin, it is what they keep.
  Clearance clearance(double margin) const {
    std::vector<MotionEnd> ends;
    for (const Gate& gate : goals_) ends.push_back(gate.end), ends.back().q = gate.inside;
    ends.push_back(start_.end);
    ends.back().q = start_.inside;
    std::vector<const MotionEnd*> list;
    for (const MotionEnd& end : ends) list.push_back(&end);
    Clearance clearance = clearanceAround(margin, list);
    clearance.guard = Clearance::kGuard;
    return clearance;
  }

  // --- the way -----------------------------------------------------------------------------------------------------

  WayRequest request() {
    WayRequest request{.demands = demands_, .starts = {start_.inside}, .goals = {}};
    for (const Gate& gate : goals_) request.goals.push_back(gate.inside);
    request.seed = options_.seed;
    request.effort = options_.evaluations;
    request.threads = options_.threads;
    request.watch = watch_;
    request.steering = &crew_.of(0, demands_);
    return request;
  }

  bool findWay() {
    Way way;
    if (options_.optimize == "clearance") way = searchWithRoom();
    if (way.points.empty()) {
      demands_.clearance = clearance(options_.margin);
      way = searchWay(request());
    }
    plan_.attempts = way.attempts;
    plan_.trees = way.trees;
    endStage("search", way.effort, noteOf(way));
    if (way.points.empty()) return failSearch(way);
    improve(way);
    return true;
  }

  static std::string noteOf(const Way& way) {
    if (way.is_line) return "the straight motion is free";
    return cat(way.attempts.size(), " attempts with trees, ", way.points.empty() ? "no way" : "a way");
  }

  /// With the largest margin for which a way is found soon.
  Way searchWithRoom() {
    for (const double margin : kMargins) {
      if (margin <= options_.margin || watch_()) continue;
      demands_.clearance = withEndsAt(margin);
      WayRequest asked = request();
      asked.effort = std::max(1l, asked.effort / 20);
      Way way = searchWay(asked);
      if (way.points.empty()) continue;
      plan_.margin = margin;
      return way;
    }
    return {};
  }

  /// Clearances for a larger margin than the ends were looked at with.
  Clearance withEndsAt(double margin) {
    Steering& steering = crew_.of(0, demands_);
    Clearance larger{.margin = margin, .guard = Clearance::kGuard};
    std::vector<MotionEnd> ends;
    for (const Gate& gate : goals_)
      ends.push_back(checkEnd(steering, *config_.program(), gate.inside, margin, "goal", kWho));
    ends.push_back(checkEnd(steering, *config_.program(), start_.inside, margin, "start", kWho));
    std::vector<const MotionEnd*> list;
    for (const MotionEnd& end : ends) list.push_back(&end);
    larger.tight = clearanceAround(margin, list).tight;
    return larger;
  }

  bool failSearch(const Way& way) {
    long draws = 0;
    for (const AttemptReport& attempt : way.attempts) draws += attempt.draws;
    const AttemptReport last = way.attempts.empty() ? AttemptReport() : way.attempts.back();
    plan_.obstacles = obstaclesMet(*config_.program(), way.hits);
    const std::string met = obstaclesInWords(plan_.obstacles);
    const std::string words =
        cat("no way found: ", way.effort, " evaluations, ", draws, " postures drawn in ", way.attempts.size(),
            " attempts; the last trees have ", last.start_nodes, " postures (start) and ", last.goal_nodes, " (goals)",
            met.empty() ? "" : cat("; most motions ended at ", met));
    if (cancelled_) return failStopped(words);
    std::vector<VectorXd> goals;
    for (const Gate& gate : goals_) goals.push_back(gate.inside);
    const bool tight = !demands_.clearance.tight.empty();  // then the margin does not hold everywhere
    const std::string proof = proveNoWay(*plan_.scene, start_.inside, goals, tight ? 0. : options_.margin);
    endStage("prove", 0, proof.empty() ? "no proof that there is none" : "");
    if (!proof.empty()) return fail(PlanStatus::impossible, cat(proof, "; ", words));
    if (way.was_stopped) return failStopped(words);
    return fail(PlanStatus::no_way, words);
  }

  VectorXd weight() const {
    if (options_.optimize == "length") return VectorXd::Ones(limits_.velocity.size());
    return limits_.velocity.minCoeff() * limits_.velocity.cwiseInverse();
  }

  void improve(const Way& first) {
    best_ = improveWay(first, request(),
                       {.tries = options_.tries, .weight = weight(), .late = [this] { return isLate(); }}, crew_);
    endStage("shorten", best_.evaluations,
             first.is_line ? "" : cat("the best of ", options_.tries, options_.tries == 1 ? " way" : " ways"));
    const double before = best_.cost;
    const int refinements = options_.optimize == "length" ? 2 : 0;  // each corner more takes time
    tighten(best_, request(), weight(), refinements, crew_);
    endStage("tighten", best_.evaluations,
             best_.cost < before ? cat(lround(1000. * (1. - best_.cost / before)) / 10., " % shorter") : "");
  }

  // --- the motion --------------------------------------------------------------------------------------------------

  /// The whole path, gates included, as rows.
  MatrixXd rows(const std::vector<VectorXd>& points, const Way& way) const {
    std::vector<VectorXd> all = points;
    if (start_.leaves) {
      all.insert(all.begin(), start_.end.q);
    } else {
      all.front() = start_.end.q;  // an endless joint keeps its turns
    }
    if (goals_[std::size_t(way.goal)].leaves) all.push_back(goals_[std::size_t(way.goal)].end.q);
    return plan_.space->unroll(all);
  }

  /// What keeps the margins without a guard.
  Steering& exactly() {
    MotionDemands exact = demands_;
    exact.clearance.guard = 0.;
    return crew_.of(0, exact);
  }

  /// Is each straight motion free at all times, but for those that leave and enter contacts, which are known?
  bool verify(const MatrixXd& path, const Way& way, long& evaluations) {
    Steering& steering = exactly();
    const long before = steering.evaluations();
    const Eigen::Index first = start_.leaves ? 2 : 1,
                       last = path.rows() - 1 - (goals_[std::size_t(way.goal)].leaves ? 1 : 0);
    bool is_free = true;
    for (Eigen::Index k = first; k <= last && is_free; ++k)
      is_free = steering.isFree(path.row(k - 1).transpose(), path.row(k).transpose());
    evaluations += steering.evaluations() - before;
    return is_free;
  }

  /// What all of the path keeps: the margin, the least one around the ends, or the depth of a contact that is left.
  double kept() const {
    double least = plan_.margin;
    for (const Clearance::Tight& tight : demands_.clearance.tight) least = std::min(least, tight.margin);
    for (const Gate* gate : {&start_, &goals_[std::size_t(best_.way.goal)]})
      if (gate->leaves) least = std::min(least, gate->deepest);
    return least;
  }

  void finish() {
    long evaluations = 0;
    plan_.path = rows(best_.points, best_.way);
    const bool is_free = verify(plan_.path, best_.way, evaluations);
    if (!is_free) {
      plan_.path = rows(best_.way.points, best_.way);  // as the search had verified it
      if (!verify(plan_.path, best_.way, evaluations)) {
        plan_.path.resize(0, 0);
        fail(PlanStatus::no_way, "the way that was found could not be verified");
        return;
      }
    }
    plan_.first_way = rows(best_.way.points, best_.way);
    plan_.goal = goal_numbers_[std::size_t(best_.way.goal)];
    plan_.kept = kept();
    plan_.length = pathLength(*plan_.space, plan_.path);
    endStage("verify", evaluations, is_free ? "" : "the way as it was found, since the shortened one was not free");
    plan_.timed = timeMotion(exactly(), plan_.path, limits_, options_.blend);
    endStage("time", 0, plan_.timed.str());
    plan_.status = PlanStatus::solved;
  }

  const Config& config_;
  const PlanOptions& options_;
  const MotionLimits limits_;
  SteeringCrew crew_;
  const MotionWatch watch_;
  const Clock::time_point began_ = Clock::now();
  Clock::time_point stage_began_ = began_;
  bool cancelled_ = false;
  MotionPlan plan_;
  MotionDemands demands_;
  Gate start_;
  std::vector<Gate> goals_;
  std::vector<int> goal_numbers_;
  ShortWay best_;
};

}  // namespace

MotionPlan planMotion(const Config& config, const MotionGoal& goal, const PlanOptions& options,
                      const std::optional<VectorXd>& start, const MotionWatch& watch) {
  options.validateFor(config.getJointDimension());
  return Planner(config, options, watch).run(goal, start.value_or(config.getJointState()));
}

}  // namespace kinegraph
