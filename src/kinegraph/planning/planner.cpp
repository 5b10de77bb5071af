#include "kinegraph/planning/planner.h"

#include <algorithm>

#include "kinegraph/planning/infeasibility_proof.h"
#include "kinegraph/planning/plan_goals.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/retreat_motion.h"
#include "kinegraph/planning/smooth_motion.h"

namespace kinegraph::inline planning_internal {

namespace {

constexpr int kPathsPerRound = 8;          // searched in parallel, each without the results of the others
constexpr double kWorthTightening = 1.25;  // of the best cost: longer paths are not tightened
constexpr double kProofUntil = 1.25;       // of the time limit
constexpr double kLeastGain = 1e-4;        // of the objective, by which the next motion is better
constexpr double kMargins[] = {.1, .05, .03, .02, .01, .005};  // m, tried in turn to optimize clearance

double secondsSince(std::chrono::steady_clock::time_point began) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
}

std::string noteOf(const PathSearchResult& found) {
  if (found.is_line) return "the straight motion is collision-free";
  return cat(found.searches.size(), " tree searches, ", found.points.empty() ? "no path" : "a path");
}

}  // namespace

Planner::Planner(const Config& config, const PlanOptions& options, const CancellationToken& cancellation)
    : config_(config),
      options_(options),
      limits_(planLimits(config, options)),
      contexts_(options.threads),
      user_cancellation_(cancellation),
      cancellation_([this] { return isCancelled() || isLate(); }),
      samples_(*config.model()) {
  plan_.space = std::make_shared<const JointSpace>(*config.model());
  plan_.scene = std::make_shared<const State>(config.state());
  constraints_ = constraintsAround(*plan_.scene, samples_, options, {});
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

// --- endpoints ---------------------------------------------------------------------------------------------------

/// Replaces an endpoint in slight contact by a retreat configuration.
Planner::SearchEndpoint Planner::searchEndpoint(Steering& steering, Endpoint end, const std::string& what) {
  SearchEndpoint endpoint{end, end.q};
  plan_.space->normalize(endpoint.inside);
  const bool slight = !end.near.empty() && end.near.front().distance >= -options_.max_start_penetration;
  if (end.isFree() || !slight) return endpoint;
  const std::optional<VectorXd> inside = retreatFromContact(config_, steering, end, options_.margin);
  if (!inside) return endpoint;
  plan_.warnings.push_back(
      cat("the ", what, " is in contact: ", describePairs(*config_.model(), end.near),
          what == "start" ? "; the motion begins with a retreat" : "; the motion ends with a contact"));
  endpoint.inside = *inside;
  endpoint.retreats = true;
  endpoint.deepest = end.near.front().distance - 2. * Clearance::kTolerance;
  endpoint.end = checkEndpoint(steering, *config_.model(), *inside, options_.margin, what, kPlanMotion);
  endpoint.end.q = end.q;
  return endpoint;
}

bool Planner::checkEndpoints(const MotionGoal& goal, const VectorXd& start) {
  Steering& steering = contexts_.of(0, constraints_);
  start_ = searchEndpoint(
      steering, checkEndpoint(steering, *config_.model(), start, options_.margin, "start", kPlanMotion), "start");
  if (!start_.end.isFree()) return fail(PlanStatus::invalid_start, start_.end.problem);
  GoalConfigurations configurations =
      goalConfigurations(config_, goal, start_.end.q, steering, options_, cancellation_);
  if (!configurations.was_reached)
    return cancellation_() ? failStopped(configurations.message)
                           : fail(PlanStatus::goal_unreachable, configurations.message);
  std::string problem;
  for (std::size_t i = 0; i < configurations.ends.size(); ++i) {
    SearchEndpoint endpoint = searchEndpoint(steering, configurations.ends[i], "goal");
    if (endpoint.end.isFree()) {
      goals_.push_back(endpoint);
      goal_numbers_.push_back(int(i));
    } else if (problem.empty()) {
      problem = endpoint.end.problem;
    }
  }
  endStage("endpoints", steering.evaluations(),
           cat(goals_.size(), " of ", configurations.ends.size(), " goal configurations are collision-free"));
  if (goals_.empty()) return fail(PlanStatus::invalid_goal, problem);
  if (plan_.warnings.size() > 3) plan_.warnings.resize(3);
  if (!configurations.question.empty()) plan_.warnings.push_back(configurations.question);
  for (const std::string& name : steering.manifold().sampled())
    plan_.warnings.push_back(cat("the constraint ", name, " was checked at samples ", Steering::kSpacing, " apart"));
  warnings_of_endpoints_ = plan_.warnings.size();
  return true;
}

/// The clearance to keep: the margin, and around endpoints that keep less, their own clearance.
Clearance Planner::clearance(double margin) const {
  std::vector<Endpoint> ends;
  for (const SearchEndpoint& endpoint : goals_) ends.push_back(endpoint.end), ends.back().q = endpoint.inside;
  ends.push_back(start_.end);
  ends.back().q = start_.inside;
  std::vector<const Endpoint*> list;
  for (const Endpoint& end : ends) list.push_back(&end);
  Clearance clearance = clearanceAround(margin, list);
  clearance.guard = Clearance::kGuard;
  return clearance;
}

// --- path --------------------------------------------------------------------------------------------------------

PathQuery Planner::query() {
  PathQuery query{.constraints = constraints_, .starts = {start_.inside}, .goals = {}};
  for (const SearchEndpoint& endpoint : goals_) query.goals.push_back(endpoint.inside);
  query.seed = options_.seed;
  query.max_evaluations = options_.max_evaluations;
  query.threads = options_.threads;
  query.cancellation = cancellation_;
  query.steering = &contexts_.of(0, constraints_);
  return query;
}

bool Planner::findPath() {
  PathSearchResult found;
  if (options_.optimize == "clearance") found = searchWithClearance();
  if (found.points.empty()) {
    constraints_.clearance = clearance(options_.margin);
    found = searchPath(query());
  }
  plan_.searches = found.searches;
  plan_.trees = found.trees;
  endStage("search", found.evaluations, noteOf(found));
  if (found.points.empty()) return failSearch(found);
  improve(found);
  return true;
}

/// Searches with the largest margin for which a path is found with a small budget.
PathSearchResult Planner::searchWithClearance() {
  for (const double margin : kMargins) {
    if (margin <= options_.margin || cancellation_()) continue;
    constraints_.clearance = clearanceOfEndpoints(margin);
    PathQuery asked = query();
    asked.max_evaluations = std::max(1l, asked.max_evaluations / 20);
    PathSearchResult found = searchPath(asked);
    if (found.points.empty()) continue;
    plan_.margin = margin;
    return found;
  }
  return {};
}

/// The clearance to keep for a larger margin than the one of the endpoint checks.
Clearance Planner::clearanceOfEndpoints(double margin) {
  Steering& steering = contexts_.of(0, constraints_);
  Clearance larger{.margin = margin, .guard = Clearance::kGuard};
  std::vector<Endpoint> ends;
  for (const SearchEndpoint& endpoint : goals_)
    ends.push_back(checkEndpoint(steering, *config_.model(), endpoint.inside, margin, "goal", kPlanMotion));
  ends.push_back(checkEndpoint(steering, *config_.model(), start_.inside, margin, "start", kPlanMotion));
  std::vector<const Endpoint*> list;
  for (const Endpoint& end : ends) list.push_back(&end);
  larger.tight = clearanceAround(margin, list).tight;
  return larger;
}

bool Planner::failSearch(const PathSearchResult& found) {
  long samples = 0;
  for (const SearchReport& search : found.searches) samples += search.samples;
  const SearchReport last = found.searches.empty() ? SearchReport() : found.searches.back();
  plan_.obstacles = obstaclesMet(*config_.model(), found.hits);
  const std::string met = describeObstacles(plan_.obstacles);
  if (goals_.size() == 1) warnOfMargins(goals_.front());
  const std::string description =
      cat("no path found: ", found.evaluations, " evaluations, ", samples, " samples in ", found.searches.size(),
          " tree searches; the last trees have ", last.start_nodes, " nodes (start) and ", last.goal_nodes, " (goals)",
          met.empty() ? "" : cat("; most edges collided with ", met));
  if (cancelled_) return failStopped(description);
  std::vector<VectorXd> goals;
  for (const SearchEndpoint& endpoint : goals_) goals.push_back(endpoint.inside);
  const bool is_tight = !constraints_.clearance.tight.empty();  // the margin does not hold everywhere
  std::string proof;
  if (options_.prove_infeasibility) {
    const auto is_enough = [this] { return isCancelled() || secondsSince(began_) > kProofUntil * options_.time_limit; };
    proof = proveInfeasible(*plan_.scene, start_.inside, goals, is_tight ? 0. : options_.margin, is_enough);
    endStage("infeasibility_proof", 0, proof.empty() ? "no proof found" : "");
  }
  if (!proof.empty()) return fail(PlanStatus::infeasible, cat(proof, "; ", description));
  if (found.was_stopped || cancelled_) return failStopped(description);
  return fail(PlanStatus::no_path_found, description);
}

VectorXd Planner::weight() const {
  if (options_.optimize == "length") return VectorXd::Ones(limits_.velocity.size());
  return limits_.velocity.minCoeff() * limits_.velocity.cwiseInverse();
}

void Planner::improve(const PathSearchResult& first) {
  paths_ = options_.restarts;
  best_ = improvePath(first, query(),
                      {.paths = options_.restarts, .weight = weight(), .late = [this] { return isLate(); }}, contexts_);
  endStage("shortcut", best_.evaluations,
           first.is_line ? "" : cat("the best of ", options_.restarts, options_.restarts == 1 ? " path" : " paths"));
  const double before = best_.cost;
  const int refinements = options_.optimize == "length" ? 2 : 0;  // every additional corner takes time
  tighten(best_, query(), weight(), refinements, contexts_);
  endStage("rope_shortcut", best_.evaluations,
           best_.cost < before ? cat(lround(1000. * (1. - best_.cost / before)) / 10., " % shorter") : "");
}

/// Runs the next round of searches.
void Planner::improveFurther() {
  restrictSamples();
  ImprovePathOptions options{
      .paths = kPathsPerRound, .first_number = paths_, .weight = weight(), .late = [this] { return isLate(); }};
  options.tighten_below = kWorthTightening * best_.cost;
  options.refinements = options_.optimize == "length" ? 2 : 0;
  ShortcutResult found = improvePath(best_.found, query(), options, contexts_);
  paths_ += kPathsPerRound;
  further_ += std::max(found.evaluations, 1l);
  if (found.points.empty() || found.cost >= best_.cost) return;
  best_ = std::move(found);
}

/// Restricts samples to where a shorter path can pass: a path through q is at least |q - start| + |q - goal| long.
void Planner::restrictSamples() {
  const VectorXd w = weight(), start = start_.inside;
  VectorXd lower = start, upper = start;
  for (const SearchEndpoint& endpoint : goals_) {
    const VectorXd change = samples_.difference(start, endpoint.inside).cwiseProduct(w);
    const double a = .5 * best_.cost, direct = change.norm(), b2 = a * a - .25 * direct * direct;
    if (b2 < 0.) continue;
    for (Eigen::Index j = 0; j < w.size(); ++j) {
      const double along = direct > 0. ? change[j] / direct : 0.;
      const double half = std::sqrt(a * a * along * along + b2 * (1. - along * along)) / w[j];
      lower[j] = std::min(lower[j], .5 * (start[j] + endpoint.inside[j]) - half);
      upper[j] = std::max(upper[j], .5 * (start[j] + endpoint.inside[j]) + half);
    }
  }
  samples_.sampleWithin(lower, upper);
}

std::optional<MotionPlan> Planner::better() {
  if (!plan_.feasible() || best_.found.is_line) return std::nullopt;
  const bool by_length = options_.optimize == "length" || !options_.timing;
  const auto value = [&](const MotionPlan& plan) { return by_length ? plan.length : plan.duration(); };
  while (further_ < options_.improvement_evaluations && !cancellation_()) {
    const double cost = best_.cost;
    improveFurther();
    if (best_.cost >= cost) continue;
    MotionPlan before = plan_;
    std::erase_if(plan_.stages, [](const PlanStage& stage) {
      return stage.name == "improvement" || stage.name == "verify" || stage.name == "timing" ||
             stage.name == "smoothing";
    });
    endStage("improvement", further_, cat(paths_ - options_.restarts, " further paths"));
    finish();
    if (plan_.feasible() && value(plan_) < (1. - kLeastGain) * value(before)) return plan_;
    plan_ = std::move(before);
  }
  return std::nullopt;
}

// --- motion ------------------------------------------------------------------------------------------------------

/// The waypoints of the whole path, retreat motions included.
MatrixXd Planner::waypoints(const std::vector<VectorXd>& points, const PathSearchResult& found) const {
  std::vector<VectorXd> all = points;
  if (start_.retreats) {
    all.insert(all.begin(), start_.end.q);
  } else {
    all.front() = start_.end.q;  // an endless joint keeps its number of rotations
  }
  if (goals_[std::size_t(found.goal)].retreats) all.push_back(goals_[std::size_t(found.goal)].end.q);
  return plan_.space->unroll(all);
}

/// Steering that keeps the margins without a guard.
Steering& Planner::withoutGuard() {
  PlanningConstraints exact = constraints_;
  exact.clearance.guard = 0.;
  return contexts_.of(0, exact);
}

/// Verifies every edge continuously, except the retreat motions, which retreatFromContact verified.
bool Planner::verify(const MatrixXd& path, const PathSearchResult& found, long& evaluations) {
  Steering& steering = withoutGuard();
  const long before = steering.evaluations();
  const Eigen::Index first = start_.retreats ? 2 : 1,
                     last = path.rows() - 1 - (goals_[std::size_t(found.goal)].retreats ? 1 : 0);
  bool is_free = true;
  for (Eigen::Index k = first; k <= last && is_free; ++k)
    is_free = steering.isFree(path.row(k - 1).transpose(), path.row(k).transpose());
  evaluations += steering.evaluations() - before;
  return is_free;
}

/// The margin of the whole path: the margin, the least one around endpoints, or the distance of a pair in contact.
double Planner::verifiedMargin() const {
  double least = plan_.margin;
  for (const Clearance::Tight& tight : constraints_.clearance.tight) least = std::min(least, tight.margin);
  for (const SearchEndpoint* endpoint : {&start_, &goals_[std::size_t(best_.found.goal)]})
    if (endpoint->retreats) least = std::min(least, endpoint->deepest);
  return least;
}

/// Warns of ends that keep less than the margin; warnings of ends in contact say more.
void Planner::warnOfMargins(const SearchEndpoint& goal) {
  plan_.warnings.resize(warnings_of_endpoints_);
  for (const auto& [endpoint, what] : {std::pair(&std::as_const(start_), "start"), std::pair(&goal, "goal")}) {
    const std::string warning = marginWarning(*config_.model(), endpoint->end, options_.margin, what);
    if (!endpoint->retreats && !warning.empty()) plan_.warnings.push_back(warning);
  }
}

void Planner::finish() {
  long evaluations = 0;
  plan_.path = waypoints(best_.points, best_.found);
  const bool is_free = verify(plan_.path, best_.found, evaluations);
  if (!is_free) {
    plan_.path = waypoints(best_.found.points, best_.found);  // as verified by the search
    if (!verify(plan_.path, best_.found, evaluations)) {
      plan_.path.resize(0, 0);
      fail(PlanStatus::no_path_found, "the path that was found could not be verified");
      return;
    }
  }
  plan_.raw_path = waypoints(best_.found.points, best_.found);
  plan_.goal = goal_numbers_[std::size_t(best_.found.goal)];
  plan_.verified_margin = verifiedMargin();
  warnOfMargins(goals_[std::size_t(best_.found.goal)]);
  plan_.length = pathLength(*plan_.space, plan_.path);
  endStage("verify", evaluations, is_free ? "" : "the raw path, since the shortened one is not collision-free");
  if (options_.timing) {
    plan_.timed_path = timeMotion(withoutGuard(), plan_.path, limits_, options_.blend);
    endStage("timing", 0, plan_.timed_path.str());
  }
  if (options_.slices > 0) smooth();
  plan_.status = PlanStatus::solved;
}

/// Smooths the motion by KOMO, and takes the result if it is faster. Motions with retreats stay.
void Planner::smooth() {
  const bool retreats = start_.retreats || goals_[std::size_t(best_.found.goal)].retreats;
  if (retreats || !plan_.timed_path.feasible() || !config_.model()->unit_norms.empty()) return;
  const double before = plan_.timed_path.duration();
  std::optional<SmoothedMotion> smoothed = smoothMotion(config_, withoutGuard(), plan_.timed_path, limits_,
                                                        verifiedMargin(), options_.slices, cancellation_);
  if (smoothed) {
    plan_.path = std::move(smoothed->path);
    plan_.timed_path = std::move(smoothed->timed_path);
    plan_.length = pathLength(*plan_.space, plan_.path);
  }
  endStage("smoothing", 0,
           smoothed ? cat(plan_.timed_path.duration(), " s instead of ", before, " s") : "no faster motion was found");
}

MotionPlan planFromRest(const Config& config, const MotionGoal& goal, const PlanOptions& options, const VectorXd& start,
                        const CancellationToken& cancellation) {
  Planner planner(config, options, cancellation);
  MotionPlan plan = planner.run(goal, start);
  while (std::optional<MotionPlan> better = planner.better()) plan = std::move(*better);
  return plan;
}

}  // namespace kinegraph::inline planning_internal
