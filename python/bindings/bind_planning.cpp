#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>

#include <algorithm>
#include <chrono>
#include <variant>

#include "bindings.h"
#include "ik_targets.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph::python {

namespace {

using Clock = std::chrono::steady_clock;
using Field = std::variant<double IkOptions::*, int IkOptions::*, bool IkOptions::*, std::uint64_t IkOptions::*>;

struct NamedField {
  const char* name;
  Field field;
  const char* doc;
};

const std::vector<NamedField>& fields() {
  using O = IkOptions;
  static const std::vector<NamedField> list = {
      {"position_tolerance", &O::position_tolerance, "Of every target, m."},
      {"rotation_tolerance", &O::rotation_tolerance, "Of every target, rad."},
      {"attempts", &O::attempts,
       "Starting points at most: the present q, then points within the limits, evenly spread."},
      {"steps", &O::steps, "Of an attempt towards its targets, and again out of collisions."},
      {"best", &O::best, "Makes all attempts and gives the answer nearest to the present q, instead of the first one."},
      {"collisions", &O::collisions, "Keeps the collidable pairs apart."},
      {"margin", &O::margin, "Least distance of these pairs, m."},
      {"start_weight", &O::start_weight, "Of |q - start|^2 in what nearest means."},
      {"home_weight", &O::home_weight, "Of |q - home|^2 in what nearest means."},
      {"seed", &O::seed, "Shifts the sequence of starting points."}};
  return list;
}

void setField(IkOptions& options, const std::string& name, nb::handle value) {
  std::vector<std::string> names = {"tolerance"};
  for (const NamedField& known : fields()) {
    names.push_back(known.name);
    if (name != known.name) continue;
    std::visit(
        [&](auto member) {
          using Type = std::decay_t<decltype(options.*member)>;
          if (!nb::try_cast(value, options.*member)) {
            const char* expected = std::is_same_v<Type, bool>     ? "True or False"
                                   : std::is_same_v<Type, double> ? "a number"
                                                                  : "a whole number";
            throw ValueError(
                cat("solveIk: ", name, " is ", nb::cast<std::string>(nb::repr(value)), "; expected ", expected));
          }
        },
        known.field);
    return;
  }
  if (name != "tolerance")
    throw ValueError(
        cat("solveIk: there is no option '", name, "'; expected one of ", join(names), similarHint(name, names)));
  setField(options, "position_tolerance", value);
  setField(options, "rotation_tolerance", value);
}

void setFields(IkOptions& options, nb::dict given) {
  for (const auto& [name, value] : given) setField(options, nb::cast<std::string>(name), value);
  options.validate();
}

nb::dict toDict(const IkOptions& options) {
  nb::dict dict;
  for (const NamedField& known : fields()) {
    std::visit([&](auto member) { dict[known.name] = nb::cast(options.*member); }, known.field);
  }
  return dict;
}

std::string optionsText(const IkOptions& options) {
  std::vector<std::string> words;
  for (const auto& [name, value] : toDict(options)) {
    words.push_back(cat(nb::cast<std::string>(name), "=", nb::cast<std::string>(nb::repr(value))));
  }
  return cat("IkOptions(", join(words), ")");
}

/// Answers of a batch.
using IkResults = std::vector<IkResult>;

std::string resultText(const IkResult& result) {
  if (!result.feasible()) return cat("<IkResult ", ikStatusName(result.status), ": ", result.message, ">");
  return cat("<IkResult solved in ", result.attempts, result.attempts == 1 ? " attempt" : " attempts", ", within ",
             result.position_error, " m and ", result.rotation_error, " rad>");
}

int countSolved(const IkResults& results) {
  return int(std::ranges::count_if(results, [](const IkResult& result) { return result.feasible(); }));
}

std::string resultsText(const IkResults& results) {
  return cat("<IkResults: ", countSolved(results), " of ", results.size(), " solved>");
}

/// Looks for Ctrl-C, and draws how far it is, while a search runs without the interpreter lock.
class Watch {
 public:
  Watch(std::size_t total, int verbose) : total_(total), verbose_(verbose), start_(Clock::now()) {}

  bool operator()(int done) {
    if (check_() && verbose_ > 0 && total_ > 1 && seconds() > .5) draw(done);
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

/// What type checkers take for anything.
nb::any toAny(nb::object object) { return nb::steal<nb::any>(object.release()); }

nb::any solve(PyConfig& config, nb::handle targets, const std::optional<IkOptions>& given, int threads, int verbose,
              bool apply, nb::kwargs more) {
  IkOptions options = given.value_or(IkOptions());
  setFields(options, more);
  const IkRequest request = readIkTargets(config, targets);
  if (apply && request.is_batch)
    throw ValueError(cat("solveIk: apply is for one problem; the targets are of ", request.problems.size()));
  const IkSolver solver(config, request.problems[0], options);
  Watch watch(request.problems.size(), verbose);
  IkResults results;
  {
    const nb::gil_scoped_release unlock;
    results = solver.solve(request.problems, threads, std::ref(watch));
    watch.finish();
  }
  if (verbose > 0)
    nb::print(
        cat("solveIk: ", request.is_batch ? resultsText(results) : resultText(results[0]), " ", watch.seconds(), " s")
            .c_str());
  if (request.is_batch) return toAny(nb::cast(std::move(results)));
  if (apply && results[0].feasible()) config.setJointState(results[0].q);
  return toAny(nb::cast(std::move(results[0])));
}

template <class Read>
nb::any column(const IkResults& results, const char* dtype, Read read) {
  NewArray array = newArray(results.size());
  for (std::size_t i = 0; i < results.size(); ++i) array.data[i] = double(read(results[i]));
  return toAny(array.array.attr("astype")(dtype));
}

Array allJoints(const IkResults& results) {
  const std::size_t n = results.empty() ? 0 : std::size_t(results[0].q.size());
  NewArray array = newArray(results.size(), n);
  for (std::size_t i = 0; i < results.size(); ++i) std::copy_n(results[i].q.data(), n, array.data + i * n);
  return array.array;
}

nb::tuple resultState(const IkResult& r) {
  return nb::make_tuple(toNumpy(r.q), int(r.status), r.position_error, r.rotation_error, r.penetration, r.attempts,
                        r.evals, r.message);
}

IkResult resultFrom(nb::tuple state) {
  return {nb::cast<Numbers>(state[0]).values,
          IkStatus(nb::cast<int>(state[1])),
          nb::cast<double>(state[2]),
          nb::cast<double>(state[3]),
          nb::cast<double>(state[4]),
          nb::cast<int>(state[5]),
          nb::cast<int>(state[6]),
          nb::cast<std::string>(state[7])};
}

const IkResult& resultAt(const IkResults& results, std::ptrdiff_t index) {
  const std::ptrdiff_t at = index < 0 ? index + std::ptrdiff_t(results.size()) : index;
  if (at < 0 || at >= std::ptrdiff_t(results.size()))
    throw nb::index_error(cat("result ", index, " of ", results.size()).c_str());
  return results[at];
}

void bindOptions(nb::module_& m) {
  nb::class_<IkOptions> options(
      m, "IkOptions", "Settings of solveIk; every field can be given by name. tolerance sets both tolerances.");
  options
      .def(
          "__init__",
          [](IkOptions* self, nb::kwargs given) {
            IkOptions made;
            setFields(made, given);
            new (self) IkOptions(made);
          },
          "fields"_a)
      .def("dict", toDict, "All settings as a dict.")
      .def(
          "__eq__",
          [](const IkOptions& a, nb::handle b) {
            return nb::isinstance<IkOptions>(b) && toDict(a).equal(toDict(nb::cast<const IkOptions&>(b)));
          },
          "other"_a)
      .def("__repr__", optionsText)
      .def("__getstate__", toDict)
      .def(
          "__setstate__",
          [](IkOptions& self, nb::dict state) {
            new (&self) IkOptions();
            setFields(self, state);
          },
          "state"_a);
  for (const NamedField& known : fields()) {
    options.def_prop_rw(
        known.name, [name = known.name](const IkOptions& o) -> nb::any { return toAny(toDict(o)[name]); },
        [name = known.name](IkOptions& o, nb::any value) {
          IkOptions changed = o;
          setField(changed, name, value);
          changed.validate();
          o = changed;
        },
        known.doc);
  }
}

void bindResults(nb::module_& m) {
  nb::enum_<IkStatus>(m, "IkStatus", "How solveIk ended.")
      .value("solved", IkStatus::solved, "All targets within tolerance, no pair nearer than the margin.")
      .value("unreached", IkStatus::unreached, "The nearest attempt misses a target.")
      .value("colliding", IkStatus::colliding, "The nearest attempt meets its targets in collision.")
      .value("cancelled", IkStatus::cancelled, "Before there was an answer.");
  nb::class_<IkResult>(m, "IkResult", "What solveIk found.")
      .def_prop_ro(
          "q", [](const IkResult& r) { return toNumpy(r.q); },
          "The answer (n,), or the attempt that missed least; within the limits.")
      .def_prop_ro("feasible", &IkResult::feasible, "There is an answer.")
      .def_ro("status", &IkResult::status, "How it ended, an IkStatus.")
      .def_ro("message", &IkResult::message,
              "\"\" if solved; else what misses its target by how much, and what is in the way.")
      .def_ro("position_error", &IkResult::position_error, "Of the worst target, m.")
      .def_ro("rotation_error", &IkResult::rotation_error, "Of the worst target, rad.")
      .def_ro("penetration", &IkResult::penetration, "By which the worst pair is nearer than the margin, m.")
      .def_ro("attempts", &IkResult::attempts, "Starting points used.")
      .def_ro("evals", &IkResult::evals, "Evaluations of the kinematics.")
      .def("__bool__", &IkResult::feasible)
      .def("__repr__", resultText)
      .def("__getstate__", resultState)
      .def(
          "__setstate__", [](IkResult& self, nb::tuple state) { new (&self) IkResult(resultFrom(state)); }, "state"_a);
  nb::class_<IkResults>(m, "IkResults", "What solveIk found for N problems. results[i] is the i-th IkResult.")
      .def_prop_ro("q", allJoints, "The answers (N, n).")
      .def_prop_ro(
          "feasible",
          [](const IkResults& r) { return column(r, "bool", [](const IkResult& i) { return i.feasible(); }); },
          "There is an answer: (N,) bool.")
      .def_prop_ro(
          "position_error",
          [](const IkResults& r) { return column(r, "float64", [](const IkResult& i) { return i.position_error; }); },
          "Of the worst target, m: (N,).")
      .def_prop_ro(
          "rotation_error",
          [](const IkResults& r) { return column(r, "float64", [](const IkResult& i) { return i.rotation_error; }); },
          "Of the worst target, rad: (N,).")
      .def_prop_ro(
          "penetration",
          [](const IkResults& r) { return column(r, "float64", [](const IkResult& i) { return i.penetration; }); },
          "By which the worst pair is nearer than the margin, m: (N,).")
      .def_prop_ro(
          "attempts",
          [](const IkResults& r) { return column(r, "int64", [](const IkResult& i) { return i.attempts; }); },
          "Starting points used: (N,).")
      .def_prop_ro(
          "evals", [](const IkResults& r) { return column(r, "int64", [](const IkResult& i) { return i.evals; }); },
          "Evaluations of the kinematics: (N,).")
      .def_prop_ro(
          "message",
          [](const IkResults& r) {
            nb::typed<nb::list, nb::str> messages;
            for (const IkResult& result : r) messages.append(result.message);
            return messages;
          },
          "One line per problem; \"\" where it is solved.")
      .def("__len__", [](const IkResults& r) { return r.size(); })
      .def("__getitem__", resultAt, "index"_a, nb::rv_policy::copy)
      .def("__repr__", resultsText)
      .def("__getstate__",
           [](const IkResults& r) {
             nb::list states;
             for (const IkResult& result : r) states.append(resultState(result));
             return states;
           })
      .def(
          "__setstate__",
          [](IkResults& self, nb::list states) {
            new (&self) IkResults();
            for (nb::handle state : states) self.push_back(resultFrom(nb::cast<nb::tuple>(state)));
          },
          "state"_a);
}

}  // namespace

void bindPlanning(nb::module_& m) {
  bindOptions(m);
  bindResults(m);
  m.def("solveIk", solve, "config"_a, "targets"_a, "options"_a = nb::none(), nb::kw_only(), "threads"_a = 1,
        "verbose"_a = 0, "apply"_a = false, "fields"_a,
        "Joint values within their limits that bring frames to their targets, without collisions.\n\n"
        "The first attempt starts at the present q, the others at points spread within the limits. The configuration "
        "stays as it\n"
        "is, unless apply is True and there is an answer. The same arguments give the same answer, with any number of "
        "threads.\n\n"
        "Args:\n"
        "    config: The scene.\n"
        "    targets: A dict from frames to where they are to be, in world coordinates (m): a position (3,), a pose "
        "(7,) =\n"
        "        x y z qw qx qy qz or (4, 4), the name of a frame or a Frame that has the pose; or a dict of position, "
        "pose,\n"
        "        quaternion, and directions of the frame's axes x, y, z. With rows (N, ...) there are N problems.\n"
        "    options: IkOptions, or None for the defaults.\n"
        "    threads: That share the problems of a batch.\n"
        "    verbose: 1 prints a line at the end, and a progress bar on the way if it takes long.\n"
        "    apply: Sets the configuration's q to the answer.\n"
        "    fields: Any field of IkOptions by name, such as best=True, collisions=False, margin=.02, attempts=20; "
        "tolerance\n"
        "        sets position_tolerance (m) and rotation_tolerance (rad).\n"
        "Returns:\n"
        "    IkResult, or IkResults for N problems. No answer is an outcome: result.feasible is False, and "
        "result.message says\n"
        "    what misses its target by how much, and which limits and pairs are in the way.\n"
        "Raises:\n"
        "    FrameNotFound: A name that is not in the scene.\n"
        "    ArgumentError: Targets of a wrong shape, or that no active joint moves; an unknown option.");
}

}  // namespace kinegraph::python
