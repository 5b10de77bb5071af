#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "defaults.h"
#include "kinegraph/common/log.h"
#include "kinegraph/planning/path_finder.h"
#include "option_class.h"
#include "planning/path_finder_docs.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

/// A result whose x is a path.
struct PathResult : SolverResult {
  Eigen::Index rows = 0;
};

/// The finder, with a reference to the scene that it reads.
struct PyPathFinder : PathFinder {
  nb::object scene;
};

const OptionClass<PathFinderOptions>& finderOptionClass() {
  static const OptionClass<PathFinderOptions> options(pathFinderOptionTable());
  return options;
}

/// Options by place are those of the reference, in the order of the table.
PyPathFinder& setOptions(PyPathFinder& finder, nb::args by_place, nb::kwargs values) {
  const auto& rows = pathFinderOptionTable().rows();
  if (by_place.size() > rows.size())
    throw ValueError(cat("setOptions: ", by_place.size(), " values; expected at most ", rows.size()));
  for (std::size_t i = 0; i < by_place.size(); ++i) {
    const std::string name = rows[i].name;
    if (values.contains(name.c_str())) throw ValueError(cat("setOptions: ", name, " is given twice"));
    values[name.c_str()] = by_place[i];
  }
  PathFinderOptions options = finder.options();
  finderOptionClass().setFields(options, values);
  finder.setOptions(options);
  return finder;
}

/// One joint vector, flat or the only row of a nested list.
VectorXd oneState(const Numbers& state, const char* what) {
  if (state.rank == 1 || (state.rank == 2 && state.rows == 1)) return state.values;
  throw ValueError(cat("setStartGoal: ", what,
                       state.rank == 2 ? cat(" has ", state.rows, " rows") : " is no joint vector",
                       "; expected one joint vector, (n,) or (1, n)"));
}

PyPathFinder& setStartGoal(PyPathFinder& finder, const Numbers& start, const Numbers& goal) {
  finder.setStartGoal(oneState(start, "starts"), oneState(goal, "goals"));
  return finder;
}

PyPathFinder& setProblem(PyPathFinder& finder, nb::object scene, const std::optional<Numbers>& start,
                         const std::optional<Numbers>& goal) {
  if (start.has_value() != goal.has_value())
    throw ValueError(cat("setProblem: only ", start ? "q0" : "qT", " was passed; expected both q0 and qT, or none"));
  finder.setProblem(nb::cast<const PyConfig&>(scene));
  finder.scene = scene;
  return start ? setStartGoal(finder, *start, *goal) : finder;
}

PyPathFinder& setPairs(PyPathFinder& finder, const std::vector<std::string>& names) {
  if (names.size() % 2 != 0)
    throw ValueError(cat("setExplicitCollisionPairs: there are ", names.size(), " names; expected two for each pair"));
  std::vector<std::pair<std::string, std::string>> pairs;
  for (std::size_t i = 0; i + 1 < names.size(); i += 2) pairs.emplace_back(names[i], names[i + 1]);
  finder.setExplicitCollisionPairs(std::move(pairs));
  return finder;
}

int viewFinder(PyPathFinder& finder, bool pause, const std::optional<std::string>& message, bool) {
  if (finder.path().rows() == 0) throw ValueError("PathFinder.view: there is no path; call solve first");
  const double seconds = std::max(1., .05 * double(finder.path().rows()));
  return nb::cast<int>(finder.scene.attr("view_path")(toNumpy(finder.path()), seconds, pause, message));
}

PathResult solve(PyPathFinder& finder, int verbose) {
  PathResult result;
  const std::uint64_t seed = defaults().seed;
  {
    const nb::gil_scoped_release unlock;
    static_cast<SolverResult&>(result) = finder.solve(seed, CheckInterrupts());
    result.rows = finder.path().rows();
  }
  if (const std::string warning = finder.takeWarning(); !warning.empty()) emitWarning(warning);
  verbose = std::max(verbose, finder.options().verbose);
  if (verbose > 0)
    logMessage(LogLevel::info, cat("RRT_PathFinder: ",
                                   result.feasible ? cat("path of ", finder.path().rows(), " configurations, ") : "",
                                   inPython(result.message), ", ", result.evals, " samples, ", result.time, " s"));
  if (verbose > 1 && result.feasible) viewFinder(finder, true, result.message, true);
  return result;
}

}  // namespace

void bindPathFinder(nb::module_& m) {
  using Finder = PyPathFinder;
  nb::class_<PathResult, SolverResult>(m, "PathReturn", "The outcome of a path search.")
      .def_prop_ro(
          "x",
          [](const PathResult& r) {
            const Eigen::Index columns = r.rows > 0 ? r.x.size() / r.rows : 0;
            const NewArray path = newArray(std::size_t(r.rows), std::size_t(columns));
            std::copy_n(r.x.data(), r.x.size(), path.data);
            return path.array;
          },
          "The path, shape (K, n), rad or m; (0, 0) if there is none.")
      .def_prop_ro(
          "feasible", [](const PathResult& r) { return r.feasible; },
          "There is a path; it is continuously collision-free: no pair penetrates by more than collisionTolerance.")
      .def("__getstate__",
           [](const PathResult& r) {
             const SolverResult base = r;
             return nb::make_tuple(nb::cast(base).attr("__getstate__")(), std::int64_t(r.rows));
           })
      .def(
          "__setstate__",
          [](PathResult& r, nb::tuple state) {
            const nb::object base = nb::inst_alloc(nb::type<SolverResult>());
            base.attr("__setstate__")(state[0]);
            new (&r) PathResult{nb::cast<SolverResult>(base), Eigen::Index(nb::cast<std::int64_t>(state[1]))};
          },
          "state"_a);
  nb::class_<Finder>(m, "RRT_PathFinder", docs::path_finder::type)
      .def(nb::init<>(), docs::path_finder::make)
      .def("setOptions", setOptions, "by_place"_a, "options"_a, kChain, docs::path_finder::setOptions)
      .def("setProblem", setProblem, "Configuration"_a, "q0"_a = nb::none(), "qT"_a = nb::none(), kChain,
           nb::sig("def setProblem(self, Configuration: Config, q0: numpy.typing.ArrayLike | None = None, qT: "
                   "numpy.typing.ArrayLike | None = None) -> RRT_PathFinder"),
           docs::path_finder::setProblem)
      .def("setStartGoal", setStartGoal, "starts"_a, "goals"_a, kChain, docs::path_finder::setStartGoal)
      .def("setExplicitCollisionPairs", setPairs, "collisionPairs"_a, kChain,
           docs::path_finder::setExplicitCollisionPairs)
      .def("solve", solve, "verbose"_a = 1, docs::path_finder::solve)
      .def(
          "get_resampledPath", [](const Finder& f, int T) { return toNumpy(f.get_resampledPath(T)); }, "T"_a,
          docs::path_finder::getResampledPath)
      .def("view", viewFinder, "pause"_a, "message"_a = nb::none(), "play"_a = false, docs::path_finder::view);
}

}  // namespace kinegraph::python
