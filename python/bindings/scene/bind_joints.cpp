#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/kinematics/unit_guesses.h"
#include "kinegraph/scene/dynamics.h"
#include "scene/joints_docs.h"

namespace kinegraph::python {

namespace {

using Names = std::vector<std::string>;

void setJointState(PyConfig& config, const NumbersView& q, const std::optional<std::vector<std::string>>& joints) {
  if (q.rank == 0 && config.getJointDimension() != 1) {
    throw ValueError(
        cat("setJointState: got a single number; the configuration has ", config.getJointDimension(), " dofs"));
  }
  config.joints = q.values;
  joints && !joints->empty() ? config.setJointState(config.joints, *joints) : config.setJointState(config.joints);
  if (looksLikeDegrees(*config.model(), config.joints))
    emitWarning(
        "setJointState: q is beyond the limits; did you mean radians? The values times pi/180 are within the limits");
}

/// Names of q, followed by those of mimicking joints: the reference lists them, but they have no entry in q.
std::vector<std::string> jointNames(const PyConfig& config) {
  std::vector<std::string> names = config.getJointNames();
  for (const Frame& joint : config.getJoints()) {
    if (!joint.data().joint->mimic) continue;
    const Eigen::Index dofs = joint.getJointState().size();
    for (Eigen::Index i = 0; i < dofs; ++i) names.push_back(dofs == 1 ? joint.getName() : cat(joint.getName(), ":", i));
  }
  return names;
}

}  // namespace

void bindJoints(nb::class_<PyConfig>& config) {
  config
      .def(
          "getJoints", [](PyConfig& c) { return c.getJoints(); },
          "Returns the frames whose joint is active and has dofs.")
      .def("getJointNames", jointNames, docs::joints::getJointNames)
      .def("getJointIDs", &PyConfig::getJointIDs, "Returns the ids of the frames with active joints.")
      .def(
          "getJointDimension",
          [](const PyConfig& c) { return c.getJointState().size(); },  // avoids compiling the model
          "Returns the number n of active dofs, the length of q.")
      .def(
          "getJointState",
          [](const PyConfig& c, const std::optional<Names>& names) {
            return toNumpy(names ? c.getJointState(*names) : c.getJointState());
          },
          "joints"_a = nb::none(), docs::joints::getJointState)
      .def("setJointState", setJointState, "q"_a, "joints"_a = nb::none(), docs::joints::setJointState)
      .def(
          "setRandom", [](PyConfig& c, int, int) { c.setRandom(defaults().random); }, "timeSlices_d1"_a = 0,
          "verbose"_a = 0, docs::joints::setRandom)
      .def(
          "getJointLimits", [](const PyConfig& c) { return toNumpy(c.getJointLimits()); },
          "Returns the lower and upper limits, shape (2, n), rad or m; -inf and inf for a dof without limits.")
      .def(
          "getVelocityLimits", [](const PyConfig& c) { return toNumpy(getVelocityLimits(c)); },
          "Returns the velocity limit of each dof of q, shape (n,), rad/s or m/s; inf if none is given (ctrl_limits, "
          "URDF).")
      .def(
          "getEffortLimits", [](const PyConfig& c) { return toNumpy(getEffortLimits(c)); },
          "Returns the force or torque limit of each dof of q, shape (n,), N or Nm; inf if none is given.")
      .def(
          "selectJoints", [](PyConfig& c, const Names& names, bool not_those) { c.selectJoints(names, not_those); },
          "jointNames"_a, "notThose"_a = false, docs::joints::selectJoints);
  config
      .def(
          "getStateNames",
          [](const PyConfig& c, const std::optional<std::string>& group) {
            return c.getStateNames(group.value_or(""));
          },
          "group"_a = nb::none(), docs::joints::getStateNames)
      .def(
          "getNamedState",
          [](const PyConfig& c, const std::string& name, const std::optional<std::string>& group) {
            return toNumpy(c.getNamedState(name, group.value_or("")));
          },
          "name"_a, "group"_a = nb::none(), docs::joints::getNamedState)
      .def(
          "getJointGroups",
          [](const PyConfig& c) {
            nb::typed<nb::dict, nb::str, Names> groups;
            for (const auto& [name, joints] : c.getJointGroups()) groups[nb::cast(name)] = nb::cast(joints);
            return groups;
          },
          docs::joints::getJointGroups);
}

}  // namespace kinegraph::python
