#include <algorithm>

#include "kinegraph/base/text.h"
#include "kinegraph/tasks/search/task_conflicts.h"
#include "kinegraph/tasks/search/task_search.h"

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
    giveUp(beginning, {whileText(failure.doors) + failure.why, failure.ghost});
    return forbidLast(beginning, withoutConstantDoors(failure.doors));
  }
  if (!trial.found) giveUp(trial.actions, *trial.failure);
  forbidBeginning(trial.actions);
}

void TaskSearch::giveUp(const Actions& actions, const TaskFailure& failure) {
  guessed_ = true;
  const auto is_same = [&](const TaskBranch& b) { return b.actions == actions && b.why == failure.why; };
  if (std::ranges::any_of(tree_, is_same)) return;  // tried before regrasps were allowed
  addCause(failure.why);
  tree_.push_back({actions, failure.why, failure.ghost});
}

/// Finds the first action at which it fails, and what stands in its way.
void TaskSearch::forbidFailing(const Actions& actions) {
  std::size_t count = 1;
  while (count < actions.size() && !failureOf({actions.begin(), actions.begin() + std::ptrdiff_t(count)})) ++count;
  const Actions beginning(actions.begin(), actions.begin() + std::ptrdiff_t(count));
  const auto [alone, before] = actionsAlone(beginning);
  const std::vector<Literal> then = states(beginning)[before];
  Circumstances there{objectsWithout(alone, start_), doorsIn(C_, doors_, start_, then)};
  if (const auto& failure = failureOf(alone, there)) {
    const bool is_general = alone.size() == beginning.size() || startsWithPick(alone, start_);
    std::vector<Literal> facts = doorsThatMatter(alone, there);
    giveUp(beginning, {whileText(facts) + failure->why, failure->ghost});
    for (Literal& fact : whileFacts(alone, start_)) facts.push_back(std::move(fact));
    return forbidLast(beginning, is_general ? std::optional(withoutConstantDoors(facts)) : std::nullopt);
  }
  const Words others = there.without;
  for (const InTheWay& one : inTheWay(alone.back(), start_)) {
    there.without = others;
    std::erase(there.without, one.obj);
    if (const auto& failure = failureOf(alone, there)) {
      std::vector<Literal> facts = {one.fact};
      for (Literal& fact : doorsThatMatter(alone, there)) facts.push_back(std::move(fact));
      giveUp(beginning, {whileText(facts) + failure->why, failure->ghost});
      for (Literal& fact : whileFacts(alone, start_)) facts.push_back(std::move(fact));
      return forbidLast(beginning, withoutConstantDoors(facts));
    }
  }
  if (const auto& failure = failureOf(beginning)) giveUp(beginning, *failure);
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

/// Why actions cannot be carried out in some circumstances; none if they can.
const std::optional<TaskFailure>& TaskSearch::failureOf(const Actions& actions, const Circumstances& there) {
  const std::pair<Actions, Circumstances> key{actions, there};
  if (const auto known = known_.find(key); known != known_.end()) return known->second;
  Config scene = C_;
  for (const std::string& name : there.without) scene.getFrame(name).setContact(0);
  if (!there.doors.empty()) {
    VectorXd q = scene.getJointState();
    for (std::size_t i = 0; i < doors_.size(); ++i) q[doors_[i].dof] = there.doors[i];
    scene.setJointState(q);
  }
  TaskAttempts::Found found = attempts_.find(scene, actions, 0);
  std::optional<TaskFailure> failure;
  if (!found.waypoints) failure = std::move(found.failure);
  return known_.emplace(key, std::move(failure)).first->second;
}

/// Facts about doors that are not open and shut off what an action has to do: that is in one of them, or has a motion
/// where they are not.
std::vector<Literal> TaskSearch::shutBy(const SubProblem& part, const Actions& actions, std::size_t i) {
  if (isHold(actions[i]) || isGuided(actions[i])) return {};
  std::vector<Literal> shut;
  Config scene = part.config;
  for (const TaskDoor& door : doors_) {
    const Literal fact{door.stateAt(part.start[door.dof]), {door.name}};
    if (fact.predicate == "opened") continue;
    if (!movedBy(C_, door.name, actions[i]).empty()) return {fact};
    shut.push_back(fact);
    for (const std::string& name : partsOf(C_, door.name)) scene.getFrame(name).setContact(0);
  }
  if (shut.empty()) return {};
  TaskMotions motions(limits_, start_, options_.seed, options_.threads, [this] { return isLate(); });
  const bool is_free =
      motions.between(scene, part.start, part.end, actions[i], i ? actions[i - 1] : TaskAction()).motion.has_value();
  attempts_.evaluations += motions.evaluations;
  return is_free ? shut : std::vector<Literal>();
}

}  // namespace kinegraph
