#pragma once

#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/robot/bot_op.h"

namespace kinegraph {

/// Pictures of the world of a BotOp: of a copy of it, so that the robot goes on while they are drawn.
class BotCameras {
 public:
  explicit BotCameras(const BotOp& bot) : copy_(bot.getWorld()) {}

  /// A camera of the world as it is now.
  Camera camera(const BotOp& bot, const std::string& frame);
  CameraImage image(const Camera& camera) { return renderer_.render(copy_, camera); }

 private:
  Config copy_;
  CameraRenderer renderer_;
};

}  // namespace kinegraph
