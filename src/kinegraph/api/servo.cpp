#include "kinegraph/api/robot_motion.h"

#include <chrono>
#include <cmath>
#include <limits>
#include <thread>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

constexpr double kFramePeriod = 1. / 30.;  // s
constexpr Seconds kCheckPeriod(.02);       // between two checks for the end of the call

void place(Frame& frame, const VectorXd& pose) {
  if (pose.size() != 3 && pose.size() != 7)
    throw ValueError(cat("servo: the source returned ", pose.size(), " numbers; expected x y z, or x y z qw qx qy qz"));
  if (pose.size() == 7) {
    frame.setPose(Pose::fromNumbers(pose));
  } else {
    frame.setPosition(pose);
  }
}

void waitUntil(Clock::time_point end, const CancellationToken& cancellation) {
  for (auto now = Clock::now(); now < end; now = Clock::now()) {
    std::this_thread::sleep_until(std::min(end, now + std::chrono::duration_cast<Clock::duration>(kCheckPeriod)));
    cancellation.check();
  }
}

/// Steps the controller while `move` sets the target for each time.
void runServo(DiffIk& ik, Config& config, const std::function<void(double t)>& move, bool shows,
              const ServoOptions& options) {
  if (!(options.seconds > 0.) || !(options.dt > 0.))
    throw ValueError(cat("servo: seconds is ", options.seconds, ", dt is ", options.dt, "; expected numbers > 0"));
  const auto begun = Clock::now();
  double shown_at = -std::numeric_limits<double>::infinity();
  const double steps = std::round(options.seconds / options.dt);
  for (double i = 1.; i <= steps; ++i) {
    const double t = i * options.dt;
    if (move) move(t);
    if (shows && t - shown_at >= kFramePeriod) {
      if (options.view) {
        options.view(config);
      } else {
        config.view();
      }
      shown_at = t;
    }
    ik.step(options.dt);
    options.cancellation.check();
    if (options.realtime)
      waitUntil(begun + std::chrono::duration_cast<Clock::duration>(Seconds(t)), options.cancellation);
  }
}

}  // namespace

void servo(DiffIk& ik, Config& config, const std::string& target, const TargetSource& source,
           const ServoOptions& options) {
  Frame frame = config.getFrame(target);
  runServo(
      ik, config, [&](double t) { place(frame, source(t)); }, options.show.value_or(false), options);
}

void servo(DiffIk& ik, Config& config, const std::string& target, Gamepad& gamepad, const ServoOptions& options) {
  Frame frame = config.getFrame(target);
  const auto push = [&](double) { frame.setPosition(frame.getPosition() + options.dt * gamepad.velocity()); };
  runServo(ik, config, push, options.show.value_or(false), options);
}

void servo(DiffIk& ik, Config& config, const std::string& target, const ServoOptions& options) {
  config.getFrame(target);
  runServo(ik, config, nullptr, options.show.value_or(true), options);
}

}  // namespace kinegraph
