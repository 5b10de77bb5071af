// A libFuzzer target for what browsers say to the viewer: messages one after the other, each with its length in front.
// Any bytes are a command or nothing, the joints of the scene stay within their limits, its poses
// finite, and the camera is one.
#include <cmath>
#include <cstdint>
#include <cstdlib>

#include "kinegraph/kinematics/state.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/access.h"
#include "kinegraph/viewer/client_page.h"
#include "kinegraph/viewer/scene_edits.h"
#include "kinegraph/viewer/viewer_state.h"

namespace kinegraph {

std::string_view clientPage() { return "<!-- RECORDING -->"; }

}  // namespace kinegraph

using namespace kinegraph;

namespace {

constexpr int kStructure = 1;

Config makeScene() {
  Config config;
  config.addText(
      "base: { pose: [0 0 1] }\n"
      "arm (base): { joint: hingeX, limits: [-1 2], q: .5, shape: box, size: [.1 .1 .4] }\n"
      "ball (arm): { joint: quatBall, pre: [0 0 .3], shape: sphere, size: [.1] }\n"
      "loose (base): { joint: free, shape: ssBox, size: [.2 .2 .2 .02] }\n");
  return config;
}

void check(bool is_true) {
  if (!is_true) std::abort();
}

/// Handles a message as the server does.
void receive(std::string_view message, SceneEdits& edits, ViewerState& state, Config& config) {
  Access{true, "token"}.allows(message, message, message);
  const std::optional<Command> command = readCommand(message);
  if (!command) return;
  if (const auto* key = std::get_if<KeyCommand>(&*command)) state.press(*key);
  if (const auto* event = std::get_if<EventCommand>(&*command)) state.addEvent(*event);
  if (const auto* cursor = std::get_if<CursorCommand>(&*command)) state.moveCursor(*cursor);
  if (const auto* viewpoint = std::get_if<ViewpointCommand>(&*command)) state.moveCamera(*viewpoint);
  edits.apply(*command);
  edits.takeInto(config);
  check(edits.margin() >= 0.);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const Config scene = makeScene();
  Config config(scene);
  SceneEdits edits;
  edits.setScene(config.scene()->snapshot(), kStructure);
  ViewerState state;
  std::string_view rest(reinterpret_cast<const char*>(data), size);
  while (!rest.empty()) {
    const std::size_t length = std::min<std::size_t>(static_cast<unsigned char>(rest[0]), rest.size() - 1);
    receive(rest.substr(1, length), edits, state, config);
    rest.remove_prefix(1 + length);
  }
  const VectorXd q = config.getJointState();
  check(q.allFinite());
  check(q[0] >= -1. && q[0] <= 2.);
  for (int i = 0; i < config.getFrameDimension(); ++i) check(Pose(config.state().pose(i)).numbers().allFinite());
  if (state.camera) {
    check(state.camera->pose.numbers().allFinite() && std::abs(state.camera->pose.q.norm() - 1.) < 1e-9);
    check(std::isfinite(state.camera->distance) && state.camera->focal_length > 0. && state.camera->ortho_height >= 0.);
  }
  return 0;
}
