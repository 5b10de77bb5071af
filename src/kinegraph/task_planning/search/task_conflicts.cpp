#include "kinegraph/task_planning/search/task_conflicts.h"

#include <algorithm>
#include <set>

#include "kinegraph/common/text.h"
#include "kinegraph/logic/grounding.h"
#include "kinegraph/logic/plan_search.h"
#include "kinegraph/task_planning/task_doors.h"

namespace kinegraph::inline task_planning_internal {

namespace {

bool isAmong(const std::vector<std::string>& words, const std::string& word) {
  return std::ranges::find(words, word) != words.end();
}

}  // namespace

ActionsAlone actionsAlone(const std::vector<TaskAction>& actions) {
  const TaskAction& last = actions.back();
  const std::string subject = last[0] == "hook_start" ? last[4] : objectOf(last);  // of a hook: the tool
  for (std::size_t i = actions.size() - 1; i-- > 0;) {
    if (objectOf(actions[i]) != subject) continue;
    if (isPick(last) || isHold(last)) break;
    ActionsAlone alone = actionsAlone({actions.begin(), actions.begin() + std::ptrdiff_t(i) + 1});
    for (std::size_t k = i + 1; k + 1 < actions.size(); ++k)
      if (isHold(actions[k]) || isGuided(actions[k])) alone.actions.push_back(actions[k]);
    alone.actions.push_back(last);
    return alone;
  }
  return {{last}, actions.size() - 1};
}

bool startsWithPick(const std::vector<TaskAction>& actions, const std::vector<Literal>& start) {
  const TaskAction& first = actions.front();
  return isHold(first) || (isPick(first) && contains(start, {"on", {first[2], first[1]}}));
}

std::vector<std::string> objectsWithout(const std::vector<TaskAction>& actions, const std::vector<Literal>& start) {
  std::vector<std::string> others;
  for (const std::string& obj : wordsOf(start, "is_object"))
    if (std::ranges::none_of(actions, [&](const TaskAction& action) { return isAmong(action, obj); }))
      others.push_back(obj);
  return others;
}

std::vector<InTheWay> inTheWay(const TaskAction& action, const std::vector<Literal>& start) {
  std::vector<InTheWay> found;
  for (const Literal& fact : start) {
    if (fact.predicate != "on" || fact.arguments.size() != 2) continue;
    const std::string &place = fact.arguments[0], &obj = fact.arguments[1];
    if (std::find(action.begin() + 1, action.end(), place) != action.end() && !isAmong(action, obj))
      found.push_back({fact, obj});
  }
  return found;
}

std::vector<Literal> whileFacts(const std::vector<TaskAction>& alone, const std::vector<Literal>& start) {
  const TaskAction& last = alone.back();
  const std::map<std::string, std::string> under = whatIsBelow(start);
  std::set<std::string> below;
  for (std::size_t i = 1; i < last.size(); ++i)
    for (auto it = under.find(last[i]); it != under.end() && below.insert(it->first).second;)
      it = under.find(it->second);
  std::vector<Literal> facts;
  for (const std::string& obj : below) {
    if (const Literal fresh{"fresh", {obj}}; contains(start, fresh)) facts.push_back(fresh);
  }
  for (const Literal& fact : start)
    if (alone.size() > 1 && fact.predicate == "up" && fact.arguments.size() == 2 && fact.arguments[1] == objectOf(last))
      facts.push_back(fact);
  return facts;
}

std::string standsOnItself(const std::vector<std::vector<Literal>>& states) {
  for (const std::vector<Literal>& state : states) {
    const std::map<std::string, std::string> under = whatIsBelow(state);
    for (const auto& [obj, first] : under) {
      std::string below = first;
      for (std::size_t steps = 0; steps < under.size() && below != obj && under.contains(below); ++steps)
        below = under.at(below);
      if (below == obj) return obj;
    }
  }
  return "";
}

std::string neededProofs(const GroundProblem& ground, const std::vector<ImpossibleAction>& proofs) {
  std::vector<std::string> causes;
  for (const ImpossibleAction& proof : proofs)
    if (!isAmong(causes, proof.cause)) causes.push_back(proof.cause);
  const std::vector<std::string> all = causes;
  for (const std::string& cause : all) {
    std::vector<std::string> rest = causes;
    std::erase(rest, cause);
    PlanSearch search(ground);
    for (const ImpossibleAction& proof : proofs)
      if (isAmong(rest, proof.cause))
        search.forbid(actionNumber(ground, proof.action), changingFacts(ground, proof.facts));
    if (!search.next()) causes = rest;
  }
  return join(causes, "; ");
}

std::string contradiction(const LogicProblem& problem) {
  LogicProblem part = problem;
  for (const Literal& literal : problem.goal) {
    LogicProblem rest = part;
    std::erase(rest.goal, literal);
    if (!rest.goal.empty() && !PlanSearch(ground(rest)).next()) part = rest;
  }
  std::vector<std::string> words;
  for (const Literal& literal : part.goal) words.push_back(literal.str());
  return cat("no sequence of actions reaches ", join(words, " and "), words.size() > 1 ? " together" : "");
}

}  // namespace kinegraph::inline task_planning_internal
