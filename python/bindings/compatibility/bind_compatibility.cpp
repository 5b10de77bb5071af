#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "compatibility/compatibility_docs.h"
#include "defaults.h"
#include "kinegraph/compatibility/earlier_methods.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::python {

/// Binds the methods of earlier releases that C++ computes. All other earlier names are in kinegraph.compatibility.
void bindCompatibility(nb::class_<PyConfig>& config) {
  config
      .def(
          "selectJointsByTag",
          [](PyConfig& c, const std::vector<std::string>& tags, bool not_those) {
            selectJointsByTag(c, tags, not_those);
          },
          "jointGroups"_a, "notThose"_a = false, docs::compatibility::selectJointsByTag)
      .def(
          "makeObjectsFree", [](PyConfig& c, const std::vector<std::string>& names) { makeObjectsFree(c, names); },
          "frameNames"_a, docs::compatibility::makeObjectsFree)
      .def(
          "stepDynamics",
          [](PyConfig& c, const Numbers& velocity, const Numbers& u, double tau, double noise, bool gravity) {
            return toNumpy(stepDynamics(c, velocity.values, u.values, tau, noise, gravity, defaults().random));
          },
          "qdot"_a, "u_control"_a, "tau"_a, "dynamicNoise"_a = 0., "gravity"_a = true,
          docs::compatibility::stepDynamics)
      .def(
          "sortFrames", [](PyConfig& c) { c.scene()->sortByDepth(); }, "Sorts the frames by depth.");
}

}  // namespace kinegraph::python
