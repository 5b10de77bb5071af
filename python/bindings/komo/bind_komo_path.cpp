#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/sub_problem.h"
#include "komo/komo_path_docs.h"
#include "komo/py_komo.h"

namespace kinegraph::python {

namespace {

nb::typed<nb::list, Attributes> forceInteractions(const PyKomo& komo) {
  nb::typed<nb::list, Attributes> list;
  for (const Interaction& interaction : komo.interactions()) {
    nb::dict entry;
    entry["slice"] = interaction.slice;
    entry["onto"] = interaction.object;
    entry["from"] = interaction.from;
    entry["poa"] = toNumpy(VectorXd(interaction.point));
    entry["force"] = toNumpy(VectorXd(interaction.force));
    entry["torque"] = toNumpy(VectorXd(VectorXd::Zero(3)));
    list.append(entry);
  }
  return list;
}

Array pathFrames(const PyKomo& komo) {
  komo.path().requireBuilt("getPathFrames");
  nb::list slices;
  for (int t = 0; t < komo.slices(); ++t) slices.append(toNumpy(komo.getFrameState(t)));
  return Array(nb::module_::import_("numpy").attr("stack")(slices));
}

nb::typed<nb::list, Array> ownDofs(const PyKomo& komo) {
  nb::list slices;
  for (int t = 0; t < komo.slices(); ++t) slices.append(toNumpy(komo.path().ownDofs(t)));
  return slices;
}

nb::typed<nb::tuple, PyConfig, Array, Array> subProblem(const PyKomo& komo, int phase) {
  SubProblem sub = kinegraph::subProblem(komo.path(), phase);
  return nb::make_tuple(PyConfig{std::move(sub.config), nullptr}, toNumpy(sub.start), toNumpy(sub.end));
}

std::vector<PathContact> checkMotion(const PyKomo& komo, double margin, double tolerance) {
  const nb::gil_scoped_release unlock;
  return komo.checkMotion(margin, tolerance, CheckInterrupts());
}

void bindPathContact(nb::module_& m) {
  nb::class_<PathContact>(m, "PathContact", "Two shapes that come too close in the motion between two slices.")
      .def_ro("slice", &PathContact::slice, "The last slice of the motion.")
      .def_ro("time", &PathContact::time, "Phase time at which they first come too close.")
      .def_prop_ro(
          "frames", [](const PathContact& c) { return std::pair(c.a, c.b); }, "Names of their frames.")
      .def_ro("distance", &PathContact::distance, "Smallest distance until the slice, m; negative: penetration depth.")
      .def_ro("deepest", &PathContact::deepest, "Phase time of the smallest distance.")
      .def("__str__", &PathContact::str)
      .def("__repr__", [](const PathContact& c) { return cat("<PathContact: ", c.str(), ">"); });
}

/// Accepts a sequence of vectors, an array with one waypoint per row, or an array of arrays.
std::vector<int> initWithWaypoints(PyKomo& komo, nb::iterable waypoints, int per_phase, bool interpolate,
                                   double towards_home, int) {
  std::vector<VectorXd> list;
  for (nb::handle waypoint : waypoints) list.push_back(nb::cast<Numbers>(waypoint).values);
  return komo.setWaypoints(list, {per_phase, interpolate, towards_home});
}

}  // namespace

void bindKomoPath(nb::module_& m, nb::class_<PyKomo>& komo) {
  bindPathContact(m);
  komo.def("getT", &Komo::slices, "Returns the number T of slices.")
      .def(
          "getPath", [](const PyKomo& k, const std::vector<int>& frames) { return toNumpy(k.getPath(frames)); },
          "dofIndices"_a = std::vector<int>(), docs::komo_path::getPath)
      .def("getPath_qAll", ownDofs,
           "Returns a vector per slice, shape (k,): the dofs that belong to it, including those of mode switches.")
      .def(
          "getPathTau", [](const PyKomo& k) { return toNumpy(VectorXd(VectorXd::Constant(k.slices(), k.tau()))); },
          "Returns the duration of each slice, shape (T,), s.")
      .def("getPathFrames", pathFrames,
           "Returns world poses of all frames in all slices, shape (T, frames, 7): x y z (m) qw qx qy qz.")
      .def(
          "getFrameState", [](const PyKomo& k, int t) { return toNumpy(k.getFrameState(t)); }, "t"_a,
          docs::komo_path::getFrameState)
      .def(
          "getFrame",
          [](const PyKomo& k, const std::string& name, double time) {
            return k.configuration(k.path().grid().sliceAt(time)).getFrame(name);
          },
          "frameName"_a, "phaseTime"_a, docs::komo_path::getFrame)
      .def(
          "getConfig",
          [](const PyKomo& k) {
            return PyConfig{k.configuration(-k.order()), nullptr};
          },
          "Returns a copy of the scene before the path, including added frames.")
      .def(
          "getConfiguration",
          [](const PyKomo& k, int t) {
            return PyConfig{k.configuration(t), nullptr};
          },
          "t"_a, docs::komo_path::getConfiguration)
      .def("getSubProblem", subProblem, "phase"_a, docs::komo_path::getSubProblem)
      .def("checkMotion", checkMotion, "margin"_a = 0., "tolerance"_a = 1e-5, docs::komo_path::checkMotion)
      .def(
          "isFree", [](const PyKomo& k, double margin) { return checkMotion(k, margin, 1e-5).empty(); },
          "margin"_a = 0., docs::komo_path::isFree)
      .def("getForceInteractions", forceInteractions, docs::komo_path::getForceInteractions)
      .def(
          "initWithConstant", [](PyKomo& k, const Numbers& q) { k.setConstantPath(q.values); }, "q"_a,
          docs::komo_path::initWithConstant)
      .def(
          "setConfigurations", [](PyKomo& k, const PyConfig& config) { k.setConstantPath(config.getJointState()); },
          "config"_a, docs::komo_path::setConfigurations)
      .def(
          "initWithPath", [](PyKomo& k, const Numbers& q) { k.setPath(q.matrix()); }, "q"_a,
          docs::komo_path::initWithPath)
      .def("initWithWaypoints", initWithWaypoints, "waypoints"_a, "waypointSlicesPerPhase"_a = 1,
           "interpolate"_a = false, "qHomeInterpolate"_a = 0., "verbose"_a = -1, docs::komo_path::initWithWaypoints)
      .def(
          "initPhaseWithDofsPath",
          [](PyKomo& k, int phase, const std::vector<int>& dofs, const Numbers& path, bool resample) {
            k.setPhasePath(phase, dofs, path.matrix(), resample);
          },
          "t_phase"_a, "dofIDs"_a, "path"_a, "autoResamplePath"_a = false, docs::komo_path::initPhaseWithDofsPath)
      .def(
          "initRandom", [](PyKomo& k, int) { k.setRandomPath(defaults().random); }, "verbose"_a = 0,
          docs::komo_path::initRandom)
      .def(
          "initOrg", [](PyKomo& k) { k.resetPath(); }, "Starts with the given scene in all slices.")
      .def(
          "updateRootObjects", [](PyKomo& k, const PyConfig& config) { k.updateRootObjects(config); }, "config"_a,
          docs::komo_path::updateRootObjects);
}

}  // namespace kinegraph::python
