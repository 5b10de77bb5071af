#include "kinegraph/api/viewer_pictures.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/draw_quad.h"
#include "kinegraph/viewer/page_content.h"

namespace kinegraph {

namespace {

/// Endings of pictures and films in other formats, which are no prefixes.
const std::set<std::string> kOtherPictures = {".jpg",  ".jpeg", ".gif", ".bmp", ".tif", ".tiff",
                                              ".webp", ".svg",  ".pdf", ".ppm", ".mp4", ".webm"};

PictureOptions optionsOf(const Appearance& appearance, double distance, bool has_depth) {
  return {.has_floor = appearance.has_floor,
          .shadows = appearance.shadows,
          .background = appearance.background,
          .floor_color = appearance.floor,
          .lights = appearance.lights,
          .flat_colors = appearance.flat_colors,
          .wireframe = appearance.wireframe,
          .distance = distance,
          .has_depth = has_depth};
}

}  // namespace

void ViewCamera::follow(const std::shared_ptr<SceneTree>& scene, const FrameData& frame) {
  camera_ = cameraOf(Frame(scene, *scene->frames()[std::size_t(frame.id)]));
  scene_ = scene;
  frame_ = scene->frames()[std::size_t(frame.id)];
}

Camera ViewCamera::now() {
  const std::shared_ptr<SceneTree> scene = scene_.lock();
  const std::shared_ptr<FrameData> frame = frame_.lock();
  if (scene && frame && frame->tree) camera_.pose = scene->worldPose(*frame);
  return camera_;
}

PageCamera api_internal::pageCameraOf(const Camera& camera) {
  PageCamera page{camera.pose};
  page.focal_length = camera.focal_length;
  page.ortho_height = camera.ortho_height;
  page.aspect = double(camera.width) / camera.height;
  if (camera.has_range) {
    page.near = camera.near;
    page.far = camera.far;
  }
  return page;
}

std::shared_ptr<SceneTree> ViewerPictures::scene() const {
  std::shared_ptr<SceneTree> scene = viewer_.pictured();
  if (!scene) throw ValueError("this viewer has no scene yet; call view() first");
  return scene;
}

PictureContent ViewerPictures::content(bool has_depth) {
  const std::shared_ptr<SceneTree> shown = scene();
  const Camera seen_by = camera();  // may set the distance
  return {shown,
          seen_by,
          distance_,
          viewer_.appearance(),
          has_depth ? PageDrawings::Listed() : viewer_.content()->drawings(),  // the depth is that of the scene
          viewer_.quads(),
          has_depth};
}

CameraImage ViewerPictures::draw(const PictureContent& content, const std::string& text) {
  const std::lock_guard lock(drawing_);
  const Appearance& appearance = content.appearance;
  if (!renderer_) renderer_.emplace();
  CameraImage image =
      renderer_->render(*content.scene, drawings_.shapes(content.drawings, *content.scene), content.camera,
                        optionsOf(appearance, content.distance, content.has_depth), appearance.visuals_only);
  if (!writer_) writer_.emplace();
  drawings_.write(content.drawings, *content.scene, content.camera, *writer_, image);
  for (const auto& [id, quad] : content.quads) drawQuad(image.rgb, image.width, quad);
  if (appearance.text && !appearance.visuals_only && !text.empty()) {
    constexpr int kAround = 48;  // pixels of width and height that the text does not use
    const int width = std::max(image.width - kAround, 1), height = std::max(image.height - kAround, 1);
    drawLetters(image.rgb, image.width, writer_->write(text, width, height));
  }
  return image;
}

std::string ViewerPictures::fileOf(const std::string& path, int count) {
  const std::string suffix = lowerExtension(path);
  if (kOtherPictures.contains(suffix))
    throw ValueError(cat("savePng: '", path, "' ends in ", suffix, ", but pictures are saved as PNG; end it in .png"));
  if (suffix == ".png") return path;
  if (count >= 0) saved_ = count;
  const std::string number = std::to_string(saved_++);
  return path + std::string(number.size() < 6 ? 6 - number.size() : 0, '0') + number + ".png";
}

/// Sets the initial camera to a frame `camera_init`, if there is one. Returns whether it has just been set.
bool ViewerPictures::startCamera() {
  const std::shared_ptr<SceneTree> scene = viewer_.pictured();
  FrameData* init = scene && !camera_is_set_ ? scene->find("camera_init") : nullptr;
  if (!init) return false;
  camera_.place(cameraOf(Frame(scene, *init)));
  camera_is_set_ = true;
  return true;
}

Camera ViewerPictures::camera() {
  startCamera();
  const std::shared_ptr<SceneTree> scene = viewer_.pictured();
  FrameData* tracked = scene ? scene->find("camera_track") : nullptr;
  const std::optional<PageCamera> moved = viewer_.takeViewpoint();
  if (tracked) {
    camera_.follow(scene, *tracked);
    camera_is_set_ = true;
  } else if (moved) {
    Camera camera = camera_.now();
    camera.pose = moved->pose;
    camera.focal_length = moved->focal_length;
    camera.ortho_height = moved->ortho_height;
    camera_.place(camera);
    camera_is_set_ = true;
    if (moved->distance > 0.) distance_ = moved->distance;
  }
  return camera_.now();
}

void ViewerPictures::aim(const PageCamera& page) {
  page_camera_ = page;
  if (page.distance > 0.) distance_ = page.distance;
  viewer_.setCamera(page);
}

void ViewerPictures::aimPage() {
  const bool started = startCamera();
  const Camera now = camera();
  if (!started && !camera_.follows()) return;
  const PageCamera page = pageCameraOf(now);
  if (!page_camera_ || !page.pose.numbers().isApprox(page_camera_->pose.numbers(), 1e-12)) aim(page);
}

void ViewerPictures::place(const Camera& camera, double distance) {
  camera.validate();
  camera_.place(camera);
  camera_is_set_ = true;
  PageCamera page = pageCameraOf(camera);
  if (distance > 0.) page.distance = distance;
  aim(page);
}

void ViewerPictures::follow(const Frame& frame) {
  place(cameraOf(frame));
  camera_.follow(frame.scene(), frame.data());
}

/// The page may have any aspect.
void ViewerPictures::lookFrom(const Vector3d& position, const Vector3d& target) {
  Camera now = camera();
  now.pose = lookAt(position, target);
  camera_.place(now);
  camera_is_set_ = true;
  PageCamera page{now.pose, (target - position).norm(), now.focal_length, now.ortho_height};
  page.aspect = 1.;
  aim(page);
}

void ViewerPictures::focus(const Vector3d& point, double height) {
  if (!(height > 0. && std::isfinite(height)))
    throw ValueError(cat("focus: heightAbs is ", height, " m; expected a positive number"));
  Camera now = camera();
  const Vector3d back = now.pose.p - point;
  if (back.norm() < 1e-9) throw ValueError("focus: the camera is at that position");
  const double distance = height * now.focal_length;
  now.pose = lookAt(point + distance * back.normalized(), point);
  place(now, distance);
}

Vector3d ViewerPictures::fit() {
  const Config config(scene());
  const Camera now = fitted(camera(), config);
  const std::optional<ShownBall> ball = shownBall(config);
  place(now, ball ? (ball->center - now.pose.p).norm() : 0.);
  return ball ? ball->center : Vector3d(Vector3d::Zero());
}

void ViewerPictures::resize(int width, int height) {
  Camera now = camera();
  now.width = width;
  now.height = height;
  now.validate();
  camera_.resize(width, height);
}

void ViewerPictures::reset() {
  camera_.place(defaultViewCamera());
  camera_is_set_ = false;
  page_camera_.reset();
  distance_ = PageCamera{}.distance;
}

// The methods of ConfigViewer that need pictures.

ViewerPictures& ConfigViewer::pictures() {
  if (!pictures_) {
    pictures_ = std::make_shared<ViewerPictures>(*this);
    reset_pictures_ = [pictures = pictures_.get()] { pictures->reset(); };
  }
  return *pictures_;
}

CameraImage ConfigViewer::getRgb() { return pictures().draw(pictures().content(), message()); }

CameraImage ConfigViewer::getDepth() { return pictures().draw(pictures().content(true), message()); }

std::string ConfigViewer::savePng(const std::string& path, int count) {
  CameraImage image = getRgb();
  const std::string name = pictures().fileOf(path, count);
  std::error_code failed;  // then the file cannot be written, either
  std::filesystem::create_directories(std::filesystem::path(name).parent_path(), failed);
  std::ofstream file(name, std::ios::binary);
  file << encodePng({image.width, image.height, std::move(image.rgb)}).bytes;
  if (!file.flush()) throw FileError(cat("savePng: '", name, "' cannot be written"));
  return name;
}

Camera ConfigViewer::camera() { return pictures().camera(); }

void ConfigViewer::setCamera(const Camera& camera) { pictures().place(camera); }

void ConfigViewer::setCamera(const Frame& frame) { pictures().follow(frame); }

void ConfigViewer::setCamera(const Vector3d& position, const Vector3d& target) {
  pictures().lookFrom(position, target);
}

void ConfigViewer::focus(const Vector3d& position, double height) { pictures().focus(position, height); }

Vector3d ConfigViewer::fit() { return pictures().fit(); }

void ConfigViewer::setWindow(const std::string& title, int width, int height) {
  pictures().resize(width, height);
  setTitle(title);
}

}  // namespace kinegraph
