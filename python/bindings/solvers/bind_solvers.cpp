#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <limits>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/lagrange_gradients.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "python_names.h"
#include "solvers/explanation_dicts.h"
#include "solvers/nlp_objects.h"
#include "solvers/sensitivity.h"
#include "solvers/solver_options.h"
#include "solvers/solvers_docs.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

/// Sets what is named and nothing else.
NlpSolver& setOptions(NlpSolver& solver, nb::kwargs given) {
  solverOptions().setFields(solver.options, given);
  return solver;
}

SolverResult solve(NlpSolver& solver, int resample, int verbose) {
  if (verbose > -100) solver.options.verbose = verbose;
  return solveInterruptibly(solver, resample > 0);
}

NlpSolver& setProgress(NlpSolver& solver, nb::object function, double seconds) {
  if (function.is_none()) {
    solver.setProgress({}, seconds);
    return solver;
  }
  solver.setProgress(
      [function](int evals, const VectorXd& x, const ErrorSums& e) {
        bool go_on = true;
        return callUser([&] {
                 nb::dict now;
                 now["evals"] = evals;
                 now["x"] = toNumpy(x);
                 now["f"] = e.f;
                 now["sos"] = e.sos;
                 now["ineq"] = e.ineq;
                 now["eq"] = e.eq;
                 go_on = !function(now).is(nb::handle(Py_False));
               }) &&
               go_on;
      },
      seconds);
  return solver;
}

Explanation explanationOf(const SolverResult& result, double tolerance) {
  if (!result.problem && !result.feasible && !result.message.empty()) {
    Explanation refused;  // as by RRT_PathFinder, whose message has all that is known
    refused.verdict = Explanation::Verdict::conflict;
    refused.reason = result.message;
    return refused;
  }
  if (!result.problem) throw Error("SolverReturn: nothing was solved, so there is nothing to explain");
  return explainInterruptibly(*result.problem, result.x, tolerance);
}

std::optional<bool> freeOf(const SolverResult& r) {
  const nb::gil_scoped_release unlock;
  return r.free(CheckInterrupts());
}

std::string messageOf(const SolverResult& r) {
  std::string text;
  {
    const nb::gil_scoped_release unlock;
    text = r.summary(CheckInterrupts());
  }
  return inPython(text);
}

/// Returns None, or the validity and message of the check between slices.
nb::object verdictState(const SolverResult& r) {
  const std::optional<bool> free = freeOf(r);
  return free ? nb::object(nb::make_tuple(*free, r.validity->get().message)) : nb::none();
}

/// Returns the state for pickling: everything except the problem.
nb::tuple resultState(const SolverResult& r) {
  const nb::object verdict = verdictState(r);
  return nb::make_tuple(toNumpy(r.x), toNumpy(r.dual), r.evals, r.time, r.feasible, r.done, r.f, r.sos, r.ineq, r.eq,
                        r.violation, int(r.status), r.message, verdict, r.totalEvals);
}

SolverResult resultFrom(nb::tuple state) {
  SolverResult r;
  r.x = nb::cast<Numbers>(state[0]).values;
  r.dual = nb::cast<Numbers>(state[1]).values;
  r.evals = nb::cast<int>(state[2]);
  r.time = nb::cast<double>(state[3]);
  r.feasible = nb::cast<bool>(state[4]);
  r.done = nb::cast<bool>(state[5]);
  double* numbers[] = {&r.f, &r.sos, &r.ineq, &r.eq, &r.violation};
  for (int i = 0; i < 5; ++i) *numbers[i] = nb::cast<double>(state[6 + i]);
  r.status = SolverStatus(nb::cast<int>(state[11]));
  r.message = nb::cast<std::string>(state[12]);
  if (const nb::object verdict = state[13]; !verdict.is_none())
    r.validity =
        std::make_shared<LazyValidity>(ValidityReport{nb::cast<bool>(verdict[0]), nb::cast<std::string>(verdict[1])});
  r.totalEvals = nb::cast<int>(state[14]);
  return r;
}

nb::typed<nb::dict, nb::str, Attributes> gradients(NlpSolver& solver, const std::vector<std::string>& names) {
  if (!solver.problem() || solver.x.size() == 0) throw Error("reportLagrangeGradients: nothing has been solved yet");
  nb::typed<nb::dict, nb::str, Attributes> report;
  for (const LagrangeGradient& entry : lagrangeGradients(*solver.problem(), solver.x, solver.dual, names)) {
    nb::dict values;
    values["err"] = entry.error;
    values["grad"] = entry.gradient;
    values["type"] = objectiveTypeName(entry.type);
    std::string key = entry.name;
    if (report.contains(key.c_str())) key += cat(" (", objectiveTypeName(entry.type), ")");
    report[key.c_str()] = values;
  }
  return report;
}

Array stack(const std::vector<VectorXd>& rows) {
  NewArray array = newArray(rows.size(), rows.empty() ? 0 : std::size_t(rows[0].size()));
  double* data = array.data;
  for (const VectorXd& row : rows) data = std::copy(row.begin(), row.end(), data);
  return array.array;
}

Array errorTrace(const NlpSolver& solver) {
  std::vector<VectorXd> rows;
  for (const ErrorSums& e : solver.traceErrors()) rows.push_back(Vector4d(e.f, e.sos, e.ineq, e.eq));
  return stack(rows);
}

void bindResult(nb::module_& m) {
  nb::enum_<SolverStatus>(m, "SolverStatus", "The reason why a solver stopped.")
      .value("converged", SolverStatus::converged)
      .value("infeasible", SolverStatus::infeasible)
      .value("stalled", SolverStatus::stalled)
      .value("limit", SolverStatus::limit)
      .value("cancelled", SolverStatus::cancelled);

  nb::class_<SolverResult> result(m, "SolverReturn", "The result of a solve.");
  result.def(nb::init<>(), "Creates an empty result.")
      .def(nb::init<const SolverResult&>(), "other"_a, docs::solvers::copy)
      .def_prop_ro(
          "x", [](const SolverResult& r) { return toNumpy(r.x); }, "The solution, shape (n,).")
      .def_prop_ro(
          "dual", [](const SolverResult& r) { return toNumpy(r.dual); }, "One multiplier per residual, shape (d,).")
      .def_ro("evals", &SolverResult::evals, "Number of evaluations of this solve.")
      .def_ro("totalEvals", &SolverResult::totalEvals,
              "Number of evaluations of all solves of the solver so far, this one included.")
      .def_ro("time", &SolverResult::time, "Duration of the solve, s.")
      .def_ro("feasible", &SolverResult::feasible,
              "Whether no (scaled) constraint is violated by more than 1e-3, or ten tolerances.")
      .def_ro("done", &SolverResult::done, "Whether the solver has run.")
      .def_ro("f", &SolverResult::f, "Sum of f residuals.")
      .def_ro("sos", &SolverResult::sos, "Sum of squares.")
      .def_ro("ineq", &SolverResult::ineq, "Sum of violations of inequalities.")
      .def_ro("eq", &SolverResult::eq, "Sum of violations of equalities.")
      .def_ro("violation", &SolverResult::violation, "Violation of the worst constraint.")
      .def_ro("status", &SolverResult::status, "The reason why the solver stopped.")
      .def_prop_ro("message", messageOf,
                   "The reason why the solver stopped, in one line. If the constraints hold but the motion is not "
                   "collision-free\n"
                   "between slices, also the shapes, time and depth of the deepest collision.")
      .def_prop_ro("free", freeOf,
                   "Whether the motion is continuously collision-free, straight from slice to slice. None without "
                   "constraints on\n"
                   "collisions of all shapes, or if slices are waypoints, one per phase. Computed at the first access.")
      .def(
          "dict",
          [](const SolverResult& r) {
            Attributes d;
            d["evals"] = r.evals;
            d["time"] = r.time;
            d["done"] = r.done;
            d["feasible"] = r.feasible;
            d["f"] = r.f;
            d["sos"] = r.sos;
            d["ineq"] = r.ineq;
            d["eq"] = r.eq;
            return d;
          },
          "The numbers evals, time, done, feasible, f, sos, ineq and eq, as a dict.")
      .def(
          "explain", [](const SolverResult& r, double tolerance) { return textOf(explanationOf(r, tolerance)); },
          "tolerance"_a = 1e-3, docs::solvers::explain)
      .def(
          "conflicts", [](const SolverResult& r, double tolerance) { return toDicts(explanationOf(r, tolerance)); },
          "tolerance"_a = 1e-3, docs::solvers::conflicts)
      .def("__str__", [](const SolverResult& r) { return inPython(r.str()); })
      .def("__getstate__", resultState)
      .def(
          "__setstate__", [](SolverResult& r, nb::tuple state) { new (&r) SolverResult(resultFrom(state)); }, "state"_a)
      .def("__repr__", [](const SolverResult& r) {
        return cat("<SolverReturn ", solverStatusName(r.status), ": ", inPython(r.str()), ">");
      });
  bindSensitivity(m, result);
}

/// Binds the records of setTracing.
void bindTraces(nb::class_<NlpSolver>& solver) {
  solver
      .def(
          "getTrace_x", [](const NlpSolver& s) { return stack(s.traceX()); },
          "The variables of each evaluation, shape (evaluations, n).")
      .def(
          "getTrace_phi", [](const NlpSolver& s) { return stack(s.tracePhi()); },
          "The residuals of each evaluation, shape (evaluations, d).")
      .def(
          "getTrace_J",
          [](const NlpSolver& s) {
            nb::typed<nb::list, Array> list;
            for (const MatrixXd& J : s.traceJacobian()) list.append(toNumpy(J));
            return list;
          },
          "The Jacobian of each evaluation, shape (d, n).")
      .def(
          "getTrace_best",
          [](const NlpSolver& s) {
            std::vector<VectorXd> rows;
            double best = std::numeric_limits<double>::infinity();
            for (const ErrorSums& e : s.traceErrors())
              rows.push_back(VectorXd::Constant(1, best = std::min(best, e.f + e.sos + e.ineq + e.eq)));
            return stack(rows);
          },
          "The least sum of all errors up to each evaluation, shape (evaluations, 1).")
      .def("getTrace_errs", errorTrace, "The sums of f, sos, ineq and eq of each evaluation, shape (evaluations, 4).");
}

void bindSolver(nb::module_& m) {
  constexpr auto chain = nb::rv_policy::none;
  const std::string set_options_doc =
      "Sets options by name; all others keep their values.\n\nArgs:\n    options: Fields of NLP_SolverOptions.\n" +
      solverOptions().docs("        ") +
      "Returns:\n    The solver itself.\nRaises:\n    ArgumentError: There is no such option, or the "
      "value is invalid.";
  nb::class_<NlpSolver> solver(m, "NLP_Solver", "Solves an NLP. Another solve() continues from the last solution.");
  solver
      .def(
          "__init__",
          [](NlpSolver* self) {
            new (self) NlpSolver();
            self->options = startingOptions();
          },
          "Creates a solver without a problem.")
      .def(
          "__init__",
          [](NlpSolver* self, std::shared_ptr<Nlp> problem, int verbose) {
            new (self) NlpSolver(std::move(problem), verbose);
            self->options = startingOptions();
            self->options.verbose = verbose;
          },
          "problem"_a, "verbose"_a = 0, docs::solvers::makeSolver)
      .def(
          "setProblem",
          [](NlpSolver& s, std::shared_ptr<Nlp> p) -> NlpSolver& { return s.setProblem(std::move(p)), s; }, "problem"_a,
          chain, docs::solvers::setProblem)
      .def(
          "setPyProblem",
          [](NlpSolver& s, nb::object p) -> NlpSolver& { return s.setProblem(fromPythonProblem(p)), s; }, "problem"_a,
          chain, docs::solvers::setPyProblem)
      .def("setOptions", setOptions, "options"_a, chain, set_options_doc.c_str())
      .def(
          "setSolver", [](NlpSolver& s, OptMethod method) -> NlpSolver& { return s.options.method = method, s; },
          "method"_a, chain, docs::solvers::setSolver)
      .def(
          "setInitialization",
          [](NlpSolver& s, const Numbers& x) -> NlpSolver& { return s.setInitialization(x.values), s; }, "x"_a, chain,
          docs::solvers::setInitialization)
      .def("setProgress", setProgress, "function"_a.none(), "seconds"_a = .1, chain, docs::solvers::setProgress)
      .def(
          "setTracing",
          [](NlpSolver& s, bool x, bool e, bool phi, bool J) -> NlpSolver& { return s.setTracing(x, e, phi, J), s; },
          "trace_x"_a = true, "trace_errs"_a = true, "trace_phi"_a = false, "trace_J"_a = false, chain,
          docs::solvers::setTracing)
      .def(
          "clearTracing", [](NlpSolver& s) -> NlpSolver& { return s.clearTracing(), s; }, chain,
          "Clears all records. Returns the solver itself.")
      .def("solve", solve, "resampleInitialization"_a = -1, "verbose"_a = -100, docs::solvers::solve)
      .def("getProblem", &NlpSolver::problem, "The problem.")
      .def(
          "getOptions", [](NlpSolver& s) -> SolverOptions& { return s.options; }, nb::rv_policy::reference_internal,
          "The options; changes take effect.")
      .def_prop_rw(
          "x", [](const NlpSolver& s) { return toNumpy(s.x); }, [](NlpSolver& s, const Numbers& x) { s.x = x.values; },
          "The current point, shape (n,).")
      .def_prop_rw(
          "dual", [](const NlpSolver& s) { return toNumpy(s.dual); },
          [](NlpSolver& s, const Numbers& d) { s.dual = d.values; }, "One multiplier per residual, shape (d,).")
      .def("reportLagrangeGradients", gradients, "featureNames"_a = std::vector<std::string>(),
           docs::solvers::reportLagrangeGradients);
  bindTraces(solver);
}

}  // namespace

void bindSolvers(nb::module_& m) {
  bindSolverOptions(m);
  m.def(
      "setDefaultSeed",
      [](std::uint64_t seed) {
        defaults().seed = seed;
        defaults().random = Rng(seed);
      },
      "seed"_a, "Sets the seed of all random numbers.");

  bindResult(m);
  bindSolver(m);
  bindSampler(m);
}

}  // namespace kinegraph::python
