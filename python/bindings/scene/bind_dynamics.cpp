#include <nanobind/stl/string.h>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/scene/dynamics.h"
#include "scene/dynamics_docs.h"

namespace kinegraph::python {

namespace {

void bindVelocityDynamics(nb::class_<PyConfig>& config) {
  config
      .def(
          "velocityDimension", [](const PyConfig& c) { return velocityDimension(c); },
          "Returns the number nv of velocities: one per dof, but three per quaternion.")
      .def(
          "velocityMap", [](const PyConfig& c) { return toNumpy(velocityMap(c)); }, docs::dynamics::velocityMap)
      .def(
          "rigidBodyDynamics",
          [](const PyConfig& c, const Numbers& v, bool gravity) {
            const RigidBodyDynamics terms =
                rigidBodyDynamics(c, v.values, gravity ? kGravity : Vector3d(Vector3d::Zero()));
            return nb::typed<nb::tuple, Array, Array, Array>(
                nb::make_tuple(toNumpy(terms.M), toNumpy(terms.C), toNumpy(terms.g)));
          },
          "v"_a, "gravity"_a = true, docs::dynamics::rigidBodyDynamics)
      .def(
          "centroidalMomentumMatrix", [](const PyConfig& c) { return toNumpy(centroidalMomentumMatrix(c)); },
          docs::dynamics::centroidalMomentumMatrix);
}

}  // namespace

void bindDynamics(nb::class_<PyConfig>& config) {
  bindVelocityDynamics(config);
  config
      .def(
          "dyn_MF",
          [](const PyConfig& c, const Numbers& velocity) {
            const EquationOfMotion equation = c.equationOfMotion(velocity.values);
            return nb::typed<nb::tuple, Array, Array>(nb::make_tuple(toNumpy(equation.M), toNumpy(equation.F)));
          },
          "q_dot"_a, docs::dynamics::dyn_MF)
      .def(
          "equationOfMotion",
          [](const PyConfig& c, const Numbers& velocity, bool gravity) {
            EquationOfMotion equation = c.equationOfMotion(velocity.values);
            if (!gravity) equation.F -= c.equationOfMotion(VectorXd::Zero(velocity.values.size())).F;
            return nb::typed<nb::tuple, Array, Array>(nb::make_tuple(toNumpy(equation.M), toNumpy(equation.F)));
          },
          "qdot"_a, "gravity"_a = true, docs::dynamics::equationOfMotion)
      .def(
          "dyn_F0",
          [](const PyConfig& c) { return toNumpy(c.equationOfMotion(VectorXd::Zero(c.getJointDimension())).F); },
          "Returns F at rest, shape (n,): the generalized forces (N m, N) that hold the current q against gravity.")
      .def(
          "inverseDynamics",
          [](const PyConfig& c, const Numbers& velocity, const Numbers& acceleration) {
            return toNumpy(c.inverseDynamics(velocity.values, acceleration.values));
          },
          "q_dot"_a, "q_ddot"_a, docs::dynamics::inverseDynamics)
      .def(
          "getCenterOfMass",
          [](const PyConfig& c) {
            const auto [mass, center] = c.centerOfMass();
            return nb::typed<nb::tuple, nb::float_, Array>(nb::make_tuple(mass, toNumpy(center.data(), 3)));
          },
          "Returns the mass of all moving links (kg) and its center (3,) in world coordinates, m.");
}

}  // namespace kinegraph::python
