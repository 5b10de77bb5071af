#include "kinegraph/task_planning/search/sequence_evaluator.h"

#include <algorithm>
#include <atomic>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/motions/motion_checks.h"
#include "kinegraph/task_planning/search/plan_task.h"
#include "kinegraph/task_planning/search/step_tolerance.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr std::size_t kLong = 4;     ///< actions; longer sequences may be solved in pieces
constexpr std::size_t kJointly = 8;  ///< actions; longer sequences are solved in pieces only, after one guess
constexpr int kPieceSeeds = 3;       ///< solutions of a piece that are tried
constexpr int kTriesPerPiece = 3;    ///< on average

/// The ends of the pieces of a long sequence: after actions that leave all hands free. One piece if it is short, or if
/// the effect of its actions on a scene is unknown.
std::vector<std::size_t> cutsOf(const std::vector<TaskAction>& actions,
                                const std::vector<std::vector<Literal>>& states) {
  std::vector<std::size_t> cuts;
  for (std::size_t i = 0; i < actions.size() && states.size() > actions.size(); ++i) {
    if (!isDefaultAction(actions[i])) return {actions.size()};
    const bool is_free = std::ranges::none_of(states[i + 1], [](const Literal& f) { return f.predicate == "busy"; });
    if (is_free && (isPlace(actions[i]) || endsSliding(actions[i]) || isGuided(actions[i]))) cuts.push_back(i + 1);
  }
  if (actions.size() <= kLong || cuts.empty()) return {actions.size()};
  if (cuts.back() != actions.size()) cuts.push_back(actions.size());
  return cuts;
}

/// The scene after a plan, with held objects attached to hands, and standing ones to their places.
Config sceneAfter(const Config& C, const TaskPlan& plan) {
  Config scene = C;
  for (std::size_t i = 0; i < plan.actions.size(); ++i) {
    const TaskAction& action = plan.actions[i];
    scene.setJointState(plan.path.row(plan.segments[i].end - 1));
    if (isPick(action) || action[0] == "handover" || startsSliding(action) || isPlace(action) || endsSliding(action))
      hang(scene, action[1], action[3]);
  }
  return scene;
}

/// Adds a plan that begins where another one ends.
void append(TaskPlan& plan, TaskPlan next) {
  const auto stacked = [](const MatrixXd& a, const MatrixXd& b) {
    MatrixXd both(a.rows() + b.rows(), a.cols());
    both << a, b;
    return both;
  };
  const Eigen::Index rows = plan.path.rows();
  const double begins = plan.duration();
  plan.waypoints = stacked(plan.waypoints, next.waypoints);
  plan.path = stacked(plan.path, next.path);
  plan.times = stacked(plan.times, VectorXd(next.times.array() + begins));
  for (const RowRange& segment : next.segments) plan.segments.push_back({segment.begin + rows, segment.end + rows});
  const auto extend = [](auto& all, auto& more) {
    all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  };
  extend(plan.actions, next.actions);
  extend(plan.attachments, next.attachments);
  extend(plan.scenes, next.scenes);
  extend(plan.tolerances, next.tolerances);
  extend(plan.warnings, next.warnings);
  plan.margin = std::min(plan.margin, next.margin);
}

}  // namespace

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
      motions_(executor, limits_, {settings.margin, settings.contact_speed}, start_, settings.seed) {}

SequenceEvaluator::Outcome SequenceEvaluator::evaluate(const Request& request, const CancellationToken& stopped) const {
  const Piece whole{scene_, request.actions, {}, {}, request.seed};
  const bool has_pieces = cutsOf(request.actions, request.states).size() > 1;
  WaypointSolver solver(executor_, settings_, scene_, request.actions, request.seed, stopped);
  Outcome outcome = evaluatePiece(whole, request, stopped, solver, has_pieces);
  if (has_pieces && !outcome.plan && !stopped()) {
    const long spent = outcome.evaluations;
    Outcome pieces = evaluateInPieces(request, stopped);
    pieces.evaluations += spent;
    if (pieces.plan || !outcome.waypoint_failure || request.actions.size() > kJointly) {
      outcome = std::move(pieces);
    } else {
      const bool fails_at_once = pieces.feasible_actions == 0 && pieces.waypoint_failure;
      Outcome joint = fails_at_once ? Outcome() : evaluatePiece(whole, request, stopped, solver, false);
      joint.evaluations += pieces.evaluations;
      outcome = fails_at_once ? std::move(pieces) : std::move(joint);
    }
  }
  if (outcome.plan) check(outcome, request);
  return outcome;
}

/// Plays the plan of an outcome; it fails with the first violation.
void SequenceEvaluator::check(Outcome& outcome, const Request& request) const {
  outcome.plan->violations = checkTaskPlan(Config(*original_), *outcome.plan, request.states);
  if (outcome.plan->violations.empty()) return;
  outcome.motion_failure = TaskFailure{outcome.plan->violations[0], nullptr};
  outcome.plan.reset();
}

/// Solves for the waypoints and the motions of a piece. The plan is not checked.
SequenceEvaluator::Outcome SequenceEvaluator::evaluatePiece(const Piece& piece, const Request& request,
                                                            const CancellationToken& stopped, WaypointSolver& solver,
                                                            bool only_first) const {
  Outcome outcome;
  const WaypointSolver::Result found = solver.solve(request.priority, request.at_first_failure, only_first);
  outcome.evaluations = found.evaluations;
  outcome.waypoint_failure = found.failure;
  if (!found.waypoints) return outcome;
  const Config C = *piece.scene;  // a thread's own
  const auto parts = std::make_shared<const Motions>(motionsBetween(C, *found.waypoints, piece.before));
  const std::vector<TimedRows> rows = planMotions(C, parts, request.priority, stopped, outcome);
  if (outcome.motion_failure) return outcome;
  TaskPlan plan = assemble(C, *found.waypoints, rows);
  for (const Motion& motion : *parts) plan.scenes.push_back(motion.part.config);
  plan.margin = outcome.margin;
  judge(plan, *parts);
  outcome.plan = std::move(plan);
  return outcome;
}

/// Solves pieces in turn. A piece without a solution leads back to another solution of the piece before.
SequenceEvaluator::Outcome SequenceEvaluator::evaluateInPieces(const Request& request,
                                                               const CancellationToken& stopped) const {
  const std::vector<std::size_t> cuts = cutsOf(request.actions, request.states);
  const auto at = [&](std::size_t i) { return request.actions.begin() + std::ptrdiff_t(i); };
  std::vector<std::shared_ptr<const Config>> scenes = {scene_};
  std::vector<TaskPlan> plans;
  std::vector<int> seeds = {0};
  Outcome last;
  long evaluations = 0;
  int tries = kTriesPerPiece * int(cuts.size());
  while (plans.size() < cuts.size()) {
    const std::size_t k = plans.size(), first = k == 0 ? 0 : cuts[k - 1];
    if (seeds[k] >= kPieceSeeds || tries == 0 || stopped() || (settings_.is_late && settings_.is_late())) {
      if (k == 0 || tries == 0 || stopped()) break;
      plans.pop_back();  // another solution of the piece before
      scenes.pop_back();
      seeds.pop_back();
      continue;
    }
    --tries;
    Piece piece{scenes[k], {at(first), at(cuts[k])}, {at(cuts[k]), request.actions.end()}, {}, 0};
    if (first > 0) piece.before = request.actions[first - 1];
    piece.seed = request.seed * kPieceSeeds + seeds[k]++;
    Request part{piece.actions, {}, piece.seed, request.priority, {}};
    WaypointSolver solver(executor_, settings_, piece.scene, piece.actions, piece.seed, stopped, piece.later);
    Outcome outcome = evaluatePiece(piece, part, stopped, solver, false);
    evaluations += outcome.evaluations;
    if (!outcome.plan) {
      outcome.feasible_actions = first;
      for (std::size_t count = 1; outcome.waypoint_failure && count < piece.actions.size(); ++count) {
        WaypointSolver prefix(executor_, settings_, piece.scene, {at(first), at(first + count)}, piece.seed, stopped,
                              {at(first + count), request.actions.end()});
        WaypointSolver::Result found = prefix.solve(request.priority);
        evaluations += found.evaluations;
        if (found.waypoints) {
          ++outcome.feasible_actions;
        } else {
          outcome.waypoint_failure = found.failure;
          break;
        }
      }
      if (outcome.motion_failure) outcome.motion_failure->action += first;
      if (first >= last.feasible_actions || (!last.waypoint_failure && !last.motion_failure)) last = std::move(outcome);
      if (last.waypoint_failure) seeds[k] = kPieceSeeds;  // waypoints do not depend much on the seed
      continue;
    }
    scenes.push_back(std::make_shared<const Config>(sceneAfter(*piece.scene, *outcome.plan)));
    seeds.push_back(0);
    plans.push_back(std::move(*outcome.plan));
  }
  last.evaluations = evaluations;
  if (plans.size() < cuts.size()) return last;
  Outcome all;
  all.evaluations = evaluations;
  all.plan = std::move(plans[0]);
  for (std::size_t k = 1; k < plans.size(); ++k) append(*all.plan, std::move(plans[k]));
  return all;
}

/// The motion problems between consecutive waypoints, each from rest to rest.
SequenceEvaluator::Motions SequenceEvaluator::motionsBetween(const Config& C, const TaskWaypoints& waypoints,
                                                             const TaskAction& before) const {
  const std::vector<TaskAction>& actions = waypoints.actions;
  const MatrixXd settled = withSettledDoors(C, actions, waypoints.m->komo->getPath());
  Motions motions;
  for (int i = 0; i < int(actions.size()); ++i) {
    Motion motion{subProblem(waypoints.m->komo->path(), i), actions[std::size_t(i)], before};
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
    later.push_back(
        executor_.defer<TaskMotions::Found>([motions = motions_, parts, i, stopped, left, threads,
                                             is_late = settings_.is_late](const CancellationToken& unwanted) {
          const Motion& motion = (*parts)[i];
          TaskMotions::Found found = motions.between(
              motion.part.config, motion.part.start, motion.part.end, motion.action, motion.before,
              [&] { return stopped() || unwanted() || (is_late && is_late()); }, threads);
          --*left;
          return found;
        }));
    later.back().begin(priority);
  }
  std::vector<TimedRows> rows;
  outcome.margin = settings_.margin;
  for (std::size_t i = 0; i < parts->size() && !outcome.motion_failure; ++i) {
    TaskMotions::Found& found = later[i].get();
    outcome.evaluations += found.evaluations;
    if (found.motion) {
      outcome.margin = std::min(outcome.margin, found.margin);
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

/// Adds the tolerance of each step, and warnings about pairs that are closer than the margin.
void SequenceEvaluator::judge(TaskPlan& plan, const Motions& parts) const {
  const std::vector<std::string> hands = wordsOf(start_, "is_gripper");
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Motion& motion = parts[i];
    const MatrixXd path = plan.path.middleRows(plan.segments[i].begin, plan.segments[i].size());
    const Surroundings around(motion.part.config, motion.part.start, motion.part.end, motion.action, motion.before,
                              hands);
    if (plan.margin < settings_.margin) {
      const NearBodies near = around.nearest(path, settings_.margin - 2. * kMarginSlack);
      if (!near.a.empty())
        plan.warnings.push_back(cat(planText({motion.action}), ": '", near.a, "' and '", near.b, "' are ",
                                    fixed(1e3 * std::max(near.distance, 0.), 1),
                                    " mm apart on the way, less than the margin of ", fixed(1e3 * settings_.margin, 1),
                                    " mm"));
    }
    plan.tolerances.push_back(toleranceOf(motion.part.config, around, path, motion.action, hands));
    const auto& [error, limit] = plan.tolerances.back();
    if (isPick(motion.action) && error == 0.) plan.warnings.push_back(cat(planText({motion.action}), ": ", limit));
  }
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

}  // namespace kinegraph::inline task_planning_internal
