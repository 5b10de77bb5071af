#include "kinegraph/task_planning/search/task_search.h"

#include <algorithm>
#include <limits>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/action_words.h"
#include "kinegraph/logic/fol_reader.h"
#include "kinegraph/task_planning/search/motion_checks.h"
#include "kinegraph/task_planning/search/task_conflicts.h"
#include "kinegraph/task_planning/task_tools.h"

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
    : given_(std::make_shared<const Config>(C)),
      C_(withoutWedges(C)),
      doors_(doorsOf(C)),
      options_(options),
      domain_(options.domain ? *options.domain : defaultDomain()),
      goal_text_(goal),
      goal_(readLiterals(goal, "goal")),
      limits_(taskMotionLimits(C, options.velocity, options.acceleration)),
      deadline_(deadlineAfter(options.seconds)),
      settings_{rulesWith(options.rules, speaksOfFaces(goal_)), options.seed, requireThreads(options.threads),
                [this] { return isLate(); }, options.helper},
      proves_(!options.rules.contains("pick")),
      may_regrasp_(!options.domain),
      best_(kNone),
      scene_(std::make_shared<const Config>(C_)),
      ahead_(options.threads, options.cancellation) {
  begin(taskFacts(C_, goal_));
  std::set<std::string> missing;
  for (int a = 0; a < int(search_->problem().actions.size()); ++a) {
    const TaskAction action = search_->problem().action(a);
    requireWords(action);
    if (!settings_.rules.contains(action[0])) missing.insert(action[0]);
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
  trials_ = std::make_shared<const TaskTrials>(ahead_, settings_, scene_, given_, limits_, goal_, start_);
  PlanSearch::Options limits;
  limits.cancellation = [this] {
    try {
      options_.cancellation.check();
    } catch (...) {
      interruption_ = std::current_exception();
    }
    return bool(interruption_);
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
  branches_.push_back({actions, cat("'", cycle, "' would stand on itself"), nullptr});
  return false;
}

// --- the loop --------------------------------------------------------------------------------------------------------

bool TaskSearch::hasPlan() const { return best_ < kNone; }

std::optional<TaskPlan> TaskSearch::next() {
  struct Rest {  // nobody works while nobody waits
    TaskSearch& search;
    ~Rest() {
      search.ahead_.cancelAll();
      search.expectNothing();
    }
  };
  ahead_.cancelAll();
  const Rest rest{*this};
  return nextPlan();
}

std::optional<TaskPlan> TaskSearch::nextPlan() {
  if (!has_begun_) {
    has_begun_ = true;
    if (!search_->problem().unreachable.empty()) {
      has_ended_ = true;
      const std::string missing = missingOfDoors();
      return end(TaskStatus::infeasible, missing.empty() ? join(diagnostics(search_->problem()), "; ") : missing);
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
      if (mayBeginTrial(*actions)) trial_.emplace(Trial{*actions, states(*actions)});
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

// --- waypoints -------------------------------------------------------------------------------------------------------

std::shared_ptr<const Config> TaskSearch::sceneIn(const Circumstances& there) const {
  if (there == Circumstances()) return scene_;
  auto scene = std::make_shared<Config>(*scene_);
  for (const std::string& name : there.without) scene->getFrame(name).setContact(0);
  VectorXd q = scene->getJointState();  // which compiles it, for all copies
  if (there.doors.empty()) return scene;
  for (std::size_t i = 0; i < doors_.size(); ++i) q[doors_[i].dof] = there.doors[i];
  scene->setJointState(q);
  return scene;
}

/// Waypoints that may be asked for are looked for, where there are threads for that. Any thread may expect some.
void TaskSearch::expect(const Actions& actions, const Circumstances& there, Priority first) {
  if (options_.threads == 1) return;
  const std::scoped_lock lock(expecting_);
  auto known = expected_.find({actions, there});
  if (known == expected_.end())
    known = expected_.try_emplace({actions, there}, ahead_, settings_, sceneIn(there), actions, 0).first;
  known->second.begin(first, Priority::low);
}

void TaskSearch::expectAll(const std::vector<Actions>& all, Priority first) {
  for (const Actions& actions : all) expect(actions, {}, first);
}

/// Those that will say at which action a plan without waypoints fails.
std::vector<TaskSearch::Actions> TaskSearch::unknownBeginnings(const Actions& actions) const {
  std::vector<Actions> unknown;
  for (std::size_t count = 1; count < actions.size(); ++count) {
    Actions beginning(actions.begin(), actions.begin() + std::ptrdiff_t(count));
    const auto known = known_.find({beginning, {}});
    if (known == known_.end())
      unknown.push_back(std::move(beginning));
    else if (known->second)
      break;
  }
  return unknown;
}

void TaskSearch::expectNothing() {
  const std::scoped_lock lock(expecting_);
  expected_.clear();
}

TaskAttempt::Found TaskSearch::waypointsOf(const Actions& actions, const Circumstances& there) {
  std::optional<TaskAttempt> own;
  TaskAttempt* attempt = nullptr;
  {
    const std::scoped_lock lock(expecting_);
    const auto known = expected_.find({actions, there});
    attempt = known != expected_.end() ? &known->second : &own.emplace(ahead_, settings_, sceneIn(there), actions, 0);
  }
  TaskAttempt::Found found = attempt->find();
  evaluations_ += found.evaluations;
  return found;
}

bool TaskSearch::isKnownToFail(const Actions& actions) const {
  const auto known = known_.find({actions, {}});
  return known != known_.end() && known->second;
}

// --- in geometry -----------------------------------------------------------------------------------------------------

/// What comes of the waypoints of a seed.
Speculative<TaskTrials::Outcome> TaskSearch::outcomeOf(const Trial& trial, int seed, Priority wanted) {
  TaskTrials::Order order{trial.actions, trial.states, seed, wanted};
  if (seed == 0)
    order.at_first_failure = [this, all = unknownBeginnings(trial.actions)] { expectAll(all, Priority::low); };
  return ahead_.defer<TaskTrials::Outcome>(
      [trials = trials_, order = std::move(order)](const CancellationToken& stopped) {
        return trials->run(order, stopped);
      });
}

/// A plan from the next waypoints that have one; none where there are no more.
std::optional<TaskPlan> TaskSearch::nextOf(Trial& trial) {
  auto& later = trial.later;
  const auto seeds = [&] { return trial.found ? kBetterStarts : kMotionStarts; };
  while (trial.seed < seeds()) {
    const int seed = trial.seed++;
    if (seed == 0 && isKnownToFail(trial.actions)) break;
    if (!later.contains(seed)) later[seed] = outcomeOf(trial, seed, Priority::high);
    const int ahead = trial.found || needs_seeds_ ? options_.threads - 1 : 0;
    for (int next = seed + 1; next <= std::min(seed + ahead, seeds() - 1); ++next) {
      if (later.contains(next)) continue;
      later[next] = outcomeOf(trial, next, Priority::low);
      later[next].begin(Priority::low);
    }
    TaskTrials::Outcome& outcome = later[seed].get();
    evaluations_ += outcome.evaluations;
    if (outcome.cause) {
      if (seed == 0) known_[{trial.actions, {}}] = outcome.cause;
      trial.seed = kBetterStarts;
      break;
    }
    if (outcome.plan) {
      branches_.push_back({trial.actions, "", nullptr});
      trial.found = true;
      return completed(std::move(*outcome.plan));
    }
    needs_seeds_ = true;
    trial.failure = outcome.failure;
    if (!trial.found && !trial.failure->doors.empty()) break;
  }
  return std::nullopt;
}

// --- answers ---------------------------------------------------------------------------------------------------------

TaskPlan TaskSearch::end(TaskStatus status, std::string message) {
  TaskPlan plan;
  plan.status = status;
  plan.message = std::move(message);
  plan.goal = goal_;
  plan.start = start_;
  return completed(std::move(plan));
}

/// With what is to tell of the search so far.
TaskPlan TaskSearch::completed(TaskPlan plan) {
  settle();
  plan.causes = causesByCount();
  plan.tree = tree_;
  plan.evaluations = evaluations_;
  plan.expansions = search_->expansions();
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
    return end(TaskStatus::infeasible, contradiction(problem_));
  return end(TaskStatus::infeasible, neededProofs(search_->problem(), proofs_));
}

/// Finds the causes out that are not known yet.
void TaskSearch::settle() {
  for (const Branch& branch : std::exchange(branches_, {})) {
    const TaskFailure failure = branch.cause ? branch.cause->get() : TaskFailure();
    const std::string why = branch.words + failure.why;
    const auto is_same = [&](const TaskBranch& b) { return b.actions == branch.actions && b.why == why; };
    if (branch.is_given_up) {
      if (std::ranges::any_of(tree_, is_same)) continue;  // tried before regrasps were allowed
      addCause(why);
    }
    tree_.push_back({branch.actions, why, failure.ghost});
  }
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

std::string TaskSearch::firstCause() {
  settle();
  const auto causes = causesByCount();
  return causes.empty() ? "nothing was tried" : causes[0].first;
}

}  // namespace kinegraph
