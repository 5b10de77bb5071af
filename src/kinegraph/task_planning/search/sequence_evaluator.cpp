#include "kinegraph/task_planning/search/sequence_evaluator.h"

#include <algorithm>
#include <atomic>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/search/check_task_plan.h"

namespace kinegraph {

SequenceEvaluator::SequenceEvaluator(SpeculativeExecutor& executor, const WaypointSolver::Settings& settings,
                                     std::shared_ptr<const Config> scene, std::shared_ptr<const Config> original,
                                     MatrixXd limits, std::vector<Literal> goal, std::vector<Literal> start)
    : executor_(executor),
      settings_(settings),
      scene_(std::move(scene)),
      original_(std::move(original)),
      limits_(std::move(limits)),
      goal_(std::move(goal)),
      start_(std::move(start)),
      motions_(executor, limits_, start_, settings.seed) {}

SequenceEvaluator::Outcome SequenceEvaluator::evaluate(const Request& request, const CancellationToken& stopped) const {
  Outcome outcome;
  WaypointSolver::Result found;
  {
    WaypointSolver solver(executor_, settings_, scene_, request.actions, request.seed, stopped);
    found = solver.solve(request.priority, request.at_first_failure);
  }
  outcome.evaluations = found.evaluations;
  outcome.waypoint_failure = found.failure;
  if (!found.waypoints) return outcome;
  const Config C = *scene_;  // a thread's own
  const auto parts = std::make_shared<const Motions>(motionsBetween(C, *found.waypoints));
  const std::vector<TimedRows> rows = planMotions(C, parts, request.priority, stopped, outcome);
  if (outcome.motion_failure) return outcome;
  TaskPlan plan = assemble(C, *found.waypoints, rows);
  for (const Motion& motion : *parts) plan.scenes.push_back(motion.part.config);
  plan.violations = checkTaskPlan(Config(*original_), plan, request.states);
  if (plan.violations.empty())
    outcome.plan = std::move(plan);
  else
    outcome.motion_failure = TaskFailure{plan.violations[0], nullptr};
  return outcome;
}

/// The motion problems between consecutive waypoints, each from rest to rest.
SequenceEvaluator::Motions SequenceEvaluator::motionsBetween(const Config& C, const TaskWaypoints& waypoints) const {
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

/// Plans the motions of the actions, up to the first that fails; `outcome` then has its failure.
std::vector<TimedRows> SequenceEvaluator::planMotions(const Config& C, const std::shared_ptr<const Motions>& parts,
                                                      Priority priority, const CancellationToken& stopped,
                                                      Outcome& outcome) const {
  std::vector<Speculative<TaskMotions::Found>> later;
  const auto left = std::make_shared<std::atomic<int>>(int(parts->size()));  // motions that are not planned yet
  const std::function<int()> threads = [left, most = priority == Priority::high ? settings_.threads : 1] {
    return std::max(most + 1 - *left, 1);
  };
  for (std::size_t i = 0; i < parts->size(); ++i) {
    later.push_back(executor_.defer<TaskMotions::Found>(
        [motions = motions_, parts, i, stopped, left, threads](const CancellationToken& unwanted) {
          const Motion& motion = (*parts)[i];
          TaskMotions::Found found = motions.between(
              motion.part.config, motion.part.start, motion.part.end, motion.action, motion.before,
              [stopped, unwanted] { return stopped() || unwanted(); }, threads);
          --*left;
          return found;
        }));
    later.back().begin(priority);
  }
  std::vector<TimedRows> rows;
  for (std::size_t i = 0; i < parts->size() && !outcome.motion_failure; ++i) {
    TaskMotions::Found& found = later[i].get();
    outcome.evaluations += found.evaluations;
    if (found.motion) {
      rows.push_back(std::move(*found.motion));
      continue;
    }
    const Motion& motion = (*parts)[i];
    Config end = motion.part.config;
    end.setJointState(motion.part.end);
    outcome.motion_failure =
        TaskFailure{cat(planText({motion.action}), ": ", found.cause), std::make_shared<const Config>(std::move(end)),
                    i, blockingDoors(C, motion, stopped, outcome)};
  }
  return rows;
}

/// Facts about doors that are not open and block a motion: the action moves a part of the door, or the motion exists in
/// a scene in which those doors do not collide.
std::vector<Literal> SequenceEvaluator::blockingDoors(const Config& C, const Motion& motion,
                                                      const CancellationToken& stopped, Outcome& outcome) const {
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

TaskPlan SequenceEvaluator::assemble(const Config& C, const TaskWaypoints& waypoints,
                                     const std::vector<TimedRows>& rows) const {
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
