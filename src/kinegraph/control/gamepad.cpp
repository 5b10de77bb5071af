#include "kinegraph/control/target_file.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

/// An event of the joystick interface of the kernel.
struct Event {
  std::uint32_t milliseconds;
  std::int16_t value;
  std::uint8_t type, number;
};
static_assert(sizeof(Event) == 8);

constexpr int kAxis = 2;      // bit of the type of stick events
constexpr double kDead = .1;  // smaller deflections, relative to the range, count as rest
constexpr double kEnd = 32767.;

}  // namespace

Gamepad::Gamepad(const std::string& device, double speed, std::array<int, 3> axes)
    : file_(open(device.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC)), speed_(speed), axes_(axes) {
  if (file_ < 0)
    throw FileError(cat("Gamepad: cannot open '", device, "': ", std::strerror(errno), "; is a gamepad connected?"));
}

Gamepad::~Gamepad() { close(); }

void Gamepad::close() {
  if (file_ >= 0) ::close(file_);
  file_ = -1;
}

Vector3d Gamepad::velocity() {
  Event event;
  while (file_ >= 0 && read(file_, &event, sizeof event) == ssize_t(sizeof event)) {
    if (!(event.type & kAxis)) continue;
    const double pushed = event.value / kEnd;
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (axes_[i] == event.number) values_[Eigen::Index(i)] = std::abs(pushed) > kDead ? pushed : 0.;
    }
  }
  return speed_ * Vector3d(values_[0], -values_[1], -values_[2]);
}

}  // namespace kinegraph
