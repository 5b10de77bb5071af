#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <chrono>

#include "bindings.h"
#include "ik/ik_docs.h"
#include "ik/ik_objects.h"
#include "ik/ik_targets.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::python {

namespace {

using Clock = std::chrono::steady_clock;

/// Looks for Ctrl-C, and draws how far it is, while a search runs without the interpreter lock.
class Watch {
 public:
  Watch(std::size_t total, int verbose) : total_(total), verbose_(verbose), start_(Clock::now()) {}

  bool operator()(int done) {
    if (check_.checkIfDue() && verbose_ > 0 && total_ > 1 && seconds() > .5) draw(done);
    return false;
  }

  void finish() {
    if (drawn_) draw(int(total_));
  }

  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  void draw(int done) {
    const nb::gil_scoped_acquire lock;
    drawn_ = true;
    nb::module_::import_("kinegraph.progress").attr("drawProgress")("solveIk", done, total_, seconds());
  }

  std::size_t total_;
  int verbose_;
  Clock::time_point start_;
  CheckInterrupts check_;
  bool drawn_ = false;
};

nb::object solve(PyConfig& config, nb::handle targets, const std::optional<IkOptions>& given, int threads, int verbose,
                 bool apply, nb::kwargs more) {
  IkOptions options = given.value_or(IkOptions());
  setFields(options, more);
  IkRequest request = readIkTargets(config, targets);
  if (apply && request.is_batch)
    throw ValueError(cat("solveIk: apply is for one problem; the targets are of ", request.problems.size()));
  if (options.collisions) warnOfContacts(config);
  const IkSolver solver(config, request.problems[0], options);
  Watch watch(request.problems.size(), verbose);
  IkResults results;
  {
    const nb::gil_scoped_release unlock;
    results = solver.solve(std::move(request.problems), threads, std::ref(watch));
    watch.finish();
  }
  if (verbose > 0)
    nb::print(
        cat("solveIk: ", request.is_batch ? resultsText(results) : resultText(results[0]), " ", watch.seconds(), " s")
            .c_str());
  if (request.is_batch) return nb::cast(std::move(results));
  if (apply && results[0].feasible()) config.setJointState(results[0].q);
  return nb::cast(std::move(results[0]));
}

/// What type checkers are told of `solveIk`: targets with such keys and values, and `apply`, give a `result`.
std::string signature(const std::string& frame, const std::string& target, const std::string& apply,
                      const std::string& result) {
  return cat("def solveIk(config: Config, targets: collections.abc.Mapping[", frame, ", ", target,
             "], options: IkOptions | None = None, *, threads: int = 1, verbose: int = 0, apply: ", apply,
             ", **fields: float) -> ", result);
}

/// One function with a signature for each kind of answer: only rows of arrays make a batch, for which `apply` is refused.
void bindSolveIk(nb::module_& m) {
  const auto bind = [&](const std::string& text, const auto&... doc) {
    m.def("solveIk", solve, "config"_a, "targets"_a, "options"_a = nb::none(), nb::kw_only(), "threads"_a = 1,
          "verbose"_a = 0, "apply"_a = false, "fields"_a, nb::sig(text.c_str()), doc...);
  };
  const std::string numbers = "collections.abc.Sequence[float]", place = cat("str | Frame | ", numbers);
  const std::string target = cat(place, " | collections.abc.Mapping[str, ", place, "]");
  bind(signature("str", target, "bool = False", "IkResult"), docs::ik::solveIk);
  bind(signature("Frame", target, "bool = False", "IkResult"));
  bind(signature("typing.Any", "typing.Any", "typing.Literal[True]", "IkResult"));
  bind(signature("typing.Any", "typing.Any", "bool = False", "IkResult | IkResults"));
}

}  // namespace

void bindIk(nb::module_& m) {
  bindIkOptions(m);
  bindIkResults(m);
  bindSolveIk(m);
}

}  // namespace kinegraph::python
