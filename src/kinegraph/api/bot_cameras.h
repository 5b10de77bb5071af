#pragma once

#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/robot/bot_op.h"

namespace kinegraph::inline api_internal {

/// Renders the world of a BotOp from a copy, so that the robot is not delayed.
class BotCameras {
 public:
  explicit BotCameras(const BotOp& bot) : copy_(bot.getWorld()) {}

  /// Returns a camera of the present world.
  Camera camera(const BotOp& bot, const std::string& frame);
  CameraImage image(const Camera& camera) { return renderer_.render(copy_, camera); }

 private:
  Config copy_;
  CameraRenderer renderer_;
};

}  // namespace kinegraph::inline api_internal
