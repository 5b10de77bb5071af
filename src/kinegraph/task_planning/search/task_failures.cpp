#include <algorithm>

#include "kinegraph/common/text.h"
#include "kinegraph/task_planning/search/task_conflicts.h"
#include "kinegraph/task_planning/search/task_search.h"

// What a search makes of plans that fail: which actions are impossible, and while what holds.
namespace kinegraph {

namespace {

constexpr double kOpenedElsewhere = .9;  ///< of its range: where a door is that was opened before

/// "while (closed drawer): "; "" without facts.
std::string whileText(const std::vector<Literal>& facts) {
  std::vector<std::string> words;
  for (const Literal& fact : facts) words.push_back(fact.str());
  return words.empty() ? "" : cat("while ", join(words, " and "), ": ");
}

/// Where doors are in a state that actions lead to; empty: all as at the start.
std::vector<double> doorsIn(const Config& C, const std::vector<TaskDoor>& doors, const std::vector<Literal>& start,
                            const std::vector<Literal>& state) {
  const VectorXd q = C.getJointState();
  std::vector<double> there;
  bool is_start = true;
  for (const TaskDoor& door : doors) {
    const std::string now = contains(state, {"opened", {door.name}})   ? "opened"
                            : contains(state, {"closed", {door.name}}) ? "closed"
                                                                       : "ajar";
    const bool is_same = contains(start, {now, {door.name}});
    there.push_back(is_same ? q[door.dof] : door.at(now == "opened" ? kOpenedElsewhere : kClose));
    is_start = is_start && is_same;
  }
  return is_start ? std::vector<double>() : there;
}

}  // namespace

/// Forbids what was tried, or what fails in it.
void TaskSearch::conclude(const Trial& trial) {
  if (!trial.found && !trial.failure) return forbidFailing(trial.actions);
  if (!trial.found && !trial.failure->doors.empty()) {
    const TaskFailure& failure = *trial.failure;
    const Actions beginning(trial.actions.begin(), trial.actions.begin() + std::ptrdiff_t(failure.action) + 1);
    giveUp(beginning, whileText(failure.doors), causeOf(failure));
    return forbidLast(beginning, withoutConstantDoors(failure.doors));
  }
  if (!trial.found) giveUp(trial.actions, "", causeOf(*trial.failure));
  forbidBeginning(trial.actions);
}

TaskCause TaskSearch::causeOf(const TaskFailure& failure) {
  return std::make_shared<TaskCause::element_type>(
      ahead_.defer<TaskFailure>([failure](const CancellationToken&) { return failure; }));
}

void TaskSearch::giveUp(const Actions& actions, const std::string& words, TaskCause cause) {
  guessed_ = true;
  cause->begin(Priority::normal);
  branches_.push_back({actions, words, std::move(cause), true});
}

/// Finds the first action at which it fails, and what stands in its way.
void TaskSearch::forbidFailing(const Actions& actions) {
  const auto first = [&](std::size_t count) {
    return Actions(actions.begin(), actions.begin() + std::ptrdiff_t(count));
  };
  std::size_t count = 1;
  expectAll(unknownBeginnings(actions), Priority::normal);
  while (count < actions.size() && !failureOf(first(count))) ++count;
  const Actions beginning = first(count);
  expectNothing();
  const auto [alone, before] = actionsAlone(beginning);
  const std::vector<Literal> then = states(beginning)[before];
  Circumstances there{objectsWithout(alone, start_), doorsIn(C_, doors_, start_, then)};
  if (const TaskCause cause = failureOf(alone, there)) {
    const bool is_general = alone.size() == beginning.size() || startsWithPick(alone, start_);
    std::vector<Literal> facts = doorsThatMatter(alone, there);
    giveUp(beginning, whileText(facts), cause);
    for (Literal& fact : whileFacts(alone, start_)) facts.push_back(std::move(fact));
    return forbidLast(beginning, is_general ? std::optional(withoutConstantDoors(facts)) : std::nullopt);
  }
  const Words others = there.without;
  for (const InTheWay& one : inTheWay(alone.back(), start_)) {
    there.without = others;
    std::erase(there.without, one.obj);
    if (const TaskCause cause = failureOf(alone, there)) {
      std::vector<Literal> facts = {one.fact};
      for (Literal& fact : doorsThatMatter(alone, there)) facts.push_back(std::move(fact));
      giveUp(beginning, whileText(facts), cause);
      for (Literal& fact : whileFacts(alone, start_)) facts.push_back(std::move(fact));
      return forbidLast(beginning, withoutConstantDoors(facts));
    }
  }
  if (const TaskCause& cause = failureOf(beginning)) giveUp(beginning, "", cause);
  forbidBeginning(beginning);
}

/// Facts about doors without which the actions would not fail: that of one door, else those of all; none if they fail
/// then, too.
std::vector<Literal> TaskSearch::doorsThatMatter(const Actions& actions, const Circumstances& there) {
  Circumstances now = there;
  if (there.doors.empty())
    for (const TaskDoor& door : doors_) now.doors.push_back(C_.getJointState()[door.dof]);
  Circumstances all = now;
  std::vector<Literal> facts;
  for (std::size_t i = 0; i < doors_.size(); ++i) {
    const std::string is = doors_[i].stateAt(now.doors[i]);
    facts.push_back({is, {doors_[i].name}});
    Circumstances other = now;
    other.doors[i] = all.doors[i] = doors_[i].at(is == "opened" ? kClose : kOpenedElsewhere);
    if (!failureOf(actions, other)) return {facts.back()};
  }
  if (doors_.size() > 1 && !failureOf(actions, all)) return facts;
  return {};
}

/// Without facts about doors that no action moves.
std::vector<Literal> TaskSearch::withoutConstantDoors(std::vector<Literal> facts) const {
  const auto is_door = [&](const Literal& fact) {
    return fact.arguments.size() == 1 && std::ranges::find(doors_, fact.arguments[0], &TaskDoor::name) != doors_.end();
  };
  std::erase_if(facts, [&](const Literal& f) { return is_door(f) && search_->problem().factNumber(f) < 0; });
  return facts;
}

/// The last action is impossible while facts hold; without facts, or where they do not hold then: after what was done
/// before.
void TaskSearch::forbidLast(const Actions& beginning, const std::optional<std::vector<Literal>>& facts) {
  const std::vector<std::vector<Literal>> along = states(beginning);
  const std::vector<Literal>& holds = along[along.size() - 2];
  if (facts && std::ranges::all_of(*facts, [&](const Literal& fact) { return contains(holds, fact); }))
    forbid(beginning.back(), *facts);
  else
    forbidBeginning(beginning);
}

/// Why actions cannot be carried out in some circumstances; null if they can.
const TaskCause& TaskSearch::failureOf(const Actions& actions, const Circumstances& there) {
  const std::pair key(actions, there);
  const auto known = known_.find(key);
  if (known != known_.end()) return known->second;
  return known_.emplace(key, waypointsOf(actions, there).cause).first->second;
}

}  // namespace kinegraph
