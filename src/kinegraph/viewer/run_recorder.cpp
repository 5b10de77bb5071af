#include "kinegraph/viewer/run_recorder.h"

#include <algorithm>
#include <fstream>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/recorded_page.h"

namespace kinegraph::inline viewer_internal {

RunRecorder::RunRecorder(std::string path, const ShownScene& scene) : path_(std::move(path)) {
  if (!std::ofstream(path_, std::ios::binary)) throw FileError(cat("record: '", path_, "' cannot be written"));
  run_time_ = scene.runTime();
  take(scene);
}

void RunRecorder::advance(const ShownScene& scene) {
  const Clock::time_point now = Clock::now();
  const std::optional<double> run_time = scene.runTime();
  const bool is_simulated = run_time && run_time_;
  const double passed = is_simulated ? *run_time - *run_time_ : std::chrono::duration<double>(now - now_).count();
  time_ = std::max(time_ + std::max(passed, 0.), std::exchange(reserved_, 0.));
  now_ = now;
  run_time_ = run_time;
}

void RunRecorder::take(const ShownScene& scene) {
  for (const Outgoing& message : scene.messagesSince(seen_)) appendMessage(stream_, time_, message);
  taken_ = time_;
}

void RunRecorder::add(const ShownScene& scene) {
  constexpr double kPeriod = 1. / 60.;
  advance(scene);
  if (time_ - taken_ >= kPeriod) take(scene);
}

void RunRecorder::addMotion(const ShownScene& scene, double seconds) {
  take(scene);
  reserved_ = time_ + seconds;
}

void RunRecorder::write(const ShownScene& scene) {
  advance(scene);
  take(scene);
  appendEnd(stream_, time_);
  std::ofstream file(path_, std::ios::binary);
  file << runFile(stream_);
  if (!file.flush()) throw FileError(cat("record: '", path_, "' cannot be written"));
}

}  // namespace kinegraph::inline viewer_internal
