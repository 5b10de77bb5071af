#include "kinegraph/task_planning/search/task_search.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/fol_reader.h"
#include "kinegraph/task_planning/open_hands.h"
#include "kinegraph/task_planning/search/motion_checks.h"
#include "kinegraph/task_planning/search/step_tolerance.h"
#include "kinegraph/task_planning/search/task_conflicts.h"
#include "kinegraph/task_planning/task_tools.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kSeeds = 3;         ///< sets of waypoints that are tried for the first plan of a sequence
constexpr int kBetterSeeds = 16;  ///< sets of waypoints that are tried for better plans
constexpr long kCostly = 4000;  ///< evaluations of waypoints and motions; after more, no more robust ones are searched
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

/// A scene in which held objects may overlap the robot as they do now, until they are put down.
Config withoutWedges(const Config& C) {
  const std::vector<Literal> facts = taskFacts(C);
  const FramePairs pairs = wedgedPairs(C, wordsOf(facts, "is_gripper"), wordsOf(facts, "is_object"), kOverlap);
  Config scene = C;
  ignorePairs(scene, pairs);
  return scene;
}

double requireMargin(double margin) {
  if (!(margin >= 0. && std::isfinite(margin)))
    throw ValueError(cat("planTask: margin is ", margin, " m; expected a number >= 0"));
  return margin;
}

/// The error that a plan survives, with the missing margin subtracted, m; at most that of a robust step.
double robustnessOf(const TaskPlan& plan, double margin) {
  double least = kRobust;
  for (const StepTolerance& step : plan.tolerances) least = std::min(least, step.error);
  return least + std::min(plan.margin - margin, 0.);
}

int requireThreads(int threads) {
  if (threads < 1) throw ValueError(cat("planTask: threads is ", threads, "; expected 1 or more"));
  return threads;
}

}  // namespace

TaskSearch::TaskSearch(const Config& C, const std::string& goal, const TaskOptions& options)
    : original_(std::make_shared<const Config>(withOpenings(withOpenHands(C), wordsOf(taskFacts(C), "is_gripper")))),
      C_(withoutWedges(*original_)),
      doors_(doorsOf(C)),
      options_(options),
      goal_text_(goal),
      logic_(options.domain ? *options.domain : defaultDomain(), readLiterals(goal, "goal"),
             taskFacts(C_, readLiterals(goal, "goal")), options.cancellation),
      limits_(taskMotionLimits(C, options.velocity, options.acceleration)),
      deadline_(deadlineAfter(options.time_limit)),
      settings_{rulesWith(options.rules, mentionsFaces(logic_.goal())),
                options.seed,
                requireThreads(options.threads),
                [this] { return isLate(); },
                options.helper,
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
  return nextPlan();
}

/// Excludes actions that are proved to be impossible. Returns the answer if nothing in logic reaches the goal.
std::optional<TaskPlan> TaskSearch::begin() {
  has_begun_ = true;
  if (!logic_.problem().unreachable.empty()) {
    has_ended_ = true;
    const std::string missing = missingParts();
    return answer(TaskStatus::infeasible, missing.empty() ? join(diagnostics(logic_.problem()), "; ") : missing);
  }
  if (!options_.rules.contains("pick"))  // the proofs assume the default rules
    logic_.exclude(
        impossibleActions(C_, logic_.allActions(), options_.domain ? std::vector<Literal>() : logic_.start()));
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
        plan.warnings = {"the goal already holds"};
        plan.path = C_.getJointState().transpose();
        plan.times = VectorXd::Zero(1);
        return plan;
      }
      if (!standsOnItselfIn(*actions)) trial_.emplace(Trial{*actions, logic_.statesAlong(*actions)});
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

/// The next sequence in logic. If all fail, objects may also be put down to be grasped differently.
std::optional<TaskSearch::Actions> TaskSearch::nextActions() {
  auto actions = logic_.next();
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
  const auto seeds = [&] { return trial.has_plan ? kBetterSeeds : kSeeds; };
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
      if (trial.has_plan || robustness >= kRobust || outcome.evaluations > kCostly)
        return planned(trial, std::move(*outcome.plan));
      if (!trial.best || robustness > trial.robustness) {  // other waypoints may be better
        trial.best = std::move(outcome.plan);
        trial.robustness = robustness;
      }
      continue;
    }
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
  return answer(status, cat(reason, "; ", log_.mainCause()));
}

/// Adds the record of the search so far.
TaskPlan TaskSearch::completed(TaskPlan plan) {
  plan.causes = log_.causes();
  plan.tree = log_.tree();
  plan.evaluations = evaluations();
  plan.expansions = logic_.expansions();
  plan.replanner = replannerTo(goal_text_, options_);
  return plan;
}

/// The label, joint or part that an object or door of the goal lacks; "" with a domain other than the default one.
std::string TaskSearch::missingParts() const {
  if (options_.domain) return "";
  const std::vector<Literal>& start = logic_.start();
  for (const Literal& literal : logic_.goal()) {
    if (literal.predicate == "on" && literal.arguments.size() == 2) {
      const std::string& name = literal.arguments[1];
      if (const std::optional<Frame> frame = C_.findFrame(name); frame && !contains(start, {"is_object", {name}}))
        return cat("'", name, "' is no object: it has no ",
                   frame->getJointType() == JointType::rigid ? "shape; call setShape"
                                                             : "rigid joint; call setJoint(JointType::rigid), or write "
                                                               "'joint: rigid' in its file");
    }
    if ((literal.predicate != "opened" && literal.predicate != "closed") || literal.arguments.size() != 1) continue;
    const std::string& name = literal.arguments[0];
    if (!contains(start, {"is_guided", {name}}))
      return cat("'", name, "' is no door or drawer; expected a frame labeled is_door or is_drawer, with an active ",
                 "joint of one dof with limits");
    const auto is_handle = [&](const Literal& fact) {
      return fact.predicate == "partOf" && fact.arguments[0] == name &&
             contains(start, {"is_handle", {fact.arguments[1]}});
    };
    if (std::ranges::none_of(start, is_handle)) return cat("'", name, "' has no part labeled is_handle");
  }
  if (std::ranges::none_of(start, [](const Literal& fact) { return fact.predicate == "is_gripper"; }))
    return "no frame of the scene is a gripper; the name of the frame between the fingers ends with 'gripper', or it "
           "has "
           "'logical: { is_gripper }'";
  return "";
}

TaskPlan TaskSearch::noSequenceLeft() {
  if (logic_.isCutOff())
    return answer(TaskStatus::no_plan_found, "the search in logic reached its limit of expansions");
  if (learner_.hasLearned()) return unsolved("all sequences of actions fail");
  for (const ImpossibleAction& proof : logic_.proofs()) log_.addCause(proof.cause);
  return answer(TaskStatus::infeasible, logic_.infeasibility());
}

}  // namespace kinegraph
