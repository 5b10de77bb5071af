// The parts of BotOp that need the upper rooms: pictures and a viewer.
#include "kinegraph/api/bot_cameras.h"

#include "kinegraph/api/bot_stage.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/robot/drivers.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

std::shared_ptr<RobotDriver> simulated(const Config& config, bool use_real_robot) {
  if (use_real_robot) throw ValueError("BotOp: a real robot needs a driver; see RobotDriver");
  return std::make_shared<SimulatedDriver>(config);
}

BotOpOptions shownOnPages(const Config& config) {
  BotOpOptions options;
  const auto stage = std::make_shared<BotStage>(config.scene()->viewer, [] { return false; });
  options.show = [stage](const BotOp& bot, Config& shown, const std::string& message) {
    return stage->show(bot, shown, shown.scene()->viewer, message);
  };
  options.watched = [stage] { return stage->isWatched(); };
  return options;
}

}  // namespace

Camera BotCameras::camera(const BotOp& bot, const std::string& frame) {
  if (!copy_.findFrame(frame)) copy_ = bot.getWorld();  // the frame may be newer than the copy
  bot.update(copy_);
  const Frame at = copy_.getFrame(frame);
  if (!isCamera(at))
    throw ValueError(cat("BotOp: frame '", frame, "' is no camera; give it the shape camera, or the attributes ",
                         "focalLength, width and height"));
  return cameraOf(at);
}

BotOp::BotOp(Config& config, bool use_real_robot)
    : BotOp(config, simulated(config, use_real_robot), shownOnPages(config)) {}

BotCameras& BotOp::cameras() {
  if (!cameras_) cameras_ = std::make_shared<BotCameras>(*this);
  return *cameras_;
}

CameraImage BotOp::getImageAndDepth(const std::string& camera) {
  return cameras().image(cameras().camera(*this, camera));
}

Vector4d BotOp::getCameraFxycxy(const std::string& camera) { return cameras().camera(*this, camera).fxycxy(); }

std::pair<CameraImage, std::vector<double>> BotOp::getImageDepthPcl(const std::string& camera,
                                                                    bool global_coordinates) {
  const Camera from = cameras().camera(*this, camera);
  CameraImage image = cameras().image(from);
  std::vector<double> points = depthToPoints(image.depth.data(), image.height, image.width, from.fxycxy());
  if (global_coordinates) {
    for (std::size_t i = 0; i + 2 < points.size(); i += 3) {
      Eigen::Map<Vector3d> point(&points[i]);
      point = from.pose.p + from.pose.q * Vector3d(point);
    }
  }
  return {std::move(image), std::move(points)};
}

}  // namespace kinegraph
