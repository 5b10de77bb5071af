#include "kinegraph/task_planning/search/task_trials.h"

#include <algorithm>
#include <atomic>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/search/check_task_plan.h"

namespace kinegraph {

TaskTrials::TaskTrials(SpeculativeExecutor& ahead, const TaskAttempt::Settings& settings,
                       std::shared_ptr<const Config> scene, std::shared_ptr<const Config> given, MatrixXd limits,
                       std::vector<Literal> goal, std::vector<Literal> start)
    : ahead_(ahead),
      settings_(settings),
      scene_(std::move(scene)),
      given_(std::move(given)),
      limits_(std::move(limits)),
      goal_(std::move(goal)),
      start_(std::move(start)),
      motions_(ahead, limits_, start_, settings.seed) {}

TaskTrials::Outcome TaskTrials::run(const Order& order, const CancellationToken& stopped) const {
  Outcome outcome;
  TaskAttempt::Found found;
  {
    TaskAttempt attempt(ahead_, settings_, scene_, order.actions, order.seed, stopped);
    found = attempt.find(order.wanted, order.at_first_failure);
  }
  outcome.evaluations = found.evaluations;
  outcome.cause = found.cause;
  if (!found.waypoints) return outcome;
  const Config C = *scene_;  // a thread's own
  const auto parts = std::make_shared<const Motions>(motionsBetween(C, *found.waypoints));
  const std::vector<TimedRows> rows = moved(C, parts, order.wanted, stopped, outcome);
  if (outcome.failure) return outcome;
  TaskPlan plan = planOf(C, *found.waypoints, rows);
  for (const Motion& motion : *parts) plan.scenes.push_back(motion.part.config);
  plan.violations = checkTaskPlan(Config(*given_), plan, order.states);
  if (plan.violations.empty())
    outcome.plan = std::move(plan);
  else
    outcome.failure = TaskFailure{plan.violations[0], nullptr};
  return outcome;
}

/// What moves between waypoints, from rest to rest.
TaskTrials::Motions TaskTrials::motionsBetween(const Config& C, const TaskWaypoints& waypoints) const {
  const std::vector<TaskAction>& actions = waypoints.actions;
  const MatrixXd settled = withSettledDoors(C, actions, waypoints.m->komo->getPath());
  Motions motions;
  for (int i = 0; i < int(actions.size()); ++i) {
    Motion motion{subProblem(waypoints.m->komo->path(), i), actions[std::size_t(i)], {}};
    if (i > 0) motion.before = actions[std::size_t(i) - 1];
    for (const TaskDoor& door : doorsOf(C)) {
      if (i > 0) motion.part.start[door.dof] = settled(i - 1, door.dof);
      motion.part.end[door.dof] = settled(i, door.dof);
    }
    motions.push_back(std::move(motion));
  }
  return motions;
}

/// The motions of all actions; up to the first for which there is none, which the outcome then tells.
std::vector<TimedRows> TaskTrials::moved(const Config& C, const std::shared_ptr<const Motions>& parts, Priority wanted,
                                         const CancellationToken& stopped, Outcome& outcome) const {
  std::vector<Speculative<TaskMotions::Found>> later;
  const auto left = std::make_shared<std::atomic<int>>(int(parts->size()));  // motions that nobody has ended yet
  const std::function<int()> threads = [left, most = wanted == Priority::high ? settings_.threads : 1] {
    return std::max(most + 1 - *left, 1);
  };
  for (std::size_t i = 0; i < parts->size(); ++i) {
    later.push_back(ahead_.defer<TaskMotions::Found>(
        [motions = motions_, parts, i, stopped, left, threads](const CancellationToken& unwanted) {
          const Motion& motion = (*parts)[i];
          TaskMotions::Found found = motions.between(
              motion.part.config, motion.part.start, motion.part.end, motion.action, motion.before,
              [stopped, unwanted] { return stopped() || unwanted(); }, threads);
          --*left;
          return found;
        }));
    later.back().begin(wanted);
  }
  std::vector<TimedRows> rows;
  for (std::size_t i = 0; i < parts->size() && !outcome.failure; ++i) {
    TaskMotions::Found& found = later[i].get();
    outcome.evaluations += found.evaluations;
    if (found.motion) {
      rows.push_back(std::move(*found.motion));
      continue;
    }
    const Motion& motion = (*parts)[i];
    Config ghost = motion.part.config;
    ghost.setJointState(motion.part.end);
    outcome.failure =
        TaskFailure{cat(planText({motion.action}), ": ", found.why), std::make_shared<const Config>(std::move(ghost)),
                    i, shutBy(C, motion, stopped, outcome)};
  }
  return rows;
}

/// Facts about doors that are not open and shut off what an action has to do: that is in one of them, or has a motion
/// where they are not.
std::vector<Literal> TaskTrials::shutBy(const Config& C, const Motion& motion, const CancellationToken& stopped,
                                        Outcome& outcome) const {
  if (isHold(motion.action) || isGuided(motion.action)) return {};
  std::vector<Literal> shut;
  Config scene = motion.part.config;
  for (const TaskDoor& door : doorsOf(C)) {
    const Literal fact{door.stateAt(motion.part.start[door.dof]), {door.name}};
    if (fact.predicate == "opened") continue;
    if (!movedBy(C, door.name, motion.action).empty()) return {fact};
    shut.push_back(fact);
    for (const std::string& name : partsOf(C, door.name)) scene.getFrame(name).setContact(0);
  }
  if (shut.empty()) return {};
  const TaskMotions::Found found = motions_.between(
      scene, motion.part.start, motion.part.end, motion.action, motion.before,
      [stopped, is_late = settings_.is_late] { return stopped() || (is_late && is_late()); },
      [&] { return settings_.threads; });
  outcome.evaluations += found.evaluations;
  return found.motion ? shut : std::vector<Literal>();
}

TaskPlan TaskTrials::planOf(const Config& C, const TaskWaypoints& waypoints, const std::vector<TimedRows>& rows) const {
  TaskPlan plan;
  plan.status = TaskStatus::solved;
  plan.goal = goal_;
  plan.start = start_;
  plan.actions = waypoints.actions;
  plan.waypoints = withSettledDoors(C, plan.actions, waypoints.m->komo->getPath());
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
  return plan;
}

}  // namespace kinegraph
