#include "kinegraph/api/recorded_motion.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/recorded_page.h"

namespace kinegraph {

namespace {

constexpr double kRate = 50.;     ///< slices per s
constexpr int kMaxSlices = 1500;  ///< slices

/// Returns the time from the start to the end of each step, s.
std::vector<double> elapsed(const Recording& recording) {
  std::vector<double> ends;
  double before = recording.start.time, sum = 0.;
  for (const double time : recording.times) {
    if (time > before) sum += time - before;  // else the time was set back
    ends.push_back(sum);
    before = time;
  }
  return ends;
}

}  // namespace

ShownMotion recordedMotion(const Recording& recording) {
  if (recording.times.empty()) throw ValueError("Recording: it has no steps");
  const std::vector<double> ends = elapsed(recording);
  const double seconds = ends.back();
  const int slices = std::clamp(int(std::ceil(seconds * kRate - 1e-6)) + 1, 2, kMaxSlices);
  ShownMotion motion;
  motion.seconds = seconds;
  motion.start = ShownMotion::Start::play;
  motion.q.resize(slices, recording.q[0].size());
  std::vector<std::size_t> steps;
  std::size_t step = 0;
  for (int i = 0; i < slices; ++i) {
    while (step + 1 < ends.size() && ends[step] < i * seconds / (slices - 1) - 1e-9) ++step;
    steps.push_back(step);
    motion.q.row(i) = recording.q[step].transpose();
  }
  motion.poses = recording.framePoses(steps);
  return motion;
}

void Recording::saveHtml(const std::string& path, const std::string& client) const {
  const ShownMotion motion = recordedMotion(*this);
  savePage(recordedScene(makeConfig(), &motion, "Simulation"), path, client);
}

}  // namespace kinegraph
