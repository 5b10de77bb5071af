#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "bindings.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/watch_file.h"

namespace kinegraph::python {

namespace {

const std::shared_ptr<ConfigViewer>& viewerOf(PyConfig& config) {
  if (!config.viewer) config.viewer = std::make_shared<ConfigViewer>();
  return config.viewer;
}

/// Never stops by itself, but lets Ctrl-C through.
bool interrupted() {
  checkInterrupt();
  return false;
}

int view(PyConfig& config, bool pause, const std::optional<std::string>& message, bool) {
  const std::shared_ptr<ConfigViewer> viewer = viewerOf(config);
  const nb::gil_scoped_release unlock;
  return viewer->view(config, pause, message, interrupted);
}

void watch(PyConfig& config, nb::handle file) {
  const std::string path = nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(file));
  const std::shared_ptr<ConfigViewer> viewer = viewerOf(config);
  const nb::object print = nb::module_::import_("builtins").attr("print");
  const nb::gil_scoped_release unlock;
  watchFile(config, *viewer, path, [&](const std::string& text) {
    const nb::gil_scoped_acquire lock;
    print(text, nb::arg("flush") = true);
  }, interrupted);
}

Vector3d point(const Numbers& numbers) { return numbers.values.size() == 3 ? Vector3d(numbers.values) : Vector3d::Zero(); }

}  // namespace

void bindViewer(nb::module_& m, nb::class_<PyConfig>& config) {
  nb::class_<ConfigViewer>(m, "ConfigurationViewer", "Shows a configuration in the browser.")
      .def_prop_ro("url", &ConfigViewer::url, "The page's address; starts the viewer if it does not run.")
      .def("clients", &ConfigViewer::clients, "Number of browsers that are connected.")
      .def("waitForClient", [](ConfigViewer& v, double seconds) {
             const nb::gil_scoped_release unlock;
             return v.server().waitForClient(seconds);
           }, "seconds"_a = 10., "Waits until a browser is connected; False if none came in time.")
      .def("setMessage", &ConfigViewer::setMessage, "text"_a, "Text in the corner.")
      .def("setError", &ConfigViewer::setError, "text"_a, "Text in a red box; empty removes it.")
      .def("setTitle", &ConfigViewer::setTitle, "text"_a, "Title of the page.")
      .def("setCamera", [](ConfigViewer& v, const Numbers& position, const Numbers& target) { v.setCamera(point(position), point(target)); },
           "position"_a, "target"_a, "Where to look from, and at: 3 numbers each, m.")
      .def("takeKey", &ConfigViewer::takeKey, "The key pressed since the last call, or 0.")
      .def("close", &ConfigViewer::close, "Ends the viewer.");

  config
      .def("view", view, "pause"_a = false, "message"_a = nb::none(), "offscreen"_a = false,
           "Shows the configuration in the browser; opens one at the first call if there is a display, and prints its address.\n"
           "pause: waits for a key in the browser, or Enter on the terminal. Returns the code of the key pressed since the last\n"
           "call (ord('a'), 13 Enter, 27 Escape ...), or 0. With KINEGRAPH_HEADLESS=1 nothing opens and nothing waits.")
      .def("view_close", [](PyConfig& c) { if (c.viewer) c.viewer->close(); }, "Ends the viewer; the next view() starts another.")
      .def("view_recopyMeshes", [](PyConfig& c) { viewerOf(c)->update(c); }, "Kept for older scripts; changes are always seen.")
      .def("viewer", viewerOf, "The viewer of this configuration.")
      .def("get_viewer", viewerOf, "The viewer of this configuration.")
      .def("set_viewer", [](PyConfig& c, std::shared_ptr<ConfigViewer> v) { c.viewer = std::move(v); }, "viewer"_a,
           "Shows this configuration in another one's viewer.")
      .def("watchFile", watch, "filename"_a,
           "Loads a scene file, shows it, and again whenever it (or a file that it includes) changes, until q is pressed in the\n"
           "browser, Enter on the terminal, or Ctrl-C. A mistake in the file is shown there and printed; the last scene stays.");
}

}  // namespace kinegraph::python
