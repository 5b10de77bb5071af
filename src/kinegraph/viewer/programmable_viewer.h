#pragma once

#include <array>
#include <concepts>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline viewer_internal {
class PageContent;
struct PageControl;
struct PageDrawing;
}

namespace kinegraph {

/// Options of a control.
struct ControlOptions {
  std::string folder{};  ///< heading above it; "a/b": folder b in folder a
  std::string unit{};    ///< of a slider
  char key = 0;          ///< of a button: this key on the page clicks it; 0: none
};

/// A button on the page.
class ViewerButton {
 public:
  ViewerButton(std::shared_ptr<PageContent> content, std::shared_ptr<PageControl> control)
      : content_(std::move(content)), control_(std::move(control)) {}

  /// Returns whether it has been clicked since the last call. Runs callbacks that are due, before.
  bool clicked();
  /// Sets the function that a click calls, in the thread and within the calls named at `ProgrammableViewer`.
  void onClick(std::function<void()> callback);

 private:
  std::shared_ptr<PageContent> content_;
  std::shared_ptr<PageControl> control_;
};

/// A control with a value: double for sliders, bool for check boxes, std::string for choices and text fields.
template <class T>
class ViewerValue {
 public:
  ViewerValue(std::shared_ptr<PageContent> content, std::shared_ptr<PageControl> control)
      : content_(std::move(content)), control_(std::move(control)) {}

  T value() const;
  /// Sets the value, on all pages. Throws ValueError beyond a slider's range, and for an unknown option of a choice.
  void set(const T& value);
  /// Returns whether a user has changed it since the last call. Runs callbacks that are due, before.
  bool changed();
  /// Sets the function that is called with the value after a user changed it.
  void onChange(std::function<void(T)> callback);

 private:
  std::shared_ptr<PageContent> content_;
  std::shared_ptr<PageControl> control_;
};

/// Options of a drawing; each call names those that it uses.
struct DrawOptions {
  std::string frame{};                                ///< its coordinates are used; empty: the world's
  Vector4d color{.15, .39, .82, 1.};                  ///< rgba in 0..1
  std::vector<std::array<std::uint8_t, 4>> colors{};  ///< rgba of each point, instead of `color`
  double width = 3.;                                  ///< of lines, in pixels
  double size = 0.;                                   ///< m; 0: a default of the call
  std::string label{};                                ///< text beside it
};

/// An image: rgb bytes, rows from top to bottom.
struct PageImage {
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb{};
};

/// A viewer whose page a program extends by controls, drawings, plots and notifications. They appear on all pages,
/// later ones too, and in saved pages. A call with a known name replaces the drawing, or returns the same control.
///
/// Callbacks run in the program's thread, within `view`, waits for keys, `poll`, and `clicked` and `changed` of any
/// control.
class ProgrammableViewer {
 public:
  ProgrammableViewer();
  virtual ~ProgrammableViewer() = default;

  ViewerButton button(const std::string& label, const ControlOptions& options = {});
  /// Throws ValueError unless range[0] < range[1] and the initial value is between.
  ViewerValue<double> slider(const std::string& label, std::array<double, 2> range, double value,
                             const ControlOptions& options = {});
  ViewerValue<bool> check(const std::string& label, bool value = false, const ControlOptions& options = {});
  /// A list from which a user chooses one option; `value` is the initial one (empty: the first).
  ViewerValue<std::string> choice(const std::string& label, const std::vector<std::string>& options,
                                  const std::string& value = "", const ControlOptions& control = {});
  ViewerValue<std::string> text(const std::string& label, const std::string& value = "",
                                const ControlOptions& options = {});

  /// Draws an arrow from `at` (m) along `vector` (m). Options: frame, color, label; size: thickness of the shaft, m
  /// (default: 4 % of the length).
  void arrow(const std::string& name, const Vector3d& at, const Vector3d& vector, const DrawOptions& options = {});
  /// Draws a line through the points (m). Options: frame, color, colors, width.
  void line(const std::string& name, const std::vector<Vector3d>& points, const DrawOptions& options = {});
  /// Writes a text at a place (m). Options: frame.
  void label(const std::string& name, const Vector3d& at, const std::string& text, const DrawOptions& options = {});
  /// Draws points (m). Options: frame, color, colors; size: diameter, m (default: 4 pixels).
  void points(const std::string& name, const std::vector<Vector3d>& points, const DrawOptions& options = {});
  /// Draws the view of a camera (x to the right, y down, z forward): a pyramid of length `size` (default .2 m), with an
  /// image at its end. `focal_length` in heights of the image; `aspect`: width over height. Options: frame, color.
  void frustum(const std::string& name, const Pose& pose, double focal_length, double aspect,
               const PageImage& image = {}, const DrawOptions& options = {});
  /// Draws a coordinate frame: x red, y green, z blue. Options: frame, label; size: length, m (default .2).
  void axes(const std::string& name, const Pose& pose, const DrawOptions& options = {});
  /// Puts an image into the scene: its center at the pose, x to the right, y down. Options: frame; size: width, m
  /// (default .4).
  void image(const std::string& name, const PageImage& image, const Pose& pose, const DrawOptions& options = {});
  /// Removes the drawing, plot or control of that name, or the controls of a folder. Throws ValueError for other names.
  void remove(const std::string& name);

  /// Shows a text for some seconds. `level`: info, warning or error; else throws ValueError.
  void notify(const std::string& text, const std::string& level = "info");
  /// Appends a sample to a plot: one curve per number. `time` in s; without: seconds since the first call. Pages keep
  /// the last 100,000 samples. Throws ValueError unless there are as many numbers as before.
  void log(const std::string& name, const std::vector<double>& values, std::optional<double> time = std::nullopt,
           const std::string& unit = "");
  void log(const std::string& name, double value, std::optional<double> time = std::nullopt,
           const std::string& unit = "") {
    log(name, std::vector{value}, time, unit);
  }
  /// Shows an image below the plots, instead of the last one of that name. Throws ValueError without pixels.
  template <std::same_as<PageImage> Picture>
  void log(const std::string& name, const Picture& image) {
    logImage(name, image);
  }

  /// Sets the function that clicks on the scene call. An empty function ends it.
  void onClick(std::function<void(const Hit&)> callback);
  /// Runs the callbacks that are due.
  void poll();

  const std::shared_ptr<PageContent>& content() const { return content_; }

 protected:
  /// Called after each change of the content.
  virtual void contentChanged() = 0;

 private:
  template <class T>
  ViewerValue<T> valueOf(PageControl control);
  void draw(PageDrawing drawing, const DrawOptions& options);
  void logImage(const std::string& name, const PageImage& image);

  std::shared_ptr<PageContent> content_;
};

}  // namespace kinegraph
