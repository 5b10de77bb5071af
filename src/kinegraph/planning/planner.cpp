#include "kinegraph/planning/planner.h"

#include <algorithm>

#include "kinegraph/planning/infeasibility_proof.h"
#include "kinegraph/planning/plan_goals.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/retreat_motion.h"
#include "kinegraph/planning/smooth_motion.h"

namespace kinegraph {

namespace {

constexpr const char* kWho = "planMotion";
constexpr int kRoundTries = 8;          // ways that are searched side by side, before the best one is known to others
constexpr double kWorthPulling = 1.25;  // of the best cost: a way that is so much longer is not pulled taut
constexpr double kProofUntil = 1.25;    // of the time limit
constexpr double kWorthTelling = 1e-4;  // of what is made small, by which the next motion is better
constexpr double kMargins[] = {.1, .05, .03, .02, .01, .005};  // m, tried in turn where clearance is asked for

double secondsSince(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

std::string noteOf(const Way& way) {
  if (way.is_line) return "the straight motion is free";
  return cat(way.attempts.size(), " attempts with trees, ", way.points.empty() ? "no way" : "a way");
}

}  // namespace

Planner::Planner(const Config& config, const PlanOptions& options, const CancellationToken& cancellation)
    : config_(config),
      options_(options),
      limits_(planLimits(config, options)),
      contexts_(options.threads),
      user_cancellation_(cancellation),
      cancellation_([this] { return isCancelled() || isLate(); }),
      draws_(*config.model()) {
  plan_.space = std::make_shared<const JointSpace>(*config.model());
  plan_.scene = std::make_shared<const State>(config.state());
  planning_constraints_ = {.scene = plan_.scene.get(),
                           .space = &draws_,
                           .clearance = {.margin = options.margin},
                           .constraints = options.constraints,
                           .constraint_tolerance = options.constraint_tolerance};
}

MotionPlan Planner::run(const MotionGoal& goal, const VectorXd& start) {
  plan_.margin = options_.margin;
  if (checkEndpoints(goal, start) && findPath()) finish();
  return plan_;
}

bool Planner::isCancelled() { return user_cancellation_ && user_cancellation_() && (cancelled_ = true); }

bool Planner::isLate() const { return secondsSince(began_) > options_.time_limit; }

void Planner::endStage(const char* name, long evaluations, std::string note) {
  plan_.stages.push_back({name, secondsSince(stage_began_), evaluations, std::move(note)});
  stage_began_ = Clock::now();
}

bool Planner::fail(PlanStatus status, std::string message) {
  plan_.status = status;
  plan_.message = std::move(message);
  return false;
}

bool Planner::failStopped(const std::string& message) {
  return cancelled_ ? fail(PlanStatus::cancelled, cat("cancelled; ", message))
                    : fail(PlanStatus::timeout, cat("time limit of ", options_.time_limit, " s; ", message));
}

// --- the ends ----------------------------------------------------------------------------------------------------

/// A blocked end that only touches, or overlaps slightly, is left first.
Planner::SearchEndpoint Planner::searchEndpoint(Steering& steering, Endpoint end, const std::string& what) {
  SearchEndpoint gate{end, end.q};
  plan_.space->normalize(gate.inside);
  const bool slight = !end.near.empty() && end.near.front().distance >= -options_.max_start_penetration;
  if (end.isFree() || !slight) return gate;
  const std::optional<VectorXd> inside = retreatFromContact(config_, steering, end, options_.margin);
  if (!inside) return gate;
  plan_.warnings.push_back(cat("the ", what, " is in contact: ", describePairs(*config_.model(), end.near),
                               what == "start" ? "; the motion first leaves it" : "; the motion comes to it last"));
  gate.inside = *inside;
  gate.leaves = true;
  gate.deepest = end.near.front().distance - 2. * Clearance::kTolerance;
  gate.end = checkEndpoint(steering, *config_.model(), *inside, options_.margin, what, kWho);
  gate.end.q = end.q;
  return gate;
}

bool Planner::checkEndpoints(const MotionGoal& goal, const VectorXd& start) {
  Steering& steering = contexts_.of(0, planning_constraints_);
  start_ = searchEndpoint(steering, checkEndpoint(steering, *config_.model(), start, options_.margin, "start", kWho),
                          "start");
  if (!start_.end.isFree()) return fail(PlanStatus::invalid_start, start_.end.problem);
  GoalConfigurations configurations =
      goalConfigurations(config_, goal, start_.end.q, steering, options_, cancellation_);
  if (!configurations.was_reached)
    return cancellation_() ? failStopped(configurations.message)
                           : fail(PlanStatus::goal_unreachable, configurations.message);
  std::string problem;
  for (std::size_t i = 0; i < configurations.ends.size(); ++i) {
    SearchEndpoint gate = searchEndpoint(steering, configurations.ends[i], "goal");
    if (gate.end.isFree()) {
      goals_.push_back(gate);
      goal_numbers_.push_back(int(i));
    } else if (problem.empty()) {
      problem = gate.end.problem;
    }
  }
  endStage("ends", steering.evaluations(),
           cat(goals_.size(), " of ", configurations.ends.size(), " goal postures are free"));
  if (goals_.empty()) return fail(PlanStatus::invalid_goal, problem);
  if (plan_.warnings.size() > 3) plan_.warnings.resize(3);
  for (const std::string& name : steering.manifold().sampled())
    plan_.warnings.push_back(
        cat("the constraint ", name, " was looked at every ", Steering::kSpacing, " along the way"));
  return true;
}

/// Around gates that keep less than the margin, it is what they keep.
Clearance Planner::clearance(double margin) const {
  std::vector<Endpoint> ends;
  for (const SearchEndpoint& gate : goals_) ends.push_back(gate.end), ends.back().q = gate.inside;
  ends.push_back(start_.end);
  ends.back().q = start_.inside;
  std::vector<const Endpoint*> list;
  for (const Endpoint& end : ends) list.push_back(&end);
  Clearance clearance = clearanceAround(margin, list);
  clearance.guard = Clearance::kGuard;
  return clearance;
}

// --- the way -----------------------------------------------------------------------------------------------------

PathQuery Planner::request() {
  PathQuery request{.constraints = planning_constraints_, .starts = {start_.inside}, .goals = {}};
  for (const SearchEndpoint& gate : goals_) request.goals.push_back(gate.inside);
  request.seed = options_.seed;
  request.evaluations = options_.max_evaluations;
  request.threads = options_.threads;
  request.cancellation = cancellation_;
  request.steering = &contexts_.of(0, planning_constraints_);
  return request;
}

bool Planner::findPath() {
  Way way;
  if (options_.optimize == "clearance") way = searchWithRoom();
  if (way.points.empty()) {
    planning_constraints_.clearance = clearance(options_.margin);
    way = searchPath(request());
  }
  plan_.attempts = way.attempts;
  plan_.trees = way.trees;
  endStage("search", way.evaluations, noteOf(way));
  if (way.points.empty()) return failSearch(way);
  improve(way);
  return true;
}

/// With the largest margin for which a way is found soon.
Way Planner::searchWithRoom() {
  for (const double margin : kMargins) {
    if (margin <= options_.margin || cancellation_()) continue;
    planning_constraints_.clearance = withEndsAt(margin);
    PathQuery asked = request();
    asked.evaluations = std::max(1l, asked.evaluations / 20);
    Way way = searchPath(asked);
    if (way.points.empty()) continue;
    plan_.margin = margin;
    return way;
  }
  return {};
}

/// Clearances for a larger margin than the ends were looked at with.
Clearance Planner::withEndsAt(double margin) {
  Steering& steering = contexts_.of(0, planning_constraints_);
  Clearance larger{.margin = margin, .guard = Clearance::kGuard};
  std::vector<Endpoint> ends;
  for (const SearchEndpoint& gate : goals_)
    ends.push_back(checkEndpoint(steering, *config_.model(), gate.inside, margin, "goal", kWho));
  ends.push_back(checkEndpoint(steering, *config_.model(), start_.inside, margin, "start", kWho));
  std::vector<const Endpoint*> list;
  for (const Endpoint& end : ends) list.push_back(&end);
  larger.tight = clearanceAround(margin, list).tight;
  return larger;
}

bool Planner::failSearch(const Way& way) {
  long samples = 0;
  for (const SearchReport& attempt : way.attempts) samples += attempt.samples;
  const SearchReport last = way.attempts.empty() ? SearchReport() : way.attempts.back();
  plan_.obstacles = obstaclesMet(*config_.model(), way.hits);
  const std::string met = describeObstacles(plan_.obstacles);
  const std::string words =
      cat("no way found: ", way.evaluations, " evaluations, ", samples, " postures drawn in ", way.attempts.size(),
          " attempts; the last trees have ", last.start_nodes, " postures (start) and ", last.goal_nodes, " (goals)",
          met.empty() ? "" : cat("; most motions ended at ", met));
  if (cancelled_) return failStopped(words);
  std::vector<VectorXd> goals;
  for (const SearchEndpoint& gate : goals_) goals.push_back(gate.inside);
  const bool tight = !planning_constraints_.clearance.tight.empty();  // then the margin does not hold everywhere
  std::string proof;
  if (options_.prove_infeasibility) {
    const auto is_enough = [this] { return isCancelled() || secondsSince(began_) > kProofUntil * options_.time_limit; };
    proof = proveInfeasible(*plan_.scene, start_.inside, goals, tight ? 0. : options_.margin, is_enough);
    endStage("prove", 0, proof.empty() ? "no proof that there is none" : "");
  }
  if (!proof.empty()) return fail(PlanStatus::infeasible, cat(proof, "; ", words));
  if (way.was_stopped || cancelled_) return failStopped(words);
  return fail(PlanStatus::no_path_found, words);
}

VectorXd Planner::weight() const {
  if (options_.optimize == "length") return VectorXd::Ones(limits_.velocity.size());
  return limits_.velocity.minCoeff() * limits_.velocity.cwiseInverse();
}

void Planner::improve(const Way& first) {
  tries_ = options_.restarts;
  best_ = improvePath(first, request(),
                      {.tries = options_.restarts, .weight = weight(), .late = [this] { return isLate(); }}, contexts_);
  endStage("shorten", best_.evaluations,
           first.is_line ? "" : cat("the best of ", options_.restarts, options_.restarts == 1 ? " way" : " ways"));
  const double before = best_.cost;
  const int refinements = options_.optimize == "length" ? 2 : 0;  // each corner more takes time
  tighten(best_, request(), weight(), refinements, contexts_);
  endStage("tighten", best_.evaluations,
           best_.cost < before ? cat(lround(1000. * (1. - best_.cost / before)) / 10., " % shorter") : "");
}

/// The next round of ways.
void Planner::improveFurther() {
  drawWhereShorter();
  ImprovePathOptions options{
      .tries = kRoundTries, .first_try = tries_, .weight = weight(), .late = [this] { return isLate(); }};
  options.taut_below = kWorthPulling * best_.cost;
  options.refinements = options_.optimize == "length" ? 2 : 0;
  ShortcutResult found = improvePath(best_.way, request(), options, contexts_);
  tries_ += kRoundTries;
  further_ += std::max(found.evaluations, 1l);
  if (found.points.empty() || found.cost >= best_.cost) return;
  best_ = std::move(found);
}

/// A way from start to goal through q is not shorter than |q - start| + |q - goal|.
void Planner::drawWhereShorter() {
  const VectorXd w = weight(), start = start_.inside;
  VectorXd lower = start, upper = start;
  for (const SearchEndpoint& gate : goals_) {
    const VectorXd change = draws_.difference(start, gate.inside).cwiseProduct(w);
    const double a = .5 * best_.cost, direct = change.norm(), b2 = a * a - .25 * direct * direct;
    if (b2 < 0.) continue;
    for (Eigen::Index j = 0; j < w.size(); ++j) {
      const double along = direct > 0. ? change[j] / direct : 0.;
      const double half = std::sqrt(a * a * along * along + b2 * (1. - along * along)) / w[j];
      lower[j] = std::min(lower[j], .5 * (start[j] + gate.inside[j]) - half);
      upper[j] = std::max(upper[j], .5 * (start[j] + gate.inside[j]) + half);
    }
  }
  draws_.sampleWithin(lower, upper);
}

std::optional<MotionPlan> Planner::better() {
  if (!plan_.feasible() || best_.way.is_line) return std::nullopt;
  const bool by_length = options_.optimize == "length" || !options_.timing;
  const auto value = [&](const MotionPlan& plan) { return by_length ? plan.length : plan.duration(); };
  while (further_ < options_.improvement_evaluations && !cancellation_()) {
    const double cost = best_.cost;
    improveFurther();
    if (best_.cost >= cost) continue;
    MotionPlan before = plan_;
    std::erase_if(plan_.stages, [](const PlanStage& stage) {
      return stage.name == "improve" || stage.name == "verify" || stage.name == "time" || stage.name == "bend";
    });
    endStage("improve", further_, cat(tries_ - options_.restarts, " further ways"));
    finish();
    if (plan_.feasible() && value(plan_) < (1. - kWorthTelling) * value(before)) return plan_;
    plan_ = std::move(before);
  }
  return std::nullopt;
}

// --- the motion ----------------------------------------------------------------------------------------------------

/// The whole path, gates included, as rows.
MatrixXd Planner::rows(const std::vector<VectorXd>& points, const Way& way) const {
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
Steering& Planner::exactly() {
  PlanningConstraints exact = planning_constraints_;
  exact.clearance.guard = 0.;
  return contexts_.of(0, exact);
}

/// Is each straight motion free at all times, but for those that leave and enter contacts, which are known?
bool Planner::verify(const MatrixXd& path, const Way& way, long& evaluations) {
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
double Planner::verified_margin() const {
  double least = plan_.margin;
  for (const Clearance::Tight& tight : planning_constraints_.clearance.tight) least = std::min(least, tight.margin);
  for (const SearchEndpoint* gate : {&start_, &goals_[std::size_t(best_.way.goal)]})
    if (gate->leaves) least = std::min(least, gate->deepest);
  return least;
}

void Planner::finish() {
  long evaluations = 0;
  plan_.path = rows(best_.points, best_.way);
  const bool is_free = verify(plan_.path, best_.way, evaluations);
  if (!is_free) {
    plan_.path = rows(best_.way.points, best_.way);  // as the search had verified it
    if (!verify(plan_.path, best_.way, evaluations)) {
      plan_.path.resize(0, 0);
      fail(PlanStatus::no_path_found, "the way that was found could not be verified");
      return;
    }
  }
  plan_.raw_path = rows(best_.way.points, best_.way);
  plan_.goal = goal_numbers_[std::size_t(best_.way.goal)];
  plan_.verified_margin = verified_margin();
  plan_.length = pathLength(*plan_.space, plan_.path);
  endStage("verify", evaluations, is_free ? "" : "the way as it was found, since the shortened one was not free");
  if (options_.timing) {
    plan_.timed = timeMotion(exactly(), plan_.path, limits_, options_.blend);
    endStage("time", 0, plan_.timed.str());
  }
  if (options_.slices > 0) bend();
  plan_.status = PlanStatus::solved;
}

/// Takes what KOMO makes of the motion, if that is faster. Not where the motion leaves or enters contacts.
void Planner::bend() {
  const bool leaves = start_.leaves || goals_[std::size_t(best_.way.goal)].leaves;
  if (leaves || !plan_.timed.feasible() || !config_.model()->unit_norms.empty()) return;
  const double before = plan_.timed.duration();
  std::optional<SmoothedMotion> bent =
      smoothMotion(config_, exactly(), plan_.timed, limits_, verified_margin(), options_.slices, cancellation_);
  if (bent) {
    plan_.path = std::move(bent->path);
    plan_.timed = std::move(bent->timed);
    plan_.length = pathLength(*plan_.space, plan_.path);
  }
  endStage("bend", 0, bent ? cat(plan_.timed.duration(), " s instead of ", before, " s") : "nothing faster was found");
}

MotionPlan planFromRest(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                        const CancellationToken& cancellation) {
  Planner planner(config, options, cancellation);
  MotionPlan plan = planner.run(goal, start);
  while (std::optional<MotionPlan> better = planner.better()) plan = std::move(*better);
  return plan;
}

}  // namespace kinegraph
