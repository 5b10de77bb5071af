#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "control/control.h"
#include "control/diff_ik_docs.h"
#include "features/feature_arguments.h"
#include "kinegraph/control/diff_ik.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

VectorXd limitsOf(const std::optional<Numbers>& given, const PyConfig& config) {
  if (!given) return {};
  return given->rank == 0 ? VectorXd::Constant(config.getJointDimension(), given->values[0]) : given->values;
}

void makeDiffIk(DiffIk* self, PyConfig& config, const std::optional<Numbers>& velocity,
                const std::optional<Numbers>& acceleration, double posture, double damping, bool collisions,
                double margin, double collision_gain, double influence_distance) {
  DiffIkOptions options;
  options.velocity = limitsOf(velocity, config);
  options.acceleration = limitsOf(acceleration, config);
  options.posture = posture, options.damping = damping;
  options.collisions = collisions, options.margin = margin;
  options.collision_gain = collision_gain, options.influence_distance = influence_distance;
  warnOfMissingContacts(config);
  new (self) DiffIk(config, options);
}

}  // namespace

void bindDiffIk(nb::module_& m) {
  nb::enum_<DiffIkStatus>(m, "DiffIkStatus", "How a step of DiffIk ended.")
      .value("solved", DiffIkStatus::solved, "All limits, distances and equalities hold.")
      .value("constraints_relaxed", DiffIkStatus::constraints_relaxed, "Some could not hold; the message names them.");
  nb::class_<DiffIk>(
      m, "DiffIk",
      "Differential inverse kinematics: computes joint velocities, step by step, that bring features to their "
      "targets within limits of position, velocity and acceleration, without collisions.")
      .def("__init__", makeDiffIk, "config"_a, "velocity"_a = nb::none(), "acceleration"_a = nb::none(), nb::kw_only(),
           "posture"_a = 1e-4, "damping"_a = 1e-9, "collisions"_a = true, "margin"_a = .01, "collision_gain"_a = .5,
           "influence_distance"_a = .1, docs::diff_ik::make)
      .def(
          "addTask",
          [](DiffIk& ik, const FeatureArgument& feature, const FrameNames& frames, double weight, double gain,
             const std::optional<Numbers>& target, int priority) {
            return ik.addTask(feature.source(), toNames(frames), weight, gain, toTarget(target), priority);
          },
          "feature"_a, "frames"_a, "weight"_a = 1., "gain"_a = 1., "target"_a = nb::none(), "priority"_a = 0,
          docs::diff_ik::addTask)
      .def(
          "addEquality",
          [](DiffIk& ik, const FeatureArgument& feature, const FrameNames& frames, double gain,
             const std::optional<Numbers>& target) {
            return ik.addEquality(feature.source(), toNames(frames), gain, toTarget(target));
          },
          "feature"_a, "frames"_a, "gain"_a = 1., "target"_a = nb::none(), docs::diff_ik::addEquality)
      .def(
          "setTarget", [](DiffIk& ik, int task, const Numbers& target) { ik.setTarget(task, target.values); }, "task"_a,
          "target"_a, docs::diff_ik::setTarget)
      .def(
          "setPosture", [](DiffIk& ik, const Numbers& q) { ik.setPosture(q.values); }, "q"_a, docs::diff_ik::setPosture)
      .def(
          "step", [](DiffIk& ik, double dt, bool apply) { return toNumpy(ik.step(dt, apply)); }, "dt"_a,
          "apply"_a = true, docs::diff_ik::step)
      .def("reset", &DiffIk::reset,
           "Sets the velocity to zero that the next acceleration starts from, and ends the damping of joints.")
      .def_prop_ro(
          "velocity", [](const DiffIk& ik) { return toNumpy(ik.velocity()); },
          "dq/dt of the last step, shape (n,), rad/s or m/s.")
      .def_prop_ro("status", &DiffIk::status, "How the last step ended, a DiffIkStatus.")
      .def_prop_ro(
          "message", [](const DiffIk& ik) { return inPython(ik.message()); },
          "\"\" if all limits, distances and equalities hold; else the relaxed ones, and by how much.")
      .def_prop_ro("active", &DiffIk::active, "Names of the limits and pairs that restrict the last step.")
      .def("__repr__", [](const DiffIk& ik) {
        const std::string message = inPython(ik.message());
        return "<DiffIk" + (message.empty() ? "" : " " + message) + ">";
      });
}

}  // namespace kinegraph::python
