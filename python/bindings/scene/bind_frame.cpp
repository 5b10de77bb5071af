#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/scene/frame_setters.h"
#include "kinegraph/scene/loading/reader.h"
#include "kinegraph/scene/tree/tree_edits.h"
#include "scene/frame_docs.h"
#include "scene/scene_values.h"

namespace kinegraph::python {

namespace {

void setAttributesOf(Frame& frame, nb::dict attributes) {
  Graph graph;
  for (const auto& [key, value] : attributes) {
    const std::string name = nb::cast<std::string>(key);
    Node node;
    node.key = name;
    node.value = toValue(value, name);
    graph.set(node);
  }
  for (const std::string& warning : setAttributes(frame, graph)) emitWarning(warning);
}

Frame& setAttribute(Frame& frame, nb::str key, nb::any value) {
  nb::dict attributes;
  attributes[key] = value;
  setAttributesOf(frame, attributes);
  return frame;
}

void bindTree(nb::class_<Frame>& frame) {
  frame
      .def_prop_ro(
          "ID", [](const Frame& f) { return f.id(); }, "Index in the list of the scene's frames.")
      .def_prop_rw(
          "name", [](const Frame& f) { return f.getName(); }, [](Frame& f, std::string n) { f.setName(n); },
          "The frame's name.")
      .def(
          "getName", [](const Frame& f) { return f.getName(); }, "Returns the frame's name.")
      .def(
          "__eq__", [](const Frame& a, const Frame& b) { return a == b; }, "other"_a,
          nb::sig("def __eq__(self, other: Frame, /) -> bool"))
      .def(
          "__eq__", [](const Frame&, nb::handle) { return false; }, "other"_a,
          nb::sig("def __eq__(self, other: object, /) -> bool"))
      .def("__hash__", [](const Frame& f) { return std::size_t(&f.data()); })
      .def("__repr__", [](const Frame& f) { return f.isDeleted() ? std::string("<Frame, deleted>") : describe(f); })
      .def(
          "_repr_html_",
          [](nb::handle self) {
            return nb::cast<std::string>(nb::module_::import_("kinegraph.scene_html").attr("frameHtml")(self));
          },
          "Returns a table that describes the frame, for notebooks.")
      .def("getParent", &Frame::getParent, "Returns the parent frame, or None.")
      .def("getChildren", &Frame::getChildren, "Returns the frames directly below this one.")
      .def("getSubtree", &Frame::getSubtree, "Returns all frames below this one, depth first.")

      .def(
          "setParent",
          [](Frame& f, const Frame& parent, bool keep, bool) -> Frame& { return f.setParent(parent, keep); },
          "parent"_a, "keepAbsolutePose_and_adaptRelativePose"_a = false, "checkForLoop"_a = true, kChain,
          docs::frame::setParent)
      .def("unLink", &Frame::unLink, kChain,
           "Cuts the frame from its parent, keeps its world pose and removes its joint. Returns the frame itself.")

      .def(
          "makeRoot", [](Frame& f, bool until) -> Frame& { return makeRoot(*f.scene(), f.data(), until), f; },
          "untilPartBreak"_a = false, kChain, docs::frame::makeRoot);
}

void bindAttributes(nb::class_<Frame>& frame) {
  frame
      .def(
          "getAttributes", [](const Frame& f) { return Attributes(toDict(f.attributes())); },
          "Returns the attributes given to the frame by files and scripts, as a dict.")
      .def(
          "setAttributes", [](Frame& f, const Attributes& d) -> Frame& { return setAttributesOf(f, d), f; },
          "attributes"_a, kChain, docs::frame::setAttributes)
      .def("setAttribute", setAttribute, "key"_a, "value"_a, kChain, docs::frame::setAttribute);
}

}  // namespace

void bindFrame(nb::class_<Frame>& frame) {
  bindTree(frame);
  bindFramePoses(frame);
  bindFrameJoint(frame);
  bindShapes(frame);
  bindAttributes(frame);
}

}  // namespace kinegraph::python
