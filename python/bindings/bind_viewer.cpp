#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "bindings.h"
#include "kinegraph/viewer/watch_file.h"
#include "py_viewer.h"

namespace kinegraph::python {

namespace {

const std::shared_ptr<PyViewer>& viewerOf(PyConfig& config) {
  if (!config.viewer) config.viewer = std::make_shared<PyViewer>();
  if (!config.viewer->scene) config.viewer->scene = config.scene();
  return config.viewer;
}

/// The viewer of a configuration, which shows it from now on.
const std::shared_ptr<PyViewer>& showIn(PyConfig& config) {
  viewerOf(config)->scene = config.scene();
  return config.viewer;
}

/// Never stops by itself, but lets Ctrl-C through.
bool interrupted() {
  checkInterrupt();
  return false;
}

int view(PyConfig& config, bool pause, const std::optional<std::string>& message, bool offscreen) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (offscreen) return 0;
  const nb::gil_scoped_release unlock;
  return viewer->view(config, pause, message, interrupted);
}

void watch(PyConfig& config, nb::handle file) {
  const std::string path = nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(file));
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  const nb::object print = nb::module_::import_("builtins").attr("print");
  const nb::gil_scoped_release unlock;
  watchFile(config, *viewer, path, [&](const std::string& text) {
    const nb::gil_scoped_acquire lock;
    print(text, nb::arg("flush") = true);
  }, interrupted);
}

}  // namespace

void bindViewer(nb::module_& m, nb::class_<PyConfig>& config) {
  nb::class_<PyViewer> viewer(m, "ConfigurationViewer", "Shows a configuration in the browser, and makes pictures of it.");
  viewer
      .def_prop_ro("url", &PyViewer::url, "The page's address; starts the viewer if it does not run.")
      .def("clients", &PyViewer::clients, "Number of browsers that are connected.")
      .def("waitForClient", [](PyViewer& v, double seconds) {
             const nb::gil_scoped_release unlock;
             return v.server().waitForClient(seconds);
           }, "seconds"_a = 10., "Waits until a browser is connected; False if none came in time.")
      .def("setMessage", &PyViewer::setMessage, "text"_a, "Text in the corner.")
      .def("setError", &PyViewer::setError, "text"_a, "Text in a red box; empty removes it.")
      .def("setTitle", &PyViewer::setTitle, "text"_a, "Title of the page.")
      .def("takeKey", &PyViewer::takeKey, "The key pressed since the last call, or 0.")
      .def("close", &PyViewer::close, "Ends the viewer.");
  bindPictures(viewer);

  config
      .def("view", view, "pause"_a = false, "message"_a = nb::none(), "offscreen"_a = false,
           "Shows the configuration in the browser; opens one at the first call if there is a display, and prints its address.\n"
           "pause: waits for a key in the browser, or Enter on the terminal. Returns the code of the key pressed since the last\n"
           "call (ord('a'), 13 Enter, 27 Escape ...), or 0. With KINEGRAPH_HEADLESS=1 nothing opens and nothing waits.\n"
           "offscreen: opens nothing; viewer().getRgb() and the other pictures do without a browser.")
      .def("view_close", [](PyConfig& c) { if (c.viewer) c.viewer->close(); }, "Ends the viewer; the next view() starts another.")
      .def("view_recopyMeshes", [](PyConfig& c) { showIn(c)->update(c); }, "Kept for older scripts; changes are always seen.")
      .def("viewer", viewerOf, "The viewer of this configuration.")
      .def("get_viewer", viewerOf, "The viewer of this configuration.")
      .def("set_viewer", [](PyConfig& c, std::shared_ptr<PyViewer> v) { c.viewer = std::move(v); }, "viewer"_a,
           "Shows this configuration in another one's viewer.")
      .def("watchFile", watch, "filename"_a,
           "Loads a scene file, shows it, and again whenever it (or a file that it includes) changes, until q is pressed in the\n"
           "browser, Enter on the terminal, or Ctrl-C. A mistake in the file is shown there and printed; the last scene stays.");
}

}  // namespace kinegraph::python
