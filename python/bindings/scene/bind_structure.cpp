#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <set>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/scene/convex_parts.h"
#include "kinegraph/scene/tree/inertia_edits.h"
#include "kinegraph/scene/tree/tree_edits.h"
#include "scene/structure_docs.h"

namespace kinegraph::python {

namespace {

std::vector<Frame> getShapes(const PyConfig& config, bool shared_only_once) {
  std::vector<Frame> frames;
  std::set<const Shape*> seen;
  for (const Frame& frame : config.getFrames()) {
    const Shape* shape = frame.data().shape.get();
    if (shape && (seen.insert(shape).second || !shared_only_once)) frames.push_back(frame);
  }
  return frames;
}

void processStructure(PyConfig& config, bool rigid, bool reconnect, bool non_contact, bool transparent) {
  simplifyStructure(*config.scene(), {rigid, reconnect, non_contact, transparent});
}

void bindSimplification(nb::class_<PyConfig>& config) {
  config
      .def("processStructure", processStructure, "pruneRigidJoints"_a = false, "reconnectToLinks"_a = true,
           "pruneNonContactShapes"_a = false, "pruneTransparent"_a = false, docs::structure::processStructure)
      .def(
          "processInertias",
          [](PyConfig& c, bool recompute, bool diagonal) {
            processInertias(*c.scene(), {recompute, diagonal});
          },
          "recomputeInertias"_a = true, "transformToDiagInertia"_a = false, docs::structure::processInertias)
      .def(
          "makeMeshesSSCvx", [](PyConfig& c, double radius) { makeMeshesConvex(*c.scene(), radius); },
          "radius"_a = .005, docs::structure::makeMeshesSSCvx)
      .def(
          "recalibrateJointsToZero", [](PyConfig& c) { recalibrateJointsToZero(*c.scene()); },
          docs::structure::recalibrateJointsToZero)
      .def(
          "checkConsistency", [](const PyConfig& c) { return checkConsistency(*c.scene()), true; },
          docs::structure::checkConsistency);
}

}  // namespace

void bindStructure(nb::class_<PyConfig>& config) {
  config
      .def(
          "_repr_html_",
          [](nb::handle self) {
            return nb::cast<std::string>(nb::module_::import_("kinegraph.scene_html").attr("sceneHtml")(self));
          },
          "Returns a table of the frames, for notebooks.")
      .def("getShapes", getShapes, "shared_only_once"_a = true, docs::structure::getShapes)
      .def(
          "selectJointsBySubtree",
          [](PyConfig& c, const FrameArgument& root) {
            selectJointsBySubtree(*c.scene(), toFrame(c, root, "selectJointsBySubtree").data());
          },
          "root"_a, docs::structure::selectJointsBySubtree)
      .def(
          "addH5Object",
          [](PyConfig& c, const std::string& name, const PathText& file, int) {
            return addH5Object(c, name, file.text);
          },
          "framename"_a, "filename"_a, "verbose"_a = 0, docs::structure::addH5Object);
  bindSimplification(config);
}

}  // namespace kinegraph::python
