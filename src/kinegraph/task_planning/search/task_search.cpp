#include "kinegraph/task_planning/search/task_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/task_planning/grasps.h"
#include "kinegraph/task_planning/gripper_frames.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/motions/start_contacts.h"
#include "kinegraph/task_planning/open_hands.h"
#include "kinegraph/task_planning/search/crowded_hands.h"
#include "kinegraph/task_planning/search/goal_flaw.h"
#include "kinegraph/task_planning/search/poor_placements.h"
#include "kinegraph/task_planning/search/step_tolerance.h"
#include "kinegraph/task_planning/search/task_conflicts.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph::inline task_planning_internal {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSeeds = 3;           ///< sets of waypoints that are tried for the first plan of a sequence
constexpr int kRobustSeeds = 10;    ///< the same if it has a plan that is not robust
constexpr int kBetterSeeds = 16;    ///< sets of waypoints that are tried for better plans
constexpr int kWithoutPoor = 8;     ///< sequences without poor placements that are tried before others
constexpr long kForRobust = 60000;  ///< evaluations; after more, no plan is searched that is more robust
constexpr double kPoor = 1e-3;      ///< m: a plan that survives less is no plan for the world
constexpr long kForPoor = 180000;   ///< the evaluations for such a plan
constexpr double kNoPlan = std::numeric_limits<double>::infinity();

Clock::time_point deadlineAfter(double seconds) {
  constexpr double kLong = 1e9;  // s; longer limits count as none
  if (!(seconds < kLong)) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool mentionsFaces(const std::vector<Literal>& goal) {
  return std::ranges::any_of(goal, [](const Literal& literal) { return literal.predicate == "up"; });
}

TaskRules rulesWith(const TaskRules& own, bool upright) {
  TaskRules rules = own;
  rules.merge(defaultTaskRules(upright));
  return rules;
}

double requireMargin(double margin) {
  if (!(margin >= 0. && std::isfinite(margin)))
    throw ValueError(cat("planTask: margin is ", margin, " m; expected a number >= 0"));
  return margin;
}

double requireContactSpeed(double speed) {
  if (speed > 0.) return speed;
  throw ValueError(cat("planTask: contact_speed is ", speed, " m/s; expected a number > 0, or infinity"));
}

/// The error that a plan survives, m; at most that of a robust step.
double leastTolerance(const TaskPlan& plan) {
  double least = kRobust;
  for (const StepTolerance& step : plan.tolerances) least = std::min(least, step.error);
  return least;
}

/// The same, with the missing margin subtracted.
double robustnessOf(const TaskPlan& plan, double margin) {
  return leastTolerance(plan) + std::min(plan.margin - margin, 0.);
}

/// The scene with open hands. `most`: the opening of hands that open wider, m.
Config sceneOf(const Config& C, double most) {
  const std::vector<std::string> hands = wordsOf(taskFacts(C), "is_gripper");
  Config scene = withOpenings(withOpenHands(C, most), hands);
  for (const std::string& hand : hands)
    if (opening(scene, hand).value_or(0.) > most)
      scene.getFrame(hand).editAttributes().set({"opening", {}, {}, {most, {}}, {}});
  return scene;
}

int requireThreads(int threads) {
  if (threads < 1) throw ValueError(cat("planTask: threads is ", threads, "; expected 1 or more"));
  return threads;
}

std::vector<Literal> goalOf(const std::string& text) {
  std::vector<Literal> goal = readLiterals(text, "goal");
  if (goal.empty()) throw ValueError("planTask: the goal is empty; expected literals such as (on tray cup)");
  return goal;
}

/// Returns sentences about objects of a plan that no motion keeps away from others.
std::vector<std::string> ghostsOf(const Config& C, const TaskPlan& plan) {
  std::vector<std::string> warnings;
  for (const std::string& name : wordsOf(plan.start, "is_object")) {
    const auto names = [&](const std::vector<std::string>& action) { return std::ranges::count(action, name) > 0; };
    const std::vector<Frame> shapes = heldShapes(C.getFrame(name));
    if (shapes.empty() || std::ranges::none_of(plan.actions, names)) continue;
    if (std::ranges::none_of(shapes, [](const Frame& shape) { return shape.data().shape->contact != 0; }))
      warnings.push_back(cat("'", name,
                             "' does not collide, because its contact is 0: it may pass through others; call ",
                             "setContact(1)"));
  }
  return warnings;
}

double requireTimeLimit(double seconds) {
  if (seconds >= 0.) return seconds;
  throw ValueError(cat("planTask: time_limit is ", seconds, " s; expected a number >= 0, or infinity"));
}

}  // namespace

TaskSearch::TaskSearch(const Config& C, const std::string& goal, const TaskOptions& options, double opening)
    : opening_(opening),
      original_(std::make_shared<const Config>(sceneOf(C, opening))),
      C_(withoutGivenContacts(*original_, requireMargin(options.margin))),
      doors_(doorsOf(C)),
      options_(options),
      goal_text_(goal),
      flaws_(gripperFrameFlaws(C, wordsOf(taskFacts(C), "is_gripper"))),
      logic_(options.domain ? *options.domain : defaultDomain(), goalOf(goal), taskFacts(C_, goalOf(goal)),
             options.cancellation),
      limits_(taskMotionLimits(C, options.velocity, options.acceleration)),
      deadline_(deadlineAfter(requireTimeLimit(options.time_limit))),
      settings_{rulesWith(options.rules, mentionsFaces(logic_.goal())),
                options.seed,
                requireThreads(options.threads),
                [this] { return isLate(); },
                options.helper,
                requireContactSpeed(options.contact_speed),
                requireMargin(options.margin)},
      may_regrasp_(!options.domain),
      best_(kNoPlan),
      scene_(std::make_shared<const Config>(C_)),
      executor_(options.threads, options.cancellation),
      waypoints_(executor_, settings_, scene_, doors_),
      learner_(executor_, C_, doors_, logic_, waypoints_, log_) {
  makeEvaluator();
  std::set<std::string> missing;
  for (const TaskAction& action : logic_.allActions()) {
    requireWords(action);
    if (!settings_.rules.contains(action[0])) missing.insert(action[0]);
  }
  if (!missing.empty())
    throw ValueError(cat("planTask: no TaskRule for the actions ", join({missing.begin(), missing.end()}),
                         "; pass rules={name: TaskRule}"));
}

void TaskSearch::makeEvaluator() {
  evaluator_ = std::make_shared<const SequenceEvaluator>(executor_, settings_, scene_, original_, limits_,
                                                         logic_.goal(), logic_.start());
}

bool TaskSearch::hasPlan() const { return best_ < kNoPlan; }

std::optional<TaskPlan> TaskSearch::next() {
  struct Rest {  // threads work only while the caller waits
    TaskSearch& search;
    ~Rest() {
      search.executor_.cancelAll();
      search.waypoints_.dropPrefetched();
    }
  };
  executor_.cancelAll();
  const Rest rest{*this};
  if (narrower_) {
    const auto before = narrower_->evaluations();
    std::optional<TaskPlan> plan = narrower_->next();
    evaluations_ += narrower_->evaluations() - before;
    return plan ? std::optional(ofNarrowerHands(std::move(*plan))) : std::nullopt;
  }
  const bool is_first = !hasPlan();
  std::optional<TaskPlan> plan = nextPlan();
  std::optional<TaskPlan> other = plan && is_first ? withNarrowerHands(*plan) : std::nullopt;
  if (!other && plan) plan->evaluations = evaluations();
  return other ? std::move(other) : std::move(plan);
}

/// Openings of hands for which there may be more room than in a plan with wide ones.
std::vector<double> TaskSearch::narrowerThan(const TaskPlan& wide) const {
  if (std::isfinite(opening_)) return {};
  std::set<std::string> objects;
  if (wide.feasible() && isCrowded(*original_, wide)) {
    for (const TaskAction& action : wide.actions)
      if (isPick(action)) objects.insert(objectOf(action));
  } else if (wide.status == TaskStatus::no_plan_found && isInTheWay(*original_, wide)) {
    for (const Literal& literal : logic_.goal()) objects.insert(literal.arguments.begin(), literal.arguments.end());
  }
  if (objects.empty()) return {};
  return narrowerOpenings(*original_, objects);
}

/// The plan with hands that open less, if fully open ones have no room at objects, or less than the margin.
std::optional<TaskPlan> TaskSearch::withNarrowerHands(const TaskPlan& wide) {
  std::optional<TaskPlan> best;
  double most = wide.feasible() ? robustnessOf(wide, options_.margin) : -kNoPlan;
  for (const double opening : narrowerThan(wide)) {
    TaskOptions rest = options_;
    rest.max_evaluations -= evaluations();
    if (wide.feasible()) rest.max_evaluations = std::min(rest.max_evaluations, kForRobust);
    if (deadline_ != Clock::time_point::max())
      rest.time_limit = std::chrono::duration<double>(deadline_ - Clock::now()).count();
    if (rest.max_evaluations <= 0 || !(rest.time_limit > 0.)) break;
    auto search = std::make_unique<TaskSearch>(*original_, goal_text_, rest, opening);
    std::optional<TaskPlan> plan = search->next();
    evaluations_ += search->evaluations();
    if (!plan || !plan->feasible() || !(robustnessOf(*plan, options_.margin) > most)) continue;
    most = robustnessOf(*plan, options_.margin);
    narrower_ = std::move(search);
    best = std::move(plan);
    if (!wide.feasible() || most >= kRobust) break;
  }
  if (!best) return std::nullopt;
  narrower_->options_.max_evaluations = options_.max_evaluations - evaluations() + narrower_->evaluations();
  return ofNarrowerHands(std::move(*best));
}

/// A plan of the search with hands that open less, as one of this search.
TaskPlan TaskSearch::ofNarrowerHands(TaskPlan plan) const {
  plan.evaluations = evaluations();
  if (!plan.feasible()) return plan;
  plan.replanner = replannerTo(goal_text_, options_);
  plan.warnings.push_back(cat("hands open to ", fixed(1e3 * narrower_->opening_, 0),
                              " mm only: wider ones have less than the margin, or no room, beside the objects"));
  return plan;
}

/// Excludes actions that are proved to be impossible. Returns the answer if nothing in logic reaches the goal.
std::optional<TaskPlan> TaskSearch::begin() {
  has_begun_ = true;
  if (!logic_.problem().unreachable.empty()) {
    has_ended_ = true;
    return answer(TaskStatus::infeasible,
                  options_.domain ? join(diagnostics(logic_.problem()), "; ") : goalFlaw(C_, logic_.problem()));
  }
  if (std::string contact = startContact(C_, wordsOf(logic_.start(), "is_gripper")); !contact.empty()) {
    has_ended_ = true;
    return answer(TaskStatus::infeasible, std::move(contact));
  }
  if (!options_.rules.contains("pick"))  // the proofs assume the default rules
    logic_.exclude(
        impossibleActions(C_, logic_.allActions(), options_.domain ? std::vector<Literal>() : logic_.start()));
  if (!options_.domain && options_.rules.empty()) {
    for (const ImpossibleAction& poor : poorPlacements(C_, logic_.allActions(), logic_.start(), logic_.goal())) {
      logic_.forbid(poor.action, poor.facts);
      avoids_poor_ = true;
    }
  }
  return std::nullopt;
}

std::optional<TaskPlan> TaskSearch::nextPlan() {
  if (!has_begun_) {
    if (std::optional<TaskPlan> plan = begin()) return plan;
  } else if (trial_ && isSpent()) {
    has_ended_ = true;
  }
  while (!has_ended_) {
    if (!trial_) {
      const std::optional<Actions> actions = nextActions();
      if (!actions || actions->empty()) {
        has_ended_ = true;
        if (!actions) return hasPlan() ? std::nullopt : std::optional(noSequenceLeft());
        TaskPlan plan = answer(TaskStatus::solved, "");
        plan.warnings.emplace_back("the goal already holds");
        plan.path = C_.getJointState().transpose();
        plan.times = VectorXd::Zero(1);
        return plan;
      }
      if (!standsOnItselfIn(*actions) && !learner_.learnHandThatFails(*actions))
        trial_.emplace(Trial{*actions, logic_.statesAlong(*actions)});
    }
    while (trial_ && !has_ended_) {
      std::optional<TaskPlan> plan = nextOf(*trial_);
      if (!plan) {
        conclude(*trial_);
        trial_.reset();
      } else if (plan->duration() < best_) {
        best_ = plan->duration();
        return plan;
      } else if (isSpent()) {
        has_ended_ = true;
      }
    }
    has_ended_ = has_ended_ || isSpent();
    if (has_ended_ && !hasPlan())
      return unsolved(isLate() ? "no plan within time_limit" : "no plan within max_evaluations");
  }
  return std::nullopt;
}

/// The next sequence in logic. If those without poor placements fail, all are tried; if all fail, objects may also be
/// put down to be grasped differently.
std::optional<TaskSearch::Actions> TaskSearch::nextActions() {
  auto actions = avoids_poor_ && tried_ == kWithoutPoor ? std::nullopt : logic_.next();
  ++tried_;
  if (!actions && !hasPlan() && avoids_poor_) {
    avoids_poor_ = false;
    logic_.startOver();
    actions = logic_.next();
  }
  if (actions || hasPlan() || !learner_.hasLearned() || !may_regrasp_ || logic_.isCutOff()) return actions;
  may_regrasp_ = false;
  logic_.allowRegrasps();
  makeEvaluator();
  return logic_.next();
}

bool TaskSearch::standsOnItselfIn(const Actions& actions) {
  const std::string cycle = standsOnItself(logic_.statesAlong(actions));
  if (cycle.empty()) return false;
  logic_.forbidPrefix(actions);
  log_.addDropped(actions, cat("'", cycle, "' would stand on itself"));
  return true;
}

/// Evaluates a sequence with the waypoints of one seed, ahead of time if a thread is free.
Speculative<TaskSearch::Outcome> TaskSearch::outcomeOf(const Trial& trial, int seed, Priority priority) {
  SequenceEvaluator::Request request{trial.actions, trial.states, seed, priority};
  if (seed == 0)
    request.at_first_failure = [this, prefixes = waypoints_.unknownPrefixes(trial.actions)] {
      waypoints_.prefetch(prefixes, Priority::low);
    };
  return executor_.defer<Outcome>(
      [evaluator = evaluator_, request = std::move(request)](const CancellationToken& stopped) {
        return evaluator->evaluate(request, stopped);
      });
}

/// The plan of the next seed that has one; none if no seed is left.
std::optional<TaskPlan> TaskSearch::nextOf(Trial& trial) {
  auto& outcomes = trial.outcomes;
  const auto seeds = [&] { return trial.has_plan ? kBetterSeeds : trial.best ? kRobustSeeds : kSeeds; };
  while (trial.seed < seeds()) {
    const int seed = trial.seed++;
    if (seed == 0 && waypoints_.isKnownToFail(trial.actions)) break;
    if (!outcomes.contains(seed)) outcomes[seed] = outcomeOf(trial, seed, Priority::high);
    const int ahead = trial.has_plan || needs_seeds_ ? options_.threads - 1 : 0;
    for (int next = seed + 1; next <= std::min(seed + ahead, seeds() - 1); ++next) {
      if (outcomes.contains(next)) continue;
      outcomes[next] = outcomeOf(trial, next, Priority::low);
      outcomes[next].begin(Priority::low);
    }
    Outcome& outcome = outcomes[seed].get();
    evaluations_ += outcome.evaluations;
    trial.evaluations += outcome.evaluations;
    if (outcome.waypoint_failure) {
      if (trial.best) continue;
      trial.feasible_actions = outcome.feasible_actions;
      trial.waypoint_failure = outcome.waypoint_failure;
      if (seed == 0) waypoints_.setFailure(trial.actions, outcome.waypoint_failure);
      trial.seed = kBetterSeeds;  // also after a plan
      break;
    }
    if (outcome.plan) {
      const double robustness = robustnessOf(*outcome.plan, options_.margin);
      if (trial.has_plan || robustness >= kRobust) return planned(trial, std::move(*outcome.plan));
      if (!trial.best || robustness > trial.robustness) {  // other waypoints may be better
        trial.best = std::move(outcome.plan);
        trial.robustness = robustness;
      }
    }
    if ((trial.best || trial.has_plan) && isSpent()) break;
    if (trial.best && trial.evaluations > (leastTolerance(*trial.best) < kPoor ? kForPoor : kForRobust)) break;
    if (trial.best && !hasPlan() && trial.seed >= kSeeds && !narrowerThan(*trial.best).empty())
      break;  // hands that open less are better than more waypoints
    if (trial.best) continue;
    needs_seeds_ = true;
    trial.motion_failure = outcome.motion_failure;
    if (!trial.has_plan && !trial.motion_failure->doors.empty()) break;
  }
  if (trial.best) return planned(trial, *std::exchange(trial.best, std::nullopt));
  return std::nullopt;
}

TaskPlan TaskSearch::planned(Trial& trial, TaskPlan plan) {
  log_.addPlan(trial.actions);
  trial.has_plan = true;
  return completed(std::move(plan));
}

/// Forbids the sequence, or the part of it that fails.
void TaskSearch::conclude(const Trial& trial) {
  if (trial.has_plan) return logic_.forbidPrefix(trial.actions);
  if (trial.motion_failure) return learner_.learnMotionFailure(trial.actions, *trial.motion_failure);
  if (trial.feasible_actions > 0)
    learner_.learnWaypointFailure(trial.actions, trial.feasible_actions, trial.waypoint_failure);
  else
    learner_.learnWaypointFailure(trial.actions);
}

// --- answers ---------------------------------------------------------------------------------------------------------

TaskPlan TaskSearch::answer(TaskStatus status, std::string message) {
  TaskPlan plan;
  plan.status = status;
  plan.message = std::move(message);
  plan.goal = logic_.goal();
  plan.start = logic_.start();
  return completed(std::move(plan));
}

/// An answer that proves nothing.
TaskPlan TaskSearch::unsolved(const std::string& reason) {
  const TaskStatus status = isLate() ? TaskStatus::timeout : TaskStatus::no_plan_found;
  const std::string cause = log_.mainCause();
  std::vector<std::string> parts = {reason, cause};
  for (const ImpossibleAction& proof : logic_.proofs()) {  // obstacles that cannot be moved
    const bool is_in_way = cause.starts_with("while ") && isPick(proof.action) &&
                           cause.substr(0, cause.find(':')).ends_with(cat(" ", objectOf(proof.action), ")"));
    if (is_in_way && std::ranges::find(parts, proof.cause) == parts.end()) parts.push_back(proof.cause);
  }
  return answer(status, join(parts, "; "));
}

/// Adds the record of the search so far, and what is wrong with objects and with the frames of the hands.
TaskPlan TaskSearch::completed(TaskPlan plan) {
  const std::vector<std::string> ghosts = ghostsOf(*original_, plan);
  plan.warnings.insert(plan.warnings.begin(), ghosts.begin(), ghosts.end());
  plan.warnings.insert(plan.warnings.begin(), flaws_.begin(), flaws_.end());
  if (!plan.feasible())
    for (const std::string& flaw : flaws_) plan.message += cat(plan.message.empty() ? "" : "; ", flaw);
  plan.causes = log_.causes();
  plan.tree = log_.tree();
  plan.evaluations = evaluations();
  plan.expansions = logic_.expansions();
  plan.replanner = replannerTo(goal_text_, options_);
  return plan;
}

TaskPlan TaskSearch::noSequenceLeft() {
  if (logic_.isCutOff())
    return answer(TaskStatus::no_plan_found, "the search in logic reached its limit of expansions");
  if (learner_.hasLearned()) return unsolved("all sequences of actions fail");
  for (const ImpossibleAction& proof : logic_.proofs()) log_.addCause(proof.cause);
  return answer(TaskStatus::infeasible, logic_.infeasibility());
}

}  // namespace kinegraph::inline task_planning_internal
