#include "kinegraph/api/camera_view.h"

namespace kinegraph {

CameraView::CameraView(const Config& config, const RendererOptions& options)
    : scene_(config.scene()), camera_(defaultViewCamera()), renderer_(std::make_unique<CameraRenderer>(options)) {
  camera_.width = 640;
  camera_.height = 480;
}

CameraView& CameraView::setCamera(const std::string& frame) {
  const Frame found = Config(scene_).getFrame(frame);
  camera_ = cameraOf(found);
  followed_ = found;
  return *this;
}

CameraView& CameraView::setCamera(const Camera& camera) {
  camera.validate();
  camera_ = camera;
  followed_.reset();
  return *this;
}

Camera CameraView::camera() const {
  Camera now = camera_;
  if (followed_) now.pose = followed_->getPose();
  return now;
}

CameraImage CameraView::computeImageAndDepth(bool visuals_only) {
  return renderer_->render(*scene_, camera(), visuals_only);
}

std::vector<std::int32_t> CameraView::computeSegmentationID(bool visuals_only) {
  return renderer_->segment(*scene_, camera(), visuals_only);
}

}  // namespace kinegraph
