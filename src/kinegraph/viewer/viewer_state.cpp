#include "kinegraph/viewer/viewer_state.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/viewer/recorded_page.h"

namespace kinegraph::inline viewer_internal {

void ViewerState::press(const KeyCommand& command) {
  constexpr int kRight = 262, kLeft = 263;
  if (command.code <= 0 || command.code > 1000) return;
  {
    const std::lock_guard lock(mutex);
    key = command.code;
    key_releases = command.modifiers == 0 && key != kRight && key != kLeft;
  }
  changed.notify_all();
}

void ViewerState::addEvent(const EventCommand& event) {
  const std::lock_guard lock(mutex);
  events.add(event);
}

void ViewerState::moveCursor(const CursorCommand& command) {
  const std::lock_guard lock(mutex);
  if (command.point.empty() && cursor) cursor->frame = -1;  // over the background
  if (command.point.size() != 3 || command.normal.size() != 3) return;
  cursor = {command.frame, Vector3d(command.point.data()), Vector3d(command.normal.data())};
}

/// Sets the camera; invalid cameras are ignored.
void ViewerState::moveCamera(const ViewpointCommand& command) {
  const auto isFinite = [](double x) { return std::isfinite(x); };
  if (command.pose.size() != 7 || !std::all_of(command.pose.begin(), command.pose.end(), isFinite)) return;
  PageCamera moved{{}, command.distance, command.focal, command.ortho};
  moved.pose.p = Vector3d(command.pose.data());
  const Vector4d wxyz(&command.pose[3]);
  if (std::abs(wxyz.norm() - 1.) > .01) return;
  moved.pose.q = Quaterniond(wxyz[0], wxyz[1], wxyz[2], wxyz[3]).normalized();
  if (!(isFinite(moved.focal_length) && moved.focal_length > 0.)) return;
  if (!(isFinite(moved.ortho_height) && moved.ortho_height >= 0.)) return;
  const std::lock_guard lock(mutex);
  camera = moved;
  camera_moved = true;
}

/// Invalid clicks, and those on frames that are gone, are ignored.
void ViewerState::click(const ClickCommand& command) {
  if (command.point.size() != 3 || command.normal.size() != 3) return;
  const std::lock_guard lock(mutex);
  const std::string frame = scene.nameOf(command.frame);
  if (frame.empty() || !scene.content) return;
  scene.content->click({frame, Vector3d(command.point.data()), Vector3d(command.normal.data())});
}

void ViewerState::steerRun(const RunCommand& command) {
  {
    const std::lock_guard lock(mutex);
    if (!run.apply(command)) return;
  }
  changed.notify_all();
}

void ViewerState::perturb(const PerturbCommand& command) {
  {
    const std::lock_guard lock(mutex);
    if (!run.apply(command)) return;
  }
  changed.notify_all();
}

void ViewerState::addClient() {
  {
    const std::lock_guard lock(mutex);
    ++clients;
  }
  changed.notify_all();
}

void ViewerState::removeClient() {
  const std::lock_guard lock(mutex);
  if (--clients == 0) run.perturbation.reset();  // no browser is left to drag the point
}

std::vector<Outgoing> ViewerState::messagesSince(ShownScene::Seen& seen) const {
  const std::lock_guard lock(mutex);
  return scene.messagesSince(seen);
}

std::string ViewerState::recording(std::size_t largest) const {
  const std::lock_guard lock(mutex);
  return recordedPage(scene, largest);
}

}  // namespace kinegraph::inline viewer_internal
