#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bindings.h"
#include "kinegraph/api/viewer_pictures.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/page_content.h"
#include "kinegraph/viewer/server.h"

namespace kinegraph::python {

/// The Python object of a viewer: the page in the browser, and pictures of the same scene without a browser.
struct PyViewer : ConfigViewer {
  using ConfigViewer::ConfigViewer;
  using ConfigViewer::pictures;

  std::shared_ptr<SceneTree> scene;  ///< the shown scene

  std::vector<std::string> folders;  ///< of new controls, outermost first

 protected:
  std::shared_ptr<SceneTree> pictured() const override { return scene; }
};

constexpr int kEscape = 27;  ///< returned at once by views if the parameter `disableGui` is set

/// Opens the page, in a notebook below the cell, with the appearance of the parameters `Render/...` and visualsOnly.
/// Its camera is at a frame `camera_init` when it is first shown, always at a frame `camera_track`, and as calls of the
/// viewer set it. Returns false, without a page, if the parameter `disableGui` is set.
bool openPage(PyViewer& viewer);

/// Stores the message, and opens the page. Returns false, without a page, if `offscreen` is set or openPage opens none.
bool show(PyViewer& viewer, const std::optional<std::string>& message, bool offscreen);

/// Shows another scene, or a motion in it, on the page of `config`. As Config.view and Config.view_path.
int viewOnPage(PyConfig& config, Config shown, bool pause, const std::string& message);
int playOnPage(PyConfig& config, const Config& shown, const ShownMotion& motion, bool pause,
               const std::string& message);

/// Sets the appearance of pages and pictures to that in the parameters `Render/...`.
void takeAppearance(PyViewer& viewer);

/// Checks for Ctrl-C, which throws; otherwise returns false.
bool interrupted();

/// Binds user input on the page, and images on top of it.
void bindViewerInput(nb::module_& m, nb::class_<PyViewer>& viewer);

/// Binds what a program adds to the page: controls, drawings, plots and notifications.
void bindPageContent(nb::module_& m, nb::class_<PyViewer>& viewer);

/// Binds the picture calls of a viewer.
void bindPictures(nb::class_<PyViewer>& viewer);

/// Saves a picture as PNG: to `path` if it ends in .png, else to path + six-digit number + .png. It shows `text`, or
/// the viewer's message. Returns the file.
std::string savePicture(PyViewer& viewer, const std::string& path, int count,
                        const std::optional<std::string>& text = std::nullopt);

}  // namespace kinegraph::python
