#include "kinegraph/tasks/search/task_search.h"

#include <algorithm>
#include <limits>
#include <set>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/komo/sub_problem.h"
#include "kinegraph/logic/action_words.h"
#include "kinegraph/logic/fol_reader.h"
#include "kinegraph/tasks/search/check_task_plan.h"
#include "kinegraph/tasks/search/motion_checks.h"
#include "kinegraph/tasks/search/task_conflicts.h"
#include "kinegraph/tasks/task_tools.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;

constexpr int kMotionStarts = 3;   ///< sets of waypoints whose motions are tried
constexpr int kBetterStarts = 16;  ///< the same, where they have motions, and better ones are wanted
constexpr double kNone = std::numeric_limits<double>::infinity();

Clock::time_point deadlineAfter(double seconds) {
  constexpr double kLong = 1e9;  // s: more than that never ends
  if (!(seconds < kLong)) return Clock::time_point::max();
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
}

bool speaksOfFaces(const std::vector<Literal>& goal) {
  return std::ranges::any_of(goal, [](const Literal& literal) { return literal.predicate == "up"; });
}

TaskRules rulesWith(const TaskRules& own, bool upright) {
  TaskRules rules = own;
  rules.merge(defaultTaskRules(upright));
  return rules;
}

/// A scene in which what a hand holds may overlap the robot where it does so now, until it is put down.
Config withoutWedges(const Config& C) {
  const std::vector<Literal> facts = taskFacts(C);
  const FramePairs pairs = wedgedPairs(C, wordsOf(facts, "is_gripper"), wordsOf(facts, "is_object"), kOverlap);
  Config scene = C;
  ignorePairs(scene, pairs);
  return scene;
}

int requireThreads(int threads) {
  if (threads < 1) throw ValueError(cat("planTask: threads is ", threads, "; expected 1 or more"));
  return threads;
}

}  // namespace

TaskSearch::TaskSearch(const Config& C, const std::string& goal, const TaskOptions& options)
    : given_(C),
      C_(withoutWedges(C)),
      doors_(doorsOf(C)),
      options_(options),
      domain_(options.domain ? *options.domain : defaultDomain()),
      goal_text_(goal),
      goal_(readLiterals(goal, "goal")),
      limits_(taskMotionLimits(C, options.velocity, options.acceleration)),
      deadline_(deadlineAfter(options.seconds)),
      attempts_({rulesWith(options.rules, speaksOfFaces(goal_)), options.seed, requireThreads(options.threads),
                 [this] { return isLate(); }, options.between, options.helper}),
      proves_(!options.rules.contains("pick")),
      may_regrasp_(!options.domain),
      best_(kNone) {
  begin(taskFacts(C_, goal_));
  std::set<std::string> missing;
  for (int a = 0; a < int(search_->problem().actions.size()); ++a) {
    const TaskAction action = search_->problem().action(a);
    requireWords(action);
    if (!attempts_.rules().contains(action[0])) missing.insert(action[0]);
  }
  if (!missing.empty())
    throw ValueError(cat("planTask: nothing is known of what the actions ", join({missing.begin(), missing.end()}),
                         " ask; give them in `rules`"));
}

// --- in logic --------------------------------------------------------------------------------------------------------

void TaskSearch::begin(std::vector<Literal> start) {
  start_ = std::move(start);
  problem_ = {"problem", domain_, {}, domain_.start, goal_};
  problem_.start.insert(problem_.start.end(), start_.begin(), start_.end());
  PlanSearch::Options limits;
  limits.keep_going = [this] {
    try {
      if (options_.between) options_.between();
    } catch (...) {
      interruption_ = std::current_exception();
    }
    return !interruption_;
  };
  search_ = std::make_unique<PlanSearch>(ground(problem_), limits);
}

void TaskSearch::exclude() {
  for (const ImpossibleAction& proof : proofs_) forbid(proof.action, proof.facts);
}

void TaskSearch::forbid(const TaskAction& action, const std::vector<Literal>& facts) {
  const GroundProblem& ground = search_->problem();
  search_->forbid(actionNumber(ground, action), changingFacts(ground, facts));
}

void TaskSearch::forbidBeginning(const Actions& actions) {
  search_->forbidBeginning(actionNumbers(search_->problem(), actions));
}

std::vector<std::vector<Literal>> TaskSearch::states(const Actions& actions) const {
  return statesAlong(search_->problem(), actionNumbers(search_->problem(), actions));
}

std::optional<TaskSearch::Actions> TaskSearch::searchActions() {
  const auto numbers = search_->next();
  if (interruption_) std::rethrow_exception(interruption_);
  if (!numbers) return std::nullopt;
  return actionWords(search_->problem(), *numbers);
}

/// The next plan in logic. Where all fail, things may also be put down to be grasped in another way.
std::optional<TaskSearch::Actions> TaskSearch::nextActions() {
  auto actions = searchActions();
  if (actions || hasPlan() || !guessed_ || !may_regrasp_ || search_->status() == PlanSearch::Status::limit)
    return actions;
  may_regrasp_ = false;
  std::vector<Literal> start = start_;
  for (const std::string& obj : wordsOf(start_, "is_object")) start.push_back({"fresh", {obj}});
  begin(std::move(start));
  exclude();
  return searchActions();
}

bool TaskSearch::mayBeginTrial(const Actions& actions) {
  const std::string cycle = standsOnItself(states(actions));
  if (cycle.empty()) return true;
  forbidBeginning(actions);
  tree_.push_back({actions, cat("'", cycle, "' would stand on itself"), nullptr});
  return false;
}

// --- the loop --------------------------------------------------------------------------------------------------------

bool TaskSearch::hasPlan() const { return best_ < kNone; }

std::optional<TaskPlan> TaskSearch::next() {
  if (!has_begun_) {
    has_begun_ = true;
    if (!search_->problem().unreachable.empty()) {
      has_ended_ = true;
      const std::string missing = missingOfDoors();
      return end(TaskStatus::proved_impossible, missing.empty() ? join(oddities(search_->problem()), "; ") : missing);
    }
    if (proves_) {
      Actions all;
      for (int a = 0; a < int(search_->problem().actions.size()); ++a) all.push_back(search_->problem().action(a));
      proofs_ = impossibleActions(C_, all, options_.domain ? std::vector<Literal>() : start_);
    }
    exclude();
  } else if (trial_ && isSpent()) {
    has_ended_ = true;
  }
  while (!has_ended_) {
    if (!trial_) {
      const std::optional<Actions> actions = nextActions();
      if (!actions || actions->empty()) {
        has_ended_ = true;
        if (!actions) return hasPlan() ? std::nullopt : std::optional(nothing());
        TaskPlan plan = end(TaskStatus::solved, "the goal holds already");
        plan.path = C_.getJointState().transpose();
        plan.times = VectorXd::Zero(1);
        return plan;
      }
      if (mayBeginTrial(*actions)) trial_.emplace(Trial{*actions, 0, false, {}});
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
    if (has_ended_ && !hasPlan()) return end(TaskStatus::not_found, cat("no plan within the effort; ", firstCause()));
  }
  return std::nullopt;
}

// --- in geometry -----------------------------------------------------------------------------------------------------

/// A plan from the next waypoints that have one; none where there are no more.
std::optional<TaskPlan> TaskSearch::nextOf(Trial& trial) {
  while (trial.seed < (trial.found ? kBetterStarts : kMotionStarts)) {
    const int seed = trial.seed++;
    const TaskAttempts::Found found = attempts_.find(C_, trial.actions, seed);
    if (!found.waypoints) {
      if (seed == 0) known_[{trial.actions, {}}] = found.failure;
      trial.seed = kBetterStarts;
      break;
    }
    auto answer = motionsOf(*found.waypoints);
    if (TaskPlan* plan = std::get_if<TaskPlan>(&answer)) {
      tree_.push_back({trial.actions, "", nullptr});
      plan->tree = tree_;
      trial.found = true;
      return std::move(*plan);
    }
    trial.failure = std::get<TaskFailure>(answer);
    if (!trial.found && !trial.failure->doors.empty()) break;
  }
  return std::nullopt;
}

/// The motions between waypoints, checked; or why there is none.
std::variant<TaskPlan, TaskFailure> TaskSearch::motionsOf(const TaskWaypoints& waypoints) {
  struct Phase {
    SubProblem part;
    TaskMotions::Found found = {};
    long evaluations = 0;
  };
  const Actions& actions = waypoints.actions;
  std::vector<Phase> phases;
  const MatrixXd settled = withSettledDoors(C_, actions, waypoints.m->komo->getPath());
  for (int i = 0; i < int(actions.size()); ++i) {
    phases.push_back({subProblem(waypoints.m->komo->path(), i)});
    for (const TaskDoor& door : doors_) {
      if (i > 0) phases.back().part.start[door.dof] = settled(i - 1, door.dof);
      phases.back().part.end[door.dof] = settled(i, door.dof);
    }
  }
  std::optional<TaskFailure> failure;
  std::vector<TimedRows> rows;
  inOrder(
      int(phases.size()), options_.threads,
      [&](int i, const JobStopped& stopped) {
        Phase& phase = phases[std::size_t(i)];
        TaskMotions motions(limits_, start_, options_.seed, options_.threads, stopped);
        const TaskAction before = i == 0 ? TaskAction() : actions[std::size_t(i) - 1];
        const Config scene = phase.part.config;  // a thread's own
        phase.found = motions.between(scene, phase.part.start, phase.part.end, actions[std::size_t(i)], before);
        phase.evaluations = motions.evaluations;
      },
      [&](int i) {
        Phase& phase = phases[std::size_t(i)];
        attempts_.evaluations += phase.evaluations;
        if (phase.found.motion) {
          rows.push_back(std::move(*phase.found.motion));
          return true;
        }
        failure = {cat(planText({actions[std::size_t(i)]}), ": ", phase.found.why), nullptr, std::size_t(i),
                   shutBy(phase.part, actions, std::size_t(i))};
        phase.part.config.setJointState(phase.part.end);
        failure->ghost = std::make_shared<const Config>(std::move(phase.part.config));
        return false;
      },
      options_.between);
  if (failure) return *failure;
  std::vector<Config> scenes;
  for (Phase& phase : phases) scenes.push_back(std::move(phase.part.config));
  TaskPlan plan = planOf(waypoints, rows, std::move(scenes));
  plan.violations = checkTaskPlan(given_, plan, states(plan.actions));
  if (!plan.violations.empty()) return TaskFailure{plan.violations[0], nullptr};
  return plan;
}

TaskPlan TaskSearch::planOf(const TaskWaypoints& waypoints, const std::vector<TimedRows>& rows,
                            std::vector<Config> scenes) const {
  TaskPlan plan = end(TaskStatus::solved, "");
  plan.actions = waypoints.actions;
  plan.waypoints = withSettledDoors(C_, plan.actions, waypoints.m->komo->getPath());
  plan.limits = limits_;
  Eigen::Index count = 0;
  for (const TimedRows& motion : rows) count += motion.path.rows();
  plan.path.resize(count, limits_.cols());
  plan.times.resize(count);
  double begins = 0.;
  Eigen::Index row = 0;
  for (const TimedRows& motion : rows) {
    const Eigen::Index size = motion.path.rows();
    plan.path.middleRows(row, size) = motion.path;
    plan.times.segment(row, size) = motion.times.array() + begins;
    plan.segments.push_back({row, row + size});
    row += size;
    begins += motion.times[size - 1];
  }
  plan.message = cat(rows.size(), " actions, ", fixed(begins, 2),
                     " s; checked: logic, motions free to 1 mm at all times, limits, grasps, placements, support");
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    const Config scene = waypoints.m->komo->configuration(int(i));
    const std::optional<Frame> obj = scene.findFrame(objectOf(plan.actions[i]));
    if (isHold(plan.actions[i]) || isGuided(plan.actions[i])) continue;
    if (const std::optional<Frame> parent = obj ? obj->getParent() : std::nullopt)
      plan.attachments.emplace_back(parent->getName(), obj->getName());
  }
  plan.scenes = std::move(scenes);
  return plan;
}

// --- answers ---------------------------------------------------------------------------------------------------------

TaskPlan TaskSearch::end(TaskStatus status, std::string message) const {
  TaskPlan plan;
  plan.status = status;
  plan.message = std::move(message);
  plan.causes = causesByCount();
  plan.tree = tree_;
  plan.evaluations = attempts_.evaluations;
  plan.expansions = search_->expansions();
  plan.goal = goal_;
  plan.start = start_;
  plan.again = [goal = goal_text_, options = options_](const Config& C) { return planTask(C, goal, options); };
  return plan;
}

/// What a door of the goal needs, to be opened or closed, and does not have; "" if that is not the default domain's.
std::string TaskSearch::missingOfDoors() const {
  if (options_.domain) return "";
  for (const Literal& literal : goal_) {
    if ((literal.predicate != "opened" && literal.predicate != "closed") || literal.arguments.size() != 1) continue;
    const std::string& name = literal.arguments[0];
    if (!contains(start_, {"is_guided", {name}}))
      return cat("'", name,
                 "' is no door or drawer; expected a frame that is called is_door or is_drawer, with a joint ",
                 "of one dof that is active and has limits");
    const auto is_handle = [&](const Literal& fact) {
      return fact.predicate == "partOf" && fact.arguments[0] == name &&
             contains(start_, {"is_handle", {fact.arguments[1]}});
    };
    if (std::ranges::none_of(start_, is_handle)) return cat("'", name, "' has no part that is called is_handle");
  }
  return "";
}

/// There is no plan left in logic.
TaskPlan TaskSearch::nothing() {
  if (search_->status() == PlanSearch::Status::limit)
    return end(TaskStatus::not_found, "the search in logic is too large");
  if (guessed_) return end(TaskStatus::not_found, cat("all plans in logic fail; ", firstCause()));
  for (const ImpossibleAction& proof : proofs_) addCause(proof.why);
  if (proofs_.empty() || !PlanSearch(search_->problem()).next())
    return end(TaskStatus::proved_impossible, contradiction(problem_));
  return end(TaskStatus::proved_impossible, neededProofs(search_->problem(), proofs_));
}

void TaskSearch::addCause(const std::string& why) {
  const auto known = std::ranges::find(causes_, why, &std::pair<std::string, int>::first);
  if (known == causes_.end())
    causes_.emplace_back(why, 1);
  else
    ++known->second;
}

std::vector<std::pair<std::string, int>> TaskSearch::causesByCount() const {
  auto sorted = causes_;
  std::ranges::stable_sort(sorted, std::greater<>(), &std::pair<std::string, int>::second);
  return sorted;
}

std::string TaskSearch::firstCause() const {
  const auto causes = causesByCount();
  return causes.empty() ? "nothing was tried" : causes[0].first;
}

}  // namespace kinegraph
