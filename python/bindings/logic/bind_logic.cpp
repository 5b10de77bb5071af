#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/logic/domain.h"
#include "kinegraph/logic/grounding.h"
#include "kinegraph/task_planning/task_actions.h"
#include "logic/logic_docs.h"
#include "logic/logic_objects.h"
#include "task_planning/bind_tasks.h"

namespace kinegraph::python {

namespace {

using Words = std::vector<std::string>;
using Plan = std::vector<Words>;

std::string readFile(const PathText& path) {
  std::ifstream in(path.text, std::ios::binary);
  if (!in) throw FileError(cat("cannot read '", path.text, "'"));
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

Words texts(const std::vector<Formula>& formulas) {
  Words out;
  for (const Formula& formula : formulas) out.push_back(formula.str());
  return out;
}

Words joined(Words list, const Words& more) {
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

Words texts(const std::vector<Literal>& literals) {
  Words out;
  for (const Literal& literal : literals) out.push_back(literal.str());
  return out;
}

std::optional<Plan> nextPlan(PyPlanSearch& self) {
  std::optional<std::vector<int>> plan;
  {
    nb::gil_scoped_release release;
    plan = self.search->next();
  }
  if (!plan) return std::nullopt;
  return actionWords(self.ground(), *plan);
}

std::vector<Words> states(const PyPlanSearch& self, const Plan& plan) {
  std::vector<Words> out;
  for (const std::vector<Literal>& state : statesAlong(self.ground(), actionNumbers(self.ground(), plan)))
    out.push_back(texts(state));
  return out;
}

void forbid(PyPlanSearch& self, const Words& action, const std::string& facts) {
  self.search->forbid(actionNumber(self.ground(), action), changingFacts(self.ground(), readLiterals(facts, "facts")));
}

void makeSearch(PyPlanSearch* self, const LogicProblem& problem, long most) {
  PlanSearch::Options options;
  options.max_expansions = most;
  options.cancellation = [check = CheckInterrupts()]() mutable { check(); };
  new (self) PyPlanSearch{std::make_shared<PlanSearch>(ground(problem), std::move(options))};
}

void bindDomain(nb::module_& m) {
  nb::class_<LogicDomain> domain(m, "Domain", "Actions and rules in logic, with their predicates and constants.");
  bindDomainCopies(domain);
  domain.def(nb::init<>(), "Makes a domain without actions.")
      .def_static(
          "fromFol", [](const PathText& file) { return readFolFile(file.text); }, "file"_a, docs::logic::fromFol)
      .def_static(
          "fromFolText", [](const std::string& text, const std::string& name) { return readFol(text, name); }, "text"_a,
          "name"_a = "text", docs::logic::fromFolText)
      .def_static(
          "fromPddl", [](const PathText& file) { return readPddlDomain(readFile(file), file.text); }, "file"_a,
          docs::logic::fromPddl)
      .def_static(
          "fromPddlText", [](const std::string& text, const std::string& name) { return readPddlDomain(text, name); },
          "text"_a, "name"_a = "text", docs::logic::fromPddlText)
      .def(
          "toFol", [](const LogicDomain& d) { return writeFol(d); }, docs::logic::toFol)
      .def(
          "toPddl", [](const LogicDomain& d) { return writePddlDomain(d); }, docs::logic::toPddl)
      .def("addAction", addAction, "name"_a, "variables"_a, "pre"_a, "eff"_a, docs::logic::addAction)
      .def_rw("name", &LogicDomain::name, "Its name.")
      .def_ro("symbols", &LogicDomain::symbols, "Predicates and constants that are declared.")
      .def_prop_ro(
          "actions",
          [](const LogicDomain& d) {
            Words names;
            for (const LogicRule& rule : d.rules) {
              if (rule.is_decision) names.push_back(rule.name);
            }
            return names;
          },
          "Names of the actions.")
      .def("__repr__", [](const LogicDomain& d) { return cat("<Domain: ", d.rules.size(), " rules>"); });
}

void bindProblem(nb::module_& m) {
  nb::class_<LogicProblem>(m, "LogicProblem", "What holds at the start, and what shall hold at the end.")
      .def(
          "__init__",
          [](LogicProblem* self, const LogicDomain& domain, const std::string& start, const std::string& goal) {
            LogicProblem made{"problem", domain, {}, domain.start, readLiterals(goal, "goal")};
            for (Literal& fact : readLiterals(start, "start")) made.start.push_back(std::move(fact));
            new (self) LogicProblem(std::move(made));
          },
          "domain"_a, "start"_a, "goal"_a, docs::logic::problem)
      .def_static(
          "fromPddl",
          [](const LogicDomain& domain, const PathText& file) {
            return readPddlProblem(readFile(file), domain, file.text);
          },
          "domain"_a, "file"_a, docs::logic::problemFromPddl)
      .def(
          "toPddl", [](const LogicProblem& p) { return writePddlProblem(p); }, docs::logic::problemToPddl)
      .def_prop_ro(
          "start", [](const LogicProblem& p) { return texts(p.start); }, "Literals that hold at the start.")
      .def_prop_ro(
          "goal", [](const LogicProblem& p) { return joined(texts(p.goal), texts(p.goal_conditions)); },
          "Literals that shall hold, then other conditions as in PDDL.")
      .def_ro("minimize_cost", &LogicProblem::minimize_cost,
              "Whether the cheapest plans come first (:metric), or the shortest.");
}

}  // namespace

void bindLogic(nb::module_& m) {
  bindDomain(m);
  bindProblem(m);
  nb::class_<PyPlanSearch> search(m, "PlanSearch",
                                  "Enumerates the plans of a problem in logic, the shortest or cheapest first.");
  nb::enum_<PlanSearch::Status>(m, "PlanSearchStatus", "How the last search for a plan ended.")
      .value("found", PlanSearch::Status::found)
      .value("exhausted", PlanSearch::Status::exhausted)
      .value("limit", PlanSearch::Status::limit)
      .value("cancelled", PlanSearch::Status::cancelled);
  search.def("__init__", makeSearch, "problem"_a, "max_expansions"_a = 2000000, docs::logic::search)
      .def("next", nextPlan, docs::logic::next)
      .def("forbid", forbid, "action"_a, "facts"_a = "", docs::logic::forbid)
      .def(
          "forbidBeginning",
          [](PyPlanSearch& s, const Plan& plan) { s.search->forbidBeginning(actionNumbers(s.ground(), plan)); },
          "actions"_a, docs::logic::forbidBeginning)
      .def("states", states, "actions"_a, docs::logic::states)
      .def_prop_ro(
          "status", [](const PyPlanSearch& s) { return s.search->status(); },
          "How the last next() ended, a PlanSearchStatus.")
      .def_prop_ro(
          "expansions", [](const PyPlanSearch& s) { return s.search->expansions(); }, "States expanded so far.")
      .def_prop_ro(
          "actions",
          [](const PyPlanSearch& s) {
            Plan all;
            for (int a = 0; a < int(s.search->problem().actions.size()); ++a)
              all.push_back(s.search->problem().action(a));
            return all;
          },
          "All actions, as lists of words.")
      .def_prop_ro(
          "unreachable",
          [](const PyPlanSearch& s) {
            return joined(texts(s.search->problem().unreachable), texts(s.search->problem().impossible));
          },
          "Literals and conditions of the goal that nothing can make true.")
      .def(
          "cost",
          [](const PyPlanSearch& s, const Plan& plan) { return s.ground().cost(actionNumbers(s.ground(), plan)); },
          "actions"_a, docs::logic::cost)
      .def_prop_ro(
          "diagnostics", [](const PyPlanSearch& s) { return diagnostics(s.search->problem()); },
          "What is odd about the problem, a line each: rules that can never fire, and why.");
  m.def(
      "sceneFacts", [](const PyConfig& C) { return texts(sceneFacts(C)); }, "C"_a, docs::logic::sceneFacts);
}

}  // namespace kinegraph::python
