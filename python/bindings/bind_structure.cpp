#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <set>

#include "bindings.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/formats/mesh_export.h"
#include "kinegraph/scene/earlier_methods.h"
#include "kinegraph/scene/frame_shapes.h"
#include "kinegraph/scene/inertia_edits.h"
#include "kinegraph/scene/tree_edits.h"

namespace kinegraph::python {

namespace {

std::string pathText(nb::handle path) { return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(path)); }

std::vector<Frame> getShapes(const PyConfig& config, bool shared_only_once) {
  std::vector<Frame> frames;
  std::set<const Shape*> seen;
  for (const Frame& frame : config.getFrames()) {
    const Shape* shape = frame.data().shape.get();
    if (shape && (seen.insert(shape).second || !shared_only_once)) frames.push_back(frame);
  }
  return frames;
}

nb::tuple forceArrays() {
  const nb::object zeros = nb::module_::import_("numpy").attr("zeros");
  return nb::make_tuple(zeros(nb::make_tuple(0, 2), "dtype"_a = "int32"), zeros(nb::make_tuple(0, 3, 3)));
}

void refuseSlice(const PyConfig&, const Numbers&, int) {
  throw ValueError(
      "setJointStateSlice: a Config is a single moment and has no time slices; those of a motion belong to its KOMO, "
      "where KOMO.initWithPath and KOMO.initWithConstant set them");
}

void writeCollada(const PyConfig& config, nb::handle file, const std::string& format) {
  if (format != "collada")
    throw ValueError(cat("writeCollada: format '", format, "' is not written; expected 'collada'"));
  saveCollada(config, pathText(file));
}

void processStructure(PyConfig& config, bool rigid, bool reconnect, bool non_contact, bool transparent) {
  simplifyStructure(*config.scene(), {rigid, reconnect, non_contact, transparent});
}

}  // namespace

void bindStructure(nb::class_<PyConfig>& config) {
  config
      .def(
          "_repr_html_",
          [](nb::handle self) {
            return nb::cast<std::string>(nb::module_::import_("kinegraph.scene_html").attr("sceneHtml")(self));
          },
          "A table of the frames, for notebooks.")
      .def("getShapes", getShapes, "shared_only_once"_a = true,
           "Frames with a shape; of those that share one, the first or all.")
      .def(
          "selectJointsBySubtree",
          [](PyConfig& c, nb::handle root) { selectJointsBySubtree(*c.scene(), toFrame(c, root).data()); }, "root"_a,
          "Makes exactly the joints at or below a frame (or its name) active.")
      .def("setJointStateSlice", refuseSlice, "q"_a, "t"_a,
           "A Config has no time slices; this raises ArgumentError and names what has them.")
      .def(
          "getForceArrays", [](const PyConfig&) { return forceArrays(); },
          "Pairs of frames that exchange forces, (k, 2) int32 ids, and per pair point of attack, force and torque, (k, "
          "3, 3): none,\n"
          "k = 0, as a Config has no force exchanges.")
      .def("processStructure", processStructure, "pruneRigidJoints"_a = false, "reconnectToLinks"_a = true,
           "pruneNonContactShapes"_a = false, "pruneTransparent"_a = false,
           "Simplifies the tree without moving anything: frames hang directly below the frame of their link's joint, a "
           "shape-only child\n"
           "at its parent's place gives it the shape, and leaves without joint, shape and mass are deleted, named ones "
           "too. Optionally\n"
           "rigid joints go, leaves that never collide (but markers), and leaves with an alpha below 1. Sorts the "
           "frames by depth.")
      .def(
          "processInertias",
          [](PyConfig& c, bool recompute, bool diagonal) {
            processInertias(*c.scene(), {recompute, diagonal});
          },
          "recomputeInertias"_a = true, "transformToDiagInertia"_a = false,
          "Gathers the inertia of every link in its frame. recomputeInertias: first, opaque shapes weigh 5 kg per m^2 "
          "of surface and\n"
          "transparent ones nothing. transformToDiagInertia: link frames move to their center of mass and principal "
          "axes; one that\n"
          "cannot move (it has a shape or dofs) gets a child <name>_inertia there, which holds the inertia.")
      .def(
          "sortFrames", [](PyConfig& c) { c.scene()->sortByDepth(); }, "Sorts the frames by depth.")
      .def(
          "selectJointsByTag",
          [](PyConfig& c, const std::vector<std::string>& tags, bool not_those) {
            selectJointsByTag(c, tags, not_those);
          },
          "jointGroups"_a, "notThose"_a = false,
          "Makes active exactly the joints at frames that have one of these attributes, or with notThose all others.")
      .def(
          "makeObjectsFree", [](PyConfig& c, const std::vector<std::string>& names) { makeObjectsFree(c, names); },
          "frameNames"_a,
          "Lets objects move freely: the nearest joint at or above each of these frames becomes a free one, where it "
          "is. Roots are\n"
          "attached to the first frame of the configuration.")
      .def(
          "makeMeshesSSCvx", [](PyConfig& c, double radius) { makeMeshesConvex(*c.scene(), radius); },
          "radius"_a = .005,
          "Replaces every mesh by its convex hull, drawn in by `radius` and swept by a ball of it (m). Flat meshes "
          "stay.")
      .def(
          "recalibrateJointsToZero", [](PyConfig& c) { recalibrateJointsToZero(*c.scene()); },
          "Makes the present q the zero of every joint: the motion goes into the frame above, limits shift. "
          "ArgumentError, and no\n"
          "change, for joints of several dofs, or where the frame above is a root or has a shape, mass, joint or other "
          "joints below.")
      .def(
          "addH5Object",
          [](PyConfig& c, const std::string& name, nb::handle file, int) {
            return addH5Object(c, name, pathText(file));
          },
          "framename"_a, "filename"_a, "verbose"_a = 0,
          "Adds a frame with the inertia of an HDF5 file, and children _mesh, _pts (points) and _decomp (convex parts, "
          "which collide),\n"
          "as far as the file has the groups mesh, points, decomp, inertia. Returns the frame. FileError if it has "
          "none.")
      .def(
          "writeMesh", [](const PyConfig& c, nb::handle file) { saveWorldMesh(c, pathText(file)); }, "filename"_a,
          "Writes all surfaces as one PLY file in world coordinates, m. FileError if it cannot be written.")
      .def(
          "writeMeshes",
          [](const PyConfig& c, const std::string& prefix, bool, bool enumerate) {
            return saveMeshes(c, prefix, enumerate);
          },
          "pathPrefix"_a, "copyTextures"_a = true, "enumerateAssets"_a = false,
          "Writes every mesh once as <pathPrefix><frame>.ply (enumerateAssets: mesh_0.ply, ...) in its frame's "
          "coordinates. Returns the\n"
          "paths. PLY files hold no pictures, so there are none to copy.")
      .def(
          "writeConvexStls",
          [](const PyConfig& c, const std::string& prefix, double shrink, int) {
            return saveConvexStls(c, prefix, shrink);
          },
          "pathPrefix"_a, "shrinkRadius"_a = -1., "verbose"_a = 1,
          "Writes the convex hull of every mesh, drawn in by shrinkRadius (m) if positive, as <pathPrefix><frame>.stl. "
          "Returns the paths.")
      .def("writeCollada", writeCollada, "filename"_a, "format"_a = "collada",
           "Writes the tree of frames with poses, surfaces and colors as a COLLADA file (.dae).")
      .def(
          "checkConsistency", [](const PyConfig& c) { return checkConsistency(*c.scene()), true; },
          "True, or an Error that names the first frame whose data contradict each other.");
}

}  // namespace kinegraph::python
