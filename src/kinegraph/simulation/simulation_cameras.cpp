#include <bit>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/rendering/camera_renderer.h"
#include "kinegraph/simulation/simulation_impl.h"

namespace kinegraph {

void Simulation::addSensor(const std::string& name, const std::string& frame) {
  const std::string& at = frame.empty() ? name : frame;
  const Frame found = impl_->config.getFrame(at);
  cameraOf(found).validate();
  impl_->cameras.insert_or_assign(name, found);
  impl_->selected_camera = name;
}

void Simulation::selectSensor(const std::string& name) {
  if (!impl_->cameras.contains(name)) {
    std::vector<std::string> names;
    for (const auto& [known, frame] : impl_->cameras) names.push_back(known);
    throw NameError(cat("Simulation.selectSensor: there is no sensor '", name, "'; call addSensor first",
                        names.empty() ? "" : cat("; existing sensors: ", join(names)), similarHint(name, names)));
  }
  impl_->selected_camera = name;
}

void Simulation::setCamera(const std::string& frame) { addSensor(frame); }

Camera Simulation::camera() const {
  const auto found = impl_->cameras.find(impl_->selected_camera);
  if (found != impl_->cameras.end()) return cameraOf(found->second);
  Camera camera = defaultViewCamera();
  camera.width = 640;
  camera.height = 480;
  return camera;
}

void Simulation::setSimulateDepthNoise(bool noisy) { impl_->has_depth_noise = noisy; }

CameraImage Simulation::getImageAndDepth(const DepthNoise& noise) {
  Impl& s = *impl_;
  const Camera at = camera();
  if (!s.renderer) s.renderer = std::make_unique<CameraRenderer>();
  CameraImage image = s.renderer->render(s.config, at);
  if (!s.has_depth_noise) return image;
  noise.validate();
  const CameraImage other = s.renderer->render(s.config, otherEye(at, noise));
  Rng rng(std::bit_cast<std::uint64_t>(s.world->time()));
  addDepthNoise(image.depth, other.depth, at, noise, rng);
  return image;
}

}  // namespace kinegraph
