#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <deque>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/stopwatch.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "komo/py_komo.h"
#include "python_names.h"
#include "solvers/nlp_objects.h"
#include "solvers/solve_many_docs.h"
#include "solvers/solving.h"

namespace kinegraph::python {

namespace {

/// Draws a progress bar and checks for Ctrl-C, on the calling thread, while problems are solved.
class SolveManyMonitor {
 public:
  SolveManyMonitor(const char* what, std::size_t total, int verbose)
      : what_(what), total_(int(total)), verbose_(verbose) {}

  ProgressCallback progress() {
    return [this](const Progress& progress) {
      if (verbose_ > 0 && stopwatch_.seconds() > .5) callUser([&] { draw(progress.done); });
    };
  }
  CancellationToken cancellation() {
    return [this] { return here_.pressedCtrlC(); };
  }

  /// Marks the results that Ctrl-C interrupted and prints a summary. Needs the interpreter lock.
  void finish(SolveManyResult& all) {
    int done = 0, feasible = 0;
    for (SolverResult& result : all.results) {
      if (here_.wasPressed() && result.done && result.status == SolverStatus::cancelled) markInterrupted(result);
      done += result.done;
      feasible += result.feasible;
    }
    if (drawn_) draw(here_.wasPressed() ? done : total_);
    if (here_.wasPressed() && all.best().x.size() == 0) throwKeyboardInterrupt();
    if (verbose_ < 1) return;
    logMessage(LogLevel::info, cat(what_, ": ", feasible, " of ", done, " are feasible, in ", stopwatch_.seconds(),
                                   " s; the best: ", all.chosen, ", ", inPython(all.best().str())));
  }

 private:
  void draw(int ended) {
    drawn_ = true;
    nb::module_::import_("kinegraph.progress").attr("drawProgress")(what_, ended, total_, stopwatch_.seconds());
  }

  const char* what_;
  int total_, verbose_;
  bool drawn_ = false;
  SolveScope here_;
  Stopwatch stopwatch_;
};

/// Returns start points: the current path and random ones for a number, or those of an array of paths (K, T, n).
std::vector<VectorXd> readStarts(PyKomo& komo, nb::handle given, std::uint64_t seed) {
  if (nb::isinstance<nb::int_>(given)) return sampleStarts(komo, nb::cast<int>(given), seed, CheckInterrupts());
  const int T = komo.slices(), n = komo.dofs();
  const auto expected = [&] {
    return cat("solveFromMany: starts are a number, or paths of shape (K, ", T, ", ", n, ")");
  };
  if (!nb::isinstance<nb::iterable>(given)) throw ValueError(expected());
  const VectorXd before = komo.path().variables();
  std::vector<VectorXd> starts;
  for (nb::handle path : given) {
    Numbers numbers;
    if (!readNumbers(path, numbers) || numbers.rank != 2 || int(numbers.rows) != T || int(numbers.columns()) != n)
      throw ValueError(expected());
    komo.setPath(numbers.matrix());
    starts.push_back(komo.path().variables());
  }
  komo.path().setVariables(before);
  return starts;
}

SolveManyResult solveKomoFromMany(const std::shared_ptr<PyKomo>& komo, nb::handle starts, bool best, int threads,
                                  std::uint64_t seed, int verbose, const SolverOptions* options) {
  if (komo->slices() == 0) throw Error("KOMO: there is no problem yet; call setConfig and setTiming first");
  const std::vector<VectorXd> points = readStarts(*komo, starts, seed);
  SolveManyMonitor monitor("solveFromMany", points.size(), verbose);
  const SolverOptions chosen = options ? *options : startingOptions();
  SolveManyResult all;
  {
    const nb::gil_scoped_release unlock;
    all = solveFromMany(komo, points, chosen, {best, threads}, monitor.progress(), monitor.cancellation());
  }
  monitor.finish(all);
  return all;
}

SolveManyResult solveEach(nb::iterable problems, int threads, bool best, int verbose, const SolverOptions* options) {
  std::deque<NlpSolver> made;
  std::vector<NlpSolver*> solvers;
  for (nb::handle given : problems) {
    if (nb::isinstance<NlpSolver>(given)) {
      solvers.push_back(&nb::cast<NlpSolver&>(given));
    } else {
      std::shared_ptr<Nlp> nlp;
      if (nb::isinstance<PyKomo>(given)) {
        nlp = makeNlp(nb::cast<std::shared_ptr<PyKomo>>(given));
      } else if (nb::isinstance<Nlp>(given)) {
        nlp = nb::cast<std::shared_ptr<Nlp>>(given);
      } else {
        throw ValueError(cat("solveAll: problem ", solvers.size(), " is a ",
                             nb::cast<std::string>(given.type().attr("__name__")),
                             "; expected a KOMO, an NLP or an NLP_Solver"));
      }
      NlpSolver& solver = made.emplace_back(std::move(nlp), 0);
      solver.options = options ? *options : startingOptions();
      solver.options.verbose = 0;
      solver.keeps_memory = false;  // for the next one
      solvers.push_back(&solver);
    }
    addExternalMethods(*solvers.back());
  }
  // two problems of one KOMO would overwrite the same path
  for (std::size_t i = 0; i < solvers.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const auto komo = solvers[i]->problem() ? komoOf(*solvers[i]->problem()) : nullptr;
      if (!komo || !solvers[j]->problem() || komoOf(*solvers[j]->problem()) != komo) continue;
      throw ValueError(
          cat("solveAll: problems ", j, " and ", i, " belong to the same KOMO; copy.copy(komo) makes another one"));
    }
  }
  SolveManyMonitor monitor("solveAll", solvers.size(), verbose);
  SolveManyResult all;
  {
    const nb::gil_scoped_release unlock;
    all = solveAll(solvers, {best, threads}, defaults().seed, monitor.progress(), monitor.cancellation());
  }
  monitor.finish(all);
  return all;
}

SolverResult resultAt(const SolveManyResult& all, Py_ssize_t i) {
  const auto size = Py_ssize_t(all.results.size());
  if (i < -size || i >= size) throw nb::index_error(cat("result ", i, " of ", size).c_str());
  return all.results[std::size_t(i < 0 ? i + size : i)];
}

}  // namespace

void bindSolveMany(nb::module_& m) {
  nb::class_<SolveManyResult>(m, "SolverReturns",
                              "The results of several problems, or of one problem from several starts.")
      .def_ro("results", &SolveManyResult::results,
              "One SolverReturn per problem; its done is False if an earlier one sufficed or after Ctrl-C.")
      .def_ro("chosen", &SolveManyResult::chosen,
              "Index of the best: feasible before infeasible, then by cost, or by violation.")
      .def_prop_ro(
          "best", [](const SolveManyResult& r) { return r.best(); }, "The best SolverReturn.")
      .def_prop_ro(
          "feasible", [](const SolveManyResult& r) { return r.best().feasible; },
          "Whether the best result is feasible.")
      .def("__bool__", [](const SolveManyResult& r) { return r.best().feasible; })
      .def("__len__", [](const SolveManyResult& r) { return r.results.size(); })
      .def("__getitem__", resultAt, "index"_a)
      .def("__repr__",
           [](const SolveManyResult& r) {
             const auto feasible = std::ranges::count_if(r.results, &SolverResult::feasible);
             return cat("<SolverReturns: ", feasible, " of ", r.results.size(), " feasible; the best: ", r.chosen, ", ",
                        r.best().str(), ">");
           })
      .def("__getstate__", [](const SolveManyResult& r) { return nb::make_tuple(r.results, r.chosen); })
      .def(
          "__setstate__",
          [](SolveManyResult& r, nb::tuple state) {
            new (&r) SolveManyResult{nb::cast<std::vector<SolverResult>>(state[0]), nb::cast<int>(state[1])};
          },
          "state"_a);

  m.def("solveAll", solveEach, "problems"_a, nb::kw_only(), "threads"_a = 1, "best"_a = true, "verbose"_a = 0,
        "options"_a.none() = nb::none(), docs::solve_many::solveAll);

  nb::object komo = nb::borrow(nb::type<PyKomo>());
  nb::setattr(komo, "solveFromMany",
              nb::cpp_function(solveKomoFromMany, nb::is_method(), nb::name("solveFromMany"), nb::scope(komo),
                               "starts"_a = 8, nb::kw_only(), "best"_a = true, "threads"_a = 1, "seed"_a = 0,
                               "verbose"_a = 0, "options"_a.none() = nb::none(), docs::solve_many::solveFromMany));
}

}  // namespace kinegraph::python
