#include "solvers/solving.h"

#include <nanobind/stl/function.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "defaults.h"
#include "kinegraph/common/cancellation_interval.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/solvers/methods/penalty_methods.h"

namespace kinegraph::python {

namespace {

/// Evaluates for an external solver: (phi, J) with a dense J, or False if the solver shall end.
nb::object evaluateFor(Nlp& nlp, const EvaluationCallback& callback, const VectorXd& x, int& evals) {
  VectorXd phi(Eigen::Index(nlp.types().size()));
  Jacobian J = nlp.makeJacobian();
  try {
    nlp.evaluate(x, phi, &J);
  } catch (const EvaluationCancelled&) {
    return nb::bool_(false);
  }
  ++evals;
  if (callback && !callback(x, phi)) return nb::bool_(false);
  if (const std::string what = describeNotFinite(nlp, phi, &J); !what.empty() && evals == 1)
    throw ValueError(cat("at the start, ", what));
  return nb::make_tuple(toNumpy(phi), toNumpy(J.toDense()));
}

SolverResult solveOutside(const char* name, Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                          const EvaluationCallback& callback) {
  const nb::gil_scoped_acquire lock;
  SolverResult out;
  nb::dict problem;
  problem["types"] = nlp.types();
  problem["lower"] = toNumpy(nlp.lower());
  problem["upper"] = toNumpy(nlp.upper());
  problem["x0"] = toNumpy(VectorXd(x0.cwiseMax(nlp.lower()).cwiseMin(nlp.upper())));
  problem["evaluate"] =
      nb::cpp_function([&](const Numbers& x) { return evaluateFor(nlp, callback, x.values, out.evals); });
  problem["tolerance"] = options.stopTolerance;
  problem["constraint_tolerance"] = options.constraintTolerance();
  problem["max_evals"] = options.stopEvals;
  problem["verbose"] = options.verbose;
  nb::object answer;
  try {
    answer = nb::module_::import_("kinegraph.external_solvers").attr(name)(problem);
  } catch (nb::python_error& error) {
    SolveScope* const here = SolveScope::current();
    if (!here || !here->isPressedBy(error)) throw;
    throw EvaluationCancelled();
  }
  out.x = nb::cast<Numbers>(answer["x"]).values;
  out.message = nb::cast<std::string>(answer["message"]);
  const std::string status = nb::cast<std::string>(answer["status"]);
  for (SolverStatus s : {SolverStatus::converged, SolverStatus::infeasible, SolverStatus::stalled, SolverStatus::limit,
                         SolverStatus::cancelled}) {
    if (status == solverStatusName(s)) out.status = s;
  }
  out.dual = VectorXd::Zero(Eigen::Index(nlp.types().size()));
  VectorXd phi(out.dual.size());
  nlp.evaluate(out.x, phi, nullptr);
  out.setSums(nlp.types(), phi, options.constraintTolerance());
  return out;
}

/// Whether Ctrl-C was pressed twice within a second, which also ends loops around solves.
bool isSecondPress() {
  using Clock = std::chrono::steady_clock;
  static Clock::time_point last{};  // signals reach the main thread only, which holds the interpreter lock here
  const Clock::time_point before = std::exchange(last, Clock::now());
  return before != Clock::time_point{} && last - before < std::chrono::seconds(1);
}

}  // namespace

SolveScope*& SolveScope::current() {
  thread_local SolveScope* current = nullptr;
  return current;
}

SolveScope::SolveScope() : before_(std::exchange(current(), this)) {}

SolveScope::~SolveScope() { current() = before_; }

bool SolveScope::pressedCtrlC() {
  if (pressed_) return true;
  const nb::gil_scoped_acquire lock;
  if (PyErr_CheckSignals() == 0) return false;
  if (!PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) || isSecondPress()) throw nb::python_error();
  PyErr_Clear();
  return pressed_ = true;
}

bool SolveScope::isPressedBy(const nb::python_error& error) {
  return pressed_ = pressed_ || (error.matches(PyExc_KeyboardInterrupt) && !isSecondPress());
}

bool callUser(const std::function<void()>& call) {
  const nb::gil_scoped_acquire lock;
  struct InUserCode {
    SolveScope* solving = std::exchange(SolveScope::current(), nullptr);
    ~InUserCode() { SolveScope::current() = solving; }
  } here;
  try {
    call();
  } catch (nb::python_error& error) {
    if (!here.solving || !here.solving->isPressedBy(error)) throw;
  }
  return !here.solving || !here.solving->pressedCtrlC();
}

Interruption::~Interruption() {
  if (drawn_at_ == 0.) return;
  const nb::gil_scoped_acquire lock;
  nb::module_::import_("kinegraph.progress").attr("clearLine")();
}

bool Interruption::operator()(const VectorXd&, const VectorXd& phi) {
  if (++evals_ < next_check_) return !here_.wasPressed();
  const auto now = Clock::now();
  next_check_ = evals_ + (now - checked_ < std::chrono::milliseconds(1) ? kSkippedEvals : 1);
  checked_ = now;
  if (now - asked_ < kCancellationInterval) return !here_.wasPressed();
  asked_ = now;
  if (here_.pressedCtrlC()) return false;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  if (verbose_ < 1 || seconds < .5 || seconds - drawn_at_ < .1) return true;
  return callUser([&] { draw(phi, seconds); });
}

void Interruption::draw(const VectorXd& phi, double seconds) {
  drawn_at_ = seconds;
  const ErrorSums sums = sumErrors(nlp_.types(), phi);
  nb::module_::import_("kinegraph.progress")
      .attr("drawSolve")(what_, evals_, sums.f + sums.sos, largestViolation(nlp_.types(), phi), seconds);
}

void throwKeyboardInterrupt() {
  const nb::gil_scoped_acquire lock;
  PyErr_SetNone(PyExc_KeyboardInterrupt);
  throw nb::python_error();
}

SolverResult runInterruptibly(const char* what, const Nlp& nlp, int verbose,
                              const std::function<SolverResult(const EvaluationCallback&)>& run) {
  SolveScope here;
  const nb::gil_scoped_release unlock;
  Interruption interruption(here, what, nlp, verbose);
  try {
    SolverResult result = run(std::ref(interruption));
    if (here.wasPressed()) markInterrupted(result);
    return result;
  } catch (const EvaluationCancelled&) {  // before the first value
    throwKeyboardInterrupt();
  }
  return {};
}

void markInterrupted(SolverResult& result) {
  result.status = SolverStatus::cancelled;
  result.message = "interrupted by Ctrl-C";
}

SolverResult solveInterruptibly(NlpSolver& solver, bool resample) {
  addExternalMethods(solver);
  if (!solver.problem()) throw Error("NLP_Solver: there is no problem to solve; call setProblem first");
  Rng rng(defaults().seed);
  return runInterruptibly("NLP_Solver", *solver.problem(), solver.options.verbose,
                          [&](const EvaluationCallback& callback) { return solver.solve(resample, rng, callback); });
}

Explanation explainInterruptibly(Nlp& nlp, const VectorXd& x, double tolerance) {
  const nb::gil_scoped_release unlock;
  return explain(nlp, x, tolerance, CheckInterrupts());
}

void addExternalMethods(NlpSolver& solver) {
  if (solver.options.method != OptMethod::Ipopt && solver.options.method != OptMethod::NLopt &&
      solver.options.method != OptMethod::slackGN_Ipopt)
    return;
  for (const auto& [method, name] : {std::pair{OptMethod::Ipopt, "ipopt"}, std::pair{OptMethod::NLopt, "nlopt"}}) {
    solver.addMethod(method, [name = name](Nlp& nlp, const VectorXd& x0, const SolverOptions& options,
                                           const EvaluationCallback& callback) {
      return solveOutside(name, nlp, x0, options, callback);
    });
  }
  solver.addMethod(OptMethod::slackGN_Ipopt,
                   [](Nlp& nlp, const VectorXd& x0, const SolverOptions& options, const EvaluationCallback& callback) {
                     const SolverResult first = solveSlack(nlp, x0, options, callback);
                     if (first.status == SolverStatus::cancelled) return first;
                     SolverResult second = solveOutside("ipopt", nlp, first.x, options, callback);
                     second.evals += first.evals;
                     return second;
                   });
}

}  // namespace kinegraph::python
