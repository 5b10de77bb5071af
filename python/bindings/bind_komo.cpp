#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "feature_arguments.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/features/registry.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/solvers/result.h"

namespace kinegraph::python {

namespace {

std::vector<double> toTimes(const std::optional<Numbers>& times) { return times ? times->list() : std::vector<double>(); }

void warn(Komo& komo) {
  for (const std::string& warning : komo.takeWarnings()) emitWarning(warning);
}

void addObjective(Komo& komo, const std::optional<Numbers>& times, FeatureSymbol feature, const FrameNames& frames, ObjectiveType type,
                  const std::optional<Numbers>& scale, const std::optional<Numbers>& target, int order) {
  komo.addObjective(toTimes(times), feature, toNames(frames), type, toScale(scale), toTarget(target), order);
  warn(komo);
}

nb::dict report(const Komo& komo) {
  nb::dict out;
  int index = 0;
  for (const Komo::Objective& objective : komo.objectives()) {
    nb::dict entry;
    entry["name"] = objective.residual.name();
    entry["frames"] = objective.frames;
    entry["order"] = objective.residual.order();
    entry["type"] = objectiveTypeName(objective.type);
    entry["scale"] = toNumpy(objective.residual.scale().data(), std::size_t(objective.residual.scale().size()));
    entry["target"] = toNumpy(objective.residual.target());
    entry["times"] = objective.times;
    entry["slices"] = std::vector<int>{objective.from, objective.to};
    out[cat("o", index++).c_str()] = entry;
  }
  return out;
}

std::string explainPath(const std::shared_ptr<Komo>& komo, double tolerance) {
  const auto nlp = makeNlp(komo);
  const MatrixXd path = komo->getPath();
  VectorXd x(path.size()), phi(Eigen::Index(nlp->types().size()));
  Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(x.data(), path.rows(), path.cols()) = path;
  nlp->evaluate(x, phi, nullptr);
  return explain(*nlp, phi, tolerance);
}

}  // namespace

void bindKomo(nb::module_& m) {
  using Optional = const std::optional<Numbers>&;
  nb::class_<Komo>(m, "KOMO", "A motion problem: slices of a configuration, tied together by objectives.")
      .def(nb::init<>(), "An empty problem; call setConfig and setTiming.")
      .def("__init__", [](Komo* self, const PyConfig& config, double phases, int slices, int order, bool) {
             new (self) Komo(config, phases, slices, order);
           }, "config"_a, "phases"_a, "slicesPerPhase"_a, "kOrder"_a, "enableCollisions"_a,
           "phases x slicesPerPhase configurations; features of up to kOrder + 1 consecutive ones. With (1, 1, 0) it is inverse\n"
           "kinematics. Collisions are computed where objectives ask for them, whatever enableCollisions says.")
      .def("setConfig", [](Komo& k, const PyConfig& config, bool) { k.setConfig(config); }, "config"_a, "enableCollisions"_a = false,
           "The configuration that moves.")
      .def("setTiming", [](Komo& k, double phases, int slices, double duration, int order) { k.setTiming(phases, slices, duration, order); },
           "phases"_a, "slicesPerPhase"_a, "durationPerPhase"_a, "kOrder"_a, "The time grid; durations in s.")
      .def("addObjective", addObjective, "times"_a, "feature"_a, "frames"_a, "type"_a, "scale"_a = nb::none(), "target"_a = nb::none(),
           "order"_a = -1,
           "Adds scale * (feature - target) in the slices of `times`: [] all, [t] one, [from, to] both included, in phases.\n"
           "type: OT.sos, OT.eq, OT.ineq or OT.f. scale: a number, one per row, or a matrix. order: of the time derivative.")
      .def("addControlObjective", [](Komo& k, Optional times, int order, double scale, Optional target, int from, int to) {
             k.addControlObjective(toTimes(times), order, scale, toTarget(target), from, to);
             warn(k);
           }, "times"_a, "order"_a, "scale"_a = 1., "target"_a = nb::none(), "deltaFromSlice"_a = 0, "deltaToSlice"_a = 0,
           "Sum of squares of the order-th derivative of all dofs; order 0: of the distance from home.")
      .def("addQuaternionNorms", [](Komo& k, Optional times, double scale, bool hard) { k.addQuaternionNorms(toTimes(times), scale, hard); },
           "times"_a = nb::none(), "scale"_a = 3., "hard"_a = true, "Keeps quaternion dofs at norm one.")
      .def("clearObjectives", &Komo::clearObjectives, "Removes all objectives.")
      .def("nlp", [](std::shared_ptr<Komo> k) { return makeNlp(std::move(k)); },
           "The problem for a solver. It keeps this object alive, which then holds the solution.")
      .def("getT", &Komo::slices, "Number of slices.")
      .def("getPath", [](const Komo& k) { return toNumpy(k.getPath()); }, "(T, n): the joint states of all slices.")
      .def("getPathTau", [](const Komo& k) { return toNumpy(VectorXd(VectorXd::Constant(k.slices(), k.tau()))); }, "(T,): duration of each slice, s.")
      .def("getFrameState", [](const Komo& k, int t) { return toNumpy(k.getFrameState(t)); }, "t"_a,
           "(frames, 7): world poses of all frames in a slice.")
      .def("initWithConstant", [](Komo& k, const Numbers& q) { k.setConstantPath(q.values); }, "q"_a, "Starts with q in all slices.")
      .def("initWithPath", [](Komo& k, const Numbers& q) { k.setPath(q.matrix()); }, "q"_a, "Starts with a path (T, n).")
      .def("updateRootObjects", [](Komo& k, const PyConfig& config) { k.updateRootObjects(config); }, "config"_a,
           "Takes over the constant poses of the configuration; the path stays, for a warm start.")
      .def("report", [](const Komo& k, bool, bool, bool, bool) { return report(k); }, "specs"_a = false, "listObjectives"_a = true,
           "plotOverTime"_a = false, "sortByError"_a = true, "The objectives as a dict.")
      .def("explain", explainPath, "tolerance"_a = 1e-3, "In words: which constraints the present path violates, the worst first.")
      .def("__repr__", [](const Komo& k) {
        return cat("<KOMO: ", k.slices(), " slices, order ", k.order(), ", ", k.objectives().size(), " objectives>");
      });
}

}  // namespace kinegraph::python
