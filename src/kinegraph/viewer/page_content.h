#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "kinegraph/math/pose.h"
#include "kinegraph/viewer/messages/shown.h"
#include "kinegraph/viewer/outgoing.h"

namespace kinegraph::inline viewer_internal {

struct ControlCommand;

/// A control on the page. A `PageContent` guards its changing fields.
struct PageControl {
  enum class Kind { button, slider, check, choice, text };
  Kind kind = Kind::button;
  std::string label, folder, unit;
  char key = 0;                   ///< of a button; 0: none
  double lower = 0., upper = 1.;  ///< range of a slider
  std::vector<std::string> options{};
  double number = 0.;  ///< of a slider; 0 or 1 of a check box
  std::string text{};  ///< of a text field or a choice

  int id = 0;
  int clicks = 0;        ///< of a button, since the program asked
  bool changed = false;  ///< by a browser, since the program asked
  int calls = 0;         ///< calls of `callback` that are due
  std::shared_ptr<const std::function<void()>> callback{};

  /// Returns the label with the folder before it, as `remove` expects it.
  std::string name() const { return folder.empty() ? label : folder + "/" + label; }
};

/// A drawing in the scene, in the coordinates of a frame or of the world.
struct PageDrawing {
  std::string name, type;  ///< type: arrow, line, label, points, frustum, axes, image; log: an image beside it
  std::string frame{}, text{};
  std::vector<Vector3d> points{};
  std::vector<std::array<std::uint8_t, 4>> colors{};  ///< rgba; one, or one per point
  double width = 0., size = 0.;                       ///< pixels, m
  Pose pose{};
  double focal_length = 0., aspect = 1.;
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> rgb{};
};

/// Content of the page beside the scene: controls, drawings, plots and notifications of a program. Threads may share
/// it.
/// Callbacks are never called, copied or destroyed while a thread waits for it: those of Python need the interpreter.
class PageContent {
 public:
  /// The content of one browser.
  struct Seen {
    std::uint64_t revision = 0, samples = 0;
  };

  /// Adds a control, or returns the one of this kind with the same label and folder. Throws ValueError if that one is
  /// of another kind.
  std::shared_ptr<PageControl> add(PageControl control);
  void draw(PageDrawing drawing);
  /// Returns the drawings, by name; each object stays the same until it is replaced.
  std::vector<std::shared_ptr<const PageDrawing>> drawings() const;
  /// Appends a sample to the plot of that name. Throws ValueError unless it has as many numbers as earlier ones.
  void log(const std::string& name, double time, const std::vector<double>& values, const std::string& unit);
  /// Returns the seconds since the first sample.
  double now();
  void notify(const std::string& text, const std::string& level);
  /// Removes the drawing, plot or control of that name, or all controls of a folder. Throws ValueError if there is
  /// none.
  void remove(const std::string& name);

  /// Applies a value that a browser sets; values beyond the range, and unknown options, are ignored.
  bool apply(const ControlCommand& command);
  void click(const Hit& hit);
  void onClick(std::function<void(const Hit&)> callback);

  /// Runs the callbacks that are due, in this thread.
  void runCallbacks();

  /// Sets the function that updates the browsers after `change`; empty: they are updated at their next message.
  void onChange(std::function<void()> update);

  /// Calls `use` while no other thread accesses the content, then updates the browsers.
  template <class Use>
  void change(const Use& use) {
    std::function<void()> update;
    {
      const std::lock_guard lock(mutex_);
      use();
      controls_revision_ = ++revision_;
      update = on_change_;
    }
    if (update) update();
  }
  template <class Use>
  auto read(const Use& use) const {
    const std::lock_guard lock(mutex_);
    return use();
  }

  /// Appends the messages that update a browser from `seen` to the present, and updates `seen`.
  void addMessages(Seen& seen, std::vector<Outgoing>& out) const;

 private:
  using Clock = std::chrono::steady_clock;
  struct Drawn {
    std::uint64_t revision = 0;
    std::shared_ptr<const PageDrawing> drawing{};  ///< null: removed
    std::vector<Outgoing> messages{};
  };
  struct Series {
    int id;
    std::size_t size;  ///< numbers per sample
    std::string unit;
  };
  struct Sample {
    int series;
    double time;
    std::vector<double> values;
  };
  struct Notification {
    std::uint64_t revision;
    Clock::time_point time;
    Outgoing message;
  };
  std::vector<std::string> names() const;

  mutable std::mutex mutex_;
  std::uint64_t revision_ = 1, controls_revision_ = 0, series_revision_ = 0;
  int next_id_ = 1;
  std::vector<std::shared_ptr<PageControl>> controls_;
  std::map<std::string, Drawn> drawings_;
  std::map<std::string, Series> series_;
  std::deque<Sample> samples_;
  std::uint64_t dropped_ = 0;  ///< number of samples before the first of `samples_`
  std::optional<Clock::time_point> start_;
  std::deque<Notification> notifications_;
  std::deque<Hit> hits_;
  std::shared_ptr<const std::function<void(const Hit&)>> on_click_;
  std::function<void()> on_change_;
};

}  // namespace kinegraph::inline viewer_internal
