#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <utility>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "viewer/image_argument.h"
#include "viewer/py_viewer.h"
#include "viewer/viewer_input_docs.h"

namespace kinegraph::python {

namespace {

constexpr int kNoFrame = 0xffffff;  // as in segmentation images

int setQuad(PyViewer& viewer, int id, const Image<std::uint8_t>& rgb, double x, double y, double height) {
  Quad quad = quadOf(rgb, "setQuad");
  return viewer.setQuad(id, {quad.columns, quad.rows, std::move(quad.rgb)}, x, y, height);
}

int viewPage(PyViewer& viewer, bool pause, const std::optional<std::string>& text, bool offscreen) {
  if (!show(viewer, text, offscreen)) return pause && !offscreen ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer.wait(pause, text, interrupted);
}

/// Returns the point under the pointer and the surface normal there, 6 numbers; empty until the pointer was on a
/// surface.
Array eventCursor(PyViewer& viewer) {
  const std::optional<Cursor> cursor = viewer.getEventCursor();
  if (!cursor) return toNumpy(VectorXd(0));
  VectorXd numbers(6);
  numbers << cursor->point, cursor->normal;
  return toNumpy(numbers);
}

int eventCursorObject(PyViewer& viewer) {
  const std::optional<Cursor> cursor = viewer.getEventCursor();
  return cursor && cursor->frame >= 0 ? cursor->frame : kNoFrame;
}

/// A page that shows one image.
struct ImageViewer : PyViewer {
  ImageViewer() : PyViewer({.title = "ImageViewer"}) {}
};

template <class T>
int viewImage(ImageViewer& viewer, const Image<T>& image, bool wait, double zoom) {
  if (!(zoom > 0. && zoom <= 100.))
    throw ValueError(cat("ImageViewer: zoom is ", zoom, "; expected a number in (0, 100]"));
  Quad quad = quadOf(image, "ImageViewer");
  quad.zoom = zoom;
  if (!openPage(viewer)) return wait ? kEscape : 0;
  viewer.server().setQuad(quad);
  const nb::gil_scoped_release unlock;
  return viewer.wait(wait, std::nullopt, interrupted);
}

}  // namespace

void bindViewerInput(nb::module_& m, nb::class_<PyViewer>& viewer) {
  viewer
      .def("view", viewPage, "pause"_a = false, "text"_a = nb::none(), "offscreen"_a = false, docs::viewer_input::view)
      .def("setQuad", setQuad, "id"_a, "rgb"_a, "x"_a, "y"_a, "h"_a, docs::viewer_input::setQuad)
      .def("setupEventHandler", &PyViewer::setupEventHandler, "blockDefaultHandler"_a,
           docs::viewer_input::setupEventHandler)
      .def("getEvents", &PyViewer::getEvents, docs::viewer_input::getEvents)
      .def("getEventCursor", eventCursor, docs::viewer_input::getEventCursor)
      .def("getEventCursorObject", eventCursorObject,
           "Returns the id of the frame under the pointer; 16777215 over the floor and the background.")
      .def(
          "raiseWindow", [](PyViewer& v) { openBrowser(v.url()); },
          "Opens a page in the browser, if there is a display.")
      .def(
          "getGLFWWindow", [](PyViewer&) { return 0; }, "0: there is no such window.");

  nb::class_<ImageViewer>(m, "ImageViewer", "Shows images in the browser.")
      .def(nb::init<>(), "Creates a viewer without an image.")
      .def("view", viewImage<std::uint8_t>, "img"_a, "wait"_a = false, "zoom"_a = 1., docs::viewer_input::viewImage)
      .def("viewFloat", viewImage<float>, "img"_a, "wait"_a = false, "zoom"_a = 1., docs::viewer_input::viewFloat)
      .def_prop_ro("url", &ImageViewer::url, "The page's address.")
      .def("close", &ImageViewer::close, "Closes the viewer.");
}

}  // namespace kinegraph::python
