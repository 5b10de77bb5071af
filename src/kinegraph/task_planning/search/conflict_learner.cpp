#include "kinegraph/task_planning/search/conflict_learner.h"

#include <algorithm>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/search/task_conflicts.h"

namespace kinegraph::inline task_planning_internal {

namespace {

constexpr double kOpenedEarlier = .9;  ///< share of its range at which a door is assumed that was opened before
constexpr std::size_t kShort = 2;      ///< actions: shorter sequences are solved at once

/// "while (closed drawer): "; "" without facts.
std::string whileText(const std::vector<Literal>& facts) {
  std::vector<std::string> texts;
  for (const Literal& fact : facts) texts.push_back(fact.str());
  return texts.empty() ? "" : cat("while ", join(texts, " and "), ": ");
}

/// Positions of doors in a state that actions lead to; empty: all are as at the start.
std::vector<double> doorsIn(const Config& C, const std::vector<TaskDoor>& doors, const std::vector<Literal>& start,
                            const std::vector<Literal>& state) {
  const VectorXd q = C.getJointState();
  std::vector<double> positions;
  bool is_start = true;
  for (const TaskDoor& door : doors) {
    const std::string now = contains(state, {"opened", {door.name}})   ? "opened"
                            : contains(state, {"closed", {door.name}}) ? "closed"
                                                                       : "ajar";
    const bool is_same = contains(start, {now, {door.name}});
    positions.push_back(is_same ? q[door.dof] : door.at(now == "opened" ? kOpenedEarlier : kClose));
    is_start = is_start && is_same;
  }
  return is_start ? std::vector<double>() : positions;
}

}  // namespace

ConflictLearner::ConflictLearner(SpeculativeExecutor& executor, const Config& scene, std::vector<TaskDoor> doors,
                                 TaskLogic& logic, WaypointCache& waypoints, BranchLog& log)
    : executor_(executor), scene_(scene), doors_(std::move(doors)), logic_(logic), waypoints_(waypoints), log_(log) {}

bool ConflictLearner::learnHandThatFails(const Actions& actions) {
  const std::vector<Literal>& start = logic_.start();
  if (wordsOf(start, "is_gripper").size() < 2 || actions.size() <= kShort || !doors_.empty()) return false;
  std::set<std::string> moved;  // objects that are not where they were
  for (std::size_t i = 0; i < actions.size(); ++i) {
    const TaskAction& action = actions[i];
    if (action[0] != "pick" && action[0] != "place") return false;
    const Actions prefix(actions.begin(), actions.begin() + std::ptrdiff_t(i) + 1);
    const Actions alone = actionsAlone(prefix).actions;
    const std::string& place = action[0] == "pick" ? action[2] : action[3];
    const bool is_as_at_start = startsWithPick(alone, start) && !moved.contains(place);
    if (is_as_at_start && waypoints_.failureOf(alone, {objectsWithout(alone, start), {}})) {
      learnLast(prefix, nullptr);
      return true;
    }
    moved.insert(action[1]);
  }
  return false;
}

void ConflictLearner::learnMotionFailure(const Actions& actions, const TaskFailure& failure) {
  const auto known = std::make_shared<FutureFailure::element_type>(
      executor_.defer<TaskFailure>([failure](const CancellationToken&) { return failure; }));
  if (failure.doors.empty()) {
    giveUp(actions, "", known);
    return logic_.forbidPrefix(actions);
  }
  const Actions prefix(actions.begin(), actions.begin() + std::ptrdiff_t(failure.action) + 1);
  giveUp(prefix, whileText(failure.doors), known);
  forbidLast(prefix, withoutConstantDoors(failure.doors));
}

/// Finds the first action that fails.
void ConflictLearner::learnWaypointFailure(const Actions& actions) {
  const auto first = [&](std::size_t count) {
    return Actions(actions.begin(), actions.begin() + std::ptrdiff_t(count));
  };
  std::size_t count = 1;
  waypoints_.prefetch(waypoints_.unknownPrefixes(actions), Priority::normal);
  while (count < actions.size() && !waypoints_.failureOf(first(count))) ++count;
  waypoints_.dropPrefetched();
  learnLast(first(count), nullptr);
}

void ConflictLearner::learnWaypointFailure(const Actions& actions, std::size_t feasible, const FutureFailure& failure) {
  learnLast({actions.begin(), actions.begin() + std::ptrdiff_t(std::min(feasible + 1, actions.size()))}, failure);
}

/// Tests the last action with only those before it that matter, without other objects, then also without single objects
/// in its way: the smaller the failing problem, the more general the conflict. `known`: the failure of the prefix;
/// null: unknown.
void ConflictLearner::learnLast(const Actions& prefix, const FutureFailure& known) {
  const std::vector<Literal>& start = logic_.start();
  const auto [alone, before] = actionsAlone(prefix);
  const std::vector<Literal> state = logic_.statesAlong(prefix)[before];
  SceneVariant variant{objectsWithout(alone, start), doorsIn(scene_, doors_, start, state)};
  if (const FutureFailure failure = waypoints_.failureOf(alone, variant)) {
    const bool is_general = alone.size() == prefix.size() || startsWithPick(alone, start);
    std::vector<Literal> facts = relevantDoors(alone, variant);
    giveUp(prefix, whileText(facts), failure);
    for (Literal& fact : whileFacts(alone, start)) facts.push_back(std::move(fact));
    return forbidLast(prefix, is_general ? std::optional(withoutConstantDoors(facts)) : std::nullopt);
  }
  const std::vector<std::string> others = variant.without;
  for (const InTheWay& one : inTheWay(alone.back(), start)) {
    if (!contains(state, one.fact)) continue;  // it has gone
    variant.without = others;
    std::erase(variant.without, one.obj);
    if (const FutureFailure failure = waypoints_.failureOf(alone, variant)) {
      std::vector<Literal> facts = {one.fact};
      for (Literal& fact : relevantDoors(alone, variant)) facts.push_back(std::move(fact));
      giveUp(prefix, whileText(facts), failure);
      for (Literal& fact : whileFacts(alone, start)) facts.push_back(std::move(fact));
      return forbidLast(prefix, withoutConstantDoors(facts));
    }
  }
  if (const FutureFailure failure = known ? known : waypoints_.failureOf(prefix)) giveUp(prefix, "", failure);
  logic_.forbidPrefix(prefix);
}

void ConflictLearner::giveUp(const Actions& actions, const std::string& condition, FutureFailure failure) {
  has_learned_ = true;
  log_.addGivenUp(actions, condition, std::move(failure));
}

/// Facts about doors without which the actions would not fail: the fact of one door, else those of all doors; none if
/// the actions fail with other doors, too.
std::vector<Literal> ConflictLearner::relevantDoors(const Actions& actions, const SceneVariant& variant) {
  SceneVariant now = variant;
  if (variant.doors.empty())
    for (const TaskDoor& door : doors_) now.doors.push_back(scene_.getJointState()[door.dof]);
  SceneVariant all = now;
  std::vector<Literal> facts;
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    const std::string state = doors_[i].stateAt(now.doors[i]);
    facts.push_back({state, {doors_[i].name}});
    SceneVariant other = now;
    other.doors[i] = all.doors[i] = doors_[i].at(state == "opened" ? kClose : kOpenedEarlier);
    if (!waypoints_.failureOf(actions, other)) return {facts.back()};
  }
  if (doors_.size() > 1 && !waypoints_.failureOf(actions, all)) return facts;
  return {};
}

/// Drops facts about doors that no action moves.
std::vector<Literal> ConflictLearner::withoutConstantDoors(std::vector<Literal> facts) const {
  const auto is_door = [&](const Literal& fact) {
    return fact.arguments.size() == 1 && std::ranges::find(doors_, fact.arguments[0], &TaskDoor::name) != doors_.end();
  };
  std::erase_if(facts, [&](const Literal& fact) { return is_door(fact) && !logic_.isChangeable(fact); });
  return facts;
}

/// Forbids the last action while the facts hold. Without facts, or if they do not hold before it, the action is
/// forbidden only after the actions before it.
void ConflictLearner::forbidLast(const Actions& prefix, const std::optional<std::vector<Literal>>& facts) {
  const std::vector<std::vector<Literal>> states = logic_.statesAlong(prefix);
  const std::vector<Literal>& state = states[states.size() - 2];
  if (facts && std::ranges::all_of(*facts, [&](const Literal& fact) { return contains(state, fact); }))
    logic_.forbid(prefix.back(), *facts);
  else
    logic_.forbidPrefix(prefix);
}

}  // namespace kinegraph::inline task_planning_internal
