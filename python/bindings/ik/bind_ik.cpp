#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include "arguments.h"
#include "bindings.h"
#include "ik/ik_docs.h"
#include "ik/ik_objects.h"
#include "ik/ik_targets.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/log.h"
#include "kinegraph/common/text.h"
#include "progress_bar.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

/// The starting points of the problems: one for all, or one per problem.
std::vector<VectorXd> startsOf(const Numbers& start, std::size_t problems, int dofs) {
  const MatrixXd rows = start.rank < 2 ? MatrixXd(start.values.transpose()) : start.matrix();
  if (rows.cols() != dofs || (rows.rows() != 1 && std::size_t(rows.rows()) != problems))
    throw ValueError(cat("solveIk: start has shape (", rows.rows(), ", ", rows.cols(), "); expected (", dofs, ",) or (",
                         problems, ", ", dofs, "), a configuration per problem"));
  std::vector<VectorXd> starts;
  for (std::size_t i = 0; i < problems; ++i)
    starts.push_back(rows.row(rows.rows() == 1 ? 0 : Eigen::Index(i)).transpose());
  return starts;
}

nb::object solve(PyConfig& config, nb::handle targets, const std::optional<IkOptions>& base, int threads, int verbose,
                 bool apply, bool all, const std::optional<Numbers>& start, nb::kwargs more) {
  IkOptions options = base.value_or(IkOptions());
  setFields(options, more);
  IkProblems problems = readIkTargets(config, targets);
  if (apply && problems.is_batch)
    throw ValueError(cat("solveIk: apply needs a single problem; the targets define ", problems.problems.size()));
  if (all && problems.is_batch)
    throw ValueError(cat("solveIk: all needs a single problem; the targets define ", problems.problems.size()));
  if (all && start) throw ValueError("solveIk: all finds all solutions, and has no start");
  std::vector<VectorXd> starts;
  if (start) starts = startsOf(*start, problems.problems.size(), config.getJointDimension());
  if (options.collisions) warnOfContacts(config);
  const IkSolver solver(config, problems.problems[0], options);
  ProgressBar bar("solveIk", verbose);
  IkResults results;
  {
    const nb::gil_scoped_release unlock;
    results = all ? solveIkAll(config, problems.problems[0], options, CheckInterrupts())
                  : solver.solve(std::move(problems.problems), threads, std::ref(bar), {}, std::move(starts));
    bar.finish();
  }
  if (verbose > 0)
    logMessage(LogLevel::info,
               cat("solveIk: ", problems.is_batch || all ? resultsText(results) : resultText(results[0]), " ",
                   bar.seconds(), " s"));
  if (!results.empty())  // they do not depend on the numbers of the targets
    for (const std::string& warning : results[0].warnings) emitWarning(cat("solveIk: ", inPython(warning)));
  if (apply && results[0].feasible()) config.setJointState(results[0].q);
  if (problems.is_batch || all) return nb::cast(std::move(results));
  return nb::cast(std::move(results[0]));
}

/// Returns a signature of `solveIk` for type checkers: targets with these types of keys and values, and `apply`, give a
/// `result`.
std::string signature(const std::string& frame, const std::string& target, const std::string& apply,
                      const std::string& all, const std::string& result) {
  return cat("def solveIk(config: Config, targets: collections.abc.Mapping[", frame, ", ", target,
             "], options: IkOptions | None = None, *, threads: int = 1, verbose: int = 0, apply: ", apply,
             ", all: ", all, ", start: numpy.typing.ArrayLike | None = None, **fields: float) -> ", result);
}

/// Binds one function with several signatures: only arrays with several rows make a batch, which rejects `apply`.
void bindSolveIk(nb::module_& m) {
  const auto bind = [&](const std::string& text, const auto&... doc) {
    m.def("solveIk", solve, "config"_a, "targets"_a, "options"_a = nb::none(), nb::kw_only(), "threads"_a = 1,
          "verbose"_a = 0, "apply"_a = false, "all"_a = false, "start"_a = nb::none(), "fields"_a,
          nb::sig(text.c_str()), doc...);
  };
  const std::string numbers = "collections.abc.Sequence[float]", place = cat("str | Frame | ", numbers);
  const std::string target = cat(place, " | collections.abc.Mapping[str, ", place, "]");
  const std::string no = "typing.Literal[False] = False", yes = "typing.Literal[True]", either = "bool = False";
  bind(signature("str", target, either, no, "IkResult"), docs::ik::solveIk);
  bind(signature("Frame", target, either, no, "IkResult"));
  bind(signature("typing.Any", "typing.Any", yes, no, "IkResult"));
  bind(signature("typing.Any", "typing.Any", either, yes, "IkResults"));
  bind(signature("typing.Any", "typing.Any", either, either, "IkResult | IkResults"));
}

}  // namespace

void bindIk(nb::module_& m) {
  bindIkOptions(m);
  bindIkResults(m);
  bindSolveIk(m);
}

}  // namespace kinegraph::python
