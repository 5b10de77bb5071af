#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include <algorithm>

#include "arguments.h"
#include "bindings.h"
#include "defaults.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/recorded_page.h"
#include "viewer/py_viewer.h"
#include "viewer/viewer_docs.h"

namespace kinegraph::python {

namespace {

const std::shared_ptr<PyViewer>& viewerOf(PyConfig& config) {
  if (!config.viewer) config.viewer = std::make_shared<PyViewer>();
  if (!config.viewer->scene) config.viewer->scene = config.scene();
  return config.viewer;
}

/// Returns the viewer of a configuration, and shows the configuration there.
const std::shared_ptr<PyViewer>& showIn(PyConfig& config) {
  viewerOf(config)->scene = config.scene();
  return config.viewer;
}

void select(PyViewer& viewer, int frame) {
  const int count = viewer.scene ? int(viewer.scene->frames().size()) : 0;
  if (frame < 0 || frame >= count) {
    throw ValueError(cat("select: no frame has the ID ", frame, "; expected 0 to ", count - 1));
  }
  viewer.select(frame);
}

/// Waits in short intervals, between which Ctrl-C is checked.
bool waitForClient(PyViewer& viewer, double seconds) {
  constexpr double kPiece = .1;  // s
  for (double left = seconds;; left -= kPiece) {
    if (viewer.server().waitForClient(std::clamp(left, 0., kPiece))) return true;
    interrupted();
    if (!(left > kPiece)) return false;
  }
}

/// Returns the self-contained HTML page, whether a server runs or not. `largest`: see recordedPage.
std::string pageOf(PyViewer& viewer, std::size_t largest) {
  if (viewer.isOpen() || !viewer.scene) return viewer.recording(largest);
  return recordedScene(Config(*viewer.scene), nullptr, "Kinegraph", viewer.content(), largest);
}

std::string wholePage(PyViewer& viewer) { return pageOf(viewer, 0); }

constexpr int kFirstPort = 7000;

int viewConfig(PyConfig& config, bool pause, const std::optional<std::string>& message, bool offscreen,
               const std::optional<std::string>& host, const std::optional<int>& port,
               const std::optional<std::string>& token) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (!offscreen && (host || port || token))
    viewer->serveAt(host.value_or("127.0.0.1"), port.value_or(kFirstPort), token.value_or(""));
  if (!show(*viewer, message, offscreen)) return pause && !offscreen ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->view(config, pause, message, interrupted);
}

void animate(PyConfig& config) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (!openPage(*viewer)) return;
  const nb::gil_scoped_release unlock;
  viewer->showMotion(config, jointSweep(config), false, "every joint through its limits [any key ends it]",
                     interrupted);
}

void animateSpline(PyConfig& config, int points) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  const ShownMotion motion = randomSpline(config, points, defaults().random);
  if (!openPage(*viewer)) return;
  const nb::gil_scoped_release unlock;
  viewer->showMotion(config, motion, false, "a random motion [any key ends it]", interrupted);
}

int viewPath(PyConfig& config, const Numbers& path, double seconds, bool pause,
             const std::optional<std::string>& message) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (seconds <= 0.) throw ValueError(cat("view_path: seconds is ", seconds, "; expected a positive number"));
  const MatrixXd states = path.matrix();
  if (states.rows() == 0) throw ValueError("view_path: the path has no rows");
  ShownMotion motion = motionAlong(config, states, seconds);
  motion.start = ShownMotion::Start::play;
  if (!openPage(*viewer)) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->showMotion(config, motion, pause, message, interrupted);
}

void watch(PyConfig& config, const PathText& file) {
  const std::string& path = file.text;
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  viewer->setTitle(cat("ConfigView <", path, ">"));  // before the page opens
  if (!openPage(*viewer)) {
    config.clear();
    config.addFile(path);
    return;
  }
  const nb::object print = nb::module_::import_("builtins").attr("print");
  const nb::gil_scoped_release unlock;
  watchFile(
      config, *viewer, path,
      [&](const std::string& text) {
        const nb::gil_scoped_acquire lock;
        print(text, nb::arg("flush") = true);
      },
      interrupted);
}

/// A recording as a context manager. It keeps the viewer alive.
class PyRecordingOfPage {
 public:
  PyRecordingOfPage(std::shared_ptr<PyViewer> viewer, std::string path)
      : viewer_(std::move(viewer)), path_(std::move(path)) {}
  PyRecordingOfPage& start() {
    if (recording_) throw ValueError("record: this recording runs already");
    recording_.emplace(viewer_->record(path_));
    return *this;
  }
  void stop() {
    if (recording_) recording_->stop();
    recording_.reset();
  }

 private:
  std::shared_ptr<PyViewer> viewer_;
  std::string path_;
  std::optional<ViewerRecording> recording_;
};

std::shared_ptr<PyRecordingOfPage> recordPage(std::shared_ptr<PyViewer> viewer, const PathText& path) {
  if (viewer->scene && !viewer->isOpen()) viewer->update(Config(*viewer->scene));
  return std::make_shared<PyRecordingOfPage>(std::move(viewer), path.text);
}

void bindRecording(nb::module_& m) {
  nb::class_<PyRecordingOfPage>(m, "ViewerRecording", docs::viewer::ViewerRecording)
      .def("__enter__", &PyRecordingOfPage::start, nb::rv_policy::reference, "Starts the recording.")
      .def(
          "__exit__", [](PyRecordingOfPage& r, nb::args) { r.stop(); }, "Ends the recording and writes the file.")
      .def("start", &PyRecordingOfPage::start, nb::rv_policy::reference, docs::viewer::startRecording)
      .def("stop", &PyRecordingOfPage::stop, docs::viewer::stopRecording);
  m.def(
      "runPage",
      [](const nb::bytes& content) {
        return runPage(std::string_view(static_cast<const char*>(content.data()), content.size()));
      },
      "content"_a, docs::viewer::runPage);
}

/// Binds the page in the browser.
void bindPage(nb::class_<PyViewer>& viewer) {
  viewer.def_prop_ro("url", &PyViewer::url, "The page's address; starts the viewer if necessary.")
      .def("isOpen", &PyViewer::isOpen, "True while the viewer runs.")
      .def("serveAt", &PyViewer::serveAt, "host"_a, "port"_a = kFirstPort, "token"_a = "", docs::viewer::serveAt)
      .def(
          "isPatient", [](PyViewer&) { return isPatient(); },
          "True at a terminal and over ssh: calls with pause then wait for the first browser.")
      .def("clients", &PyViewer::clients, "Number of connected browsers.")
      .def(
          "waitForClient",
          [](PyViewer& v, double seconds) {
            const nb::gil_scoped_release unlock;
            return waitForClient(v, seconds);
          },
          "seconds"_a = 10., docs::viewer::waitForClient)
      .def("setMessage", &PyViewer::setMessage, "text"_a, docs::viewer::setMessage)
      .def("setError", &PyViewer::setError, "text"_a, docs::viewer::setError)
      .def("setTitle", &PyViewer::setTitle, "text"_a, docs::viewer::setTitle)
      .def("takeKey", &PyViewer::takeKey, "The code of the key pressed since the last call, or 0.")
      .def("hasEdits", &PyViewer::hasEdits, docs::viewer::hasEdits)
      .def("select", select, "frame"_a, docs::viewer::select)
      .def("asHtml", wholePage, "Returns a self-contained web page of the shown scene or motion.")
      .def(
          "saveHtml",
          [](PyViewer& v, const PathText& path, const std::optional<PathText>& client) {
            if (client && client->text.empty()) throw ValueError("saveHtml: client is empty; expected a path, or None");
            savePage(wholePage(v), path.text, client ? client->text : "");
          },
          "path"_a, "client"_a = nb::none(), docs::viewer::saveHtml)
      .def("record", recordPage, "path"_a, docs::viewer::record)
      .def(
          "_repr_html_",
          [](PyViewer& v) {
            return nb::module_::import_("kinegraph.notebook").attr("inlineFrame")(pageOf(v, kLargestInNotebooks));
          },
          "Shows the present scene in notebooks.")
      .def("close", &PyViewer::close, "Closes the viewer.");
}

/// Binds the views of a Config.
void bindViews(nb::class_<PyConfig>& config) {
  config
      .def("view", viewConfig, "pause"_a = false, "message"_a = nb::none(), "offscreen"_a = false, nb::kw_only(),
           "host"_a = nb::none(), "port"_a = nb::none(), "token"_a = nb::none(), docs::viewer::view)
      .def(
          "view_close",
          [](PyConfig& c) {
            if (c.viewer) c.viewer->close();
          },
          "Closes the viewer; the next view() starts a new one.")
      .def("viewer", viewerOf, "Returns the viewer of this scene.")
      .def(
          "set_viewer", [](PyConfig& c, std::shared_ptr<PyViewer> v) { c.viewer = std::move(v); }, "viewer"_a,
          docs::viewer::set_viewer)
      .def("animate", animate,
           "Moves every joint through its limits in the browser, until a key is pressed there. Does not change q.")
      .def("animateSpline", animateSpline, "T"_a = 3, docs::viewer::animateSpline)
      .def("view_path", viewPath, "path"_a, "seconds"_a = 3., "pause"_a = false, "message"_a = nb::none(),
           docs::viewer::view_path)
      .def("watchFile", watch, "filename"_a, docs::viewer::watchFile);
}

}  // namespace

int viewOnPage(PyConfig& config, Config shown, bool pause, const std::string& message) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (!show(*viewer, message, false)) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->view(shown, pause, message, interrupted);
}

int playOnPage(PyConfig& config, const Config& shown, const ShownMotion& motion, bool pause,
               const std::string& message) {
  const std::shared_ptr<PyViewer> viewer = showIn(config);
  if (!openPage(*viewer)) return pause ? kEscape : 0;
  const nb::gil_scoped_release unlock;
  return viewer->showMotion(shown, motion, pause, message, interrupted);
}

void bindViewer(nb::module_& m, nb::class_<PyConfig>& config) {
  nb::class_<PyViewer> viewer(m, "ConfigurationViewer",
                              "Shows a configuration in the browser, and renders pictures of it.");
  viewer.def(
      "__init__",
      [](PyViewer* made) {
        new (made) PyViewer();
        made->scene = std::make_shared<SceneTree>();
      },
      docs::viewer::make);
  bindRecording(m);
  bindPage(viewer);
  bindPictures(viewer);
  bindViewerInput(m, viewer);
  bindPageContent(m, viewer);
  bindViews(config);
}

}  // namespace kinegraph::python
