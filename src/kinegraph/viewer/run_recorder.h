#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "kinegraph/viewer/shown_scene.h"

namespace kinegraph::inline viewer_internal {

/// Records what a viewer shows, with times: of the simulation while one is shown, else of the clock. Not synchronized.
class RunRecorder {
 public:
  /// Begins with the present scene. Throws FileError if `path` cannot be written.
  RunRecorder(std::string path, const ShownScene& scene);

  /// Records the changes since the last call, 60 times per second at most; later calls include those of skipped ones.
  void add(const ShownScene& scene);

  /// Records a motion that the scene has just got; the next change is at least so many seconds later.
  void addMotion(const ShownScene& scene, double seconds);

  /// Records the last changes, and writes the file. Throws FileError if that fails.
  void write(const ShownScene& scene);

 private:
  using Clock = std::chrono::steady_clock;
  void advance(const ShownScene& scene);
  void take(const ShownScene& scene);

  std::string path_;
  ShownScene::Seen seen_;
  std::string stream_;  ///< of timed messages, as on a saved page
  double time_ = 0., taken_ = 0., reserved_ = 0.;
  Clock::time_point now_ = Clock::now();
  std::optional<double> run_time_;  ///< of the simulation, at the last call
};

}  // namespace kinegraph::inline viewer_internal
