#include "kinegraph/rendering/camera_renderer.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <optional>

#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr int kLargestImage = 8192;

std::optional<std::vector<double>> numbersOf(const Frame& frame, const char* key, std::size_t count) {
  const Node* node = frame.attributes().find(key);
  if (!node) return std::nullopt;
  std::vector<double> numbers;
  if (const double* number = node->value.as<double>()) numbers = {*number};
  if (const NumberArray* array = node->value.as<NumberArray>()) numbers = array->numbers;
  if (numbers.size() == count) return numbers;
  throw ValueError(cat("camera '", frame.getName(), "': attribute '", key, "' is ", describe(node->value),
                       "; expected ", count == 1 ? "a number" : "two numbers [near far]"));
}

std::optional<double> numberOf(const Frame& frame, const char* key) {
  const auto numbers = numbersOf(frame, key, 1);
  return numbers ? std::optional(numbers->front()) : std::nullopt;
}

}  // namespace

void Camera::validate() const {
  if (width < 1 || height < 1 || width > kLargestImage || height > kLargestImage) {
    throw ValueError(
        cat("camera: the image is ", width, " x ", height, " pixels; expected 1 to ", kLargestImage, " each"));
  }
  if (!(ortho_height >= 0.) || !std::isfinite(ortho_height)) {
    throw ValueError(
        cat("camera: the height of an orthographic image is ", ortho_height, " m; expected a positive number"));
  }
  if (!(focal_length > 0.) || !std::isfinite(focal_length)) {
    throw ValueError(cat("camera: focalLength is ", focal_length, " image heights; expected a positive number"));
  }
  if (!(near > 0. && far > near) || !std::isfinite(far)) {
    throw ValueError(cat("camera: zRange is [", near, " ", far, "] m; expected 0 < near < far"));
  }
}

bool isCamera(const Frame& frame) {
  if (frame.getShapeType() == ShapeType::camera) return true;
  constexpr const char* kWords[] = {"focalLength", "heightAngle", "orthoAbsHeight", "heightAbs",
                                    "width",       "height",      "zRange"};
  return std::any_of(std::begin(kWords), std::end(kWords),
                     [&](const char* word) { return frame.attributes().find(word) != nullptr; });
}

Camera cameraOf(const Frame& frame) {
  Camera camera;
  camera.pose = frame.getPose();
  if (const auto width = numberOf(frame, "width")) camera.width = int(std::clamp(*width, -1., 1e9));
  if (const auto height = numberOf(frame, "height")) camera.height = int(std::clamp(*height, -1., 1e9));
  if (const auto angle = numberOf(frame, "heightAngle"))
    camera.focal_length = .5 / std::tan(*angle * std::numbers::pi / 360.);
  if (const auto length = numberOf(frame, "focalLength")) camera.focal_length = *length;
  for (const char* key : {"heightAbs", "orthoAbsHeight"}) {
    if (const auto height = numberOf(frame, key)) camera.ortho_height = *height;
  }
  if (const auto range = numbersOf(frame, "zRange", 2)) {
    camera.near = range->front();
    camera.far = range->back();
    camera.has_range = true;
  }
  try {
    camera.validate();
  } catch (const ValueError& error) {
    throw ValueError(cat("frame '", frame.getName(), "' as a ", error.what()));
  }
  return camera;
}

Camera defaultViewCamera() {
  Camera camera;
  camera.pose = lookAt({2., 5., 1.7}, {0., 0., 1.});
  camera.width = 600;
  camera.height = 500;
  camera.focal_length = std::sqrt(3.);
  camera.near = .01;
  camera.far = 100.;
  return camera;
}

}  // namespace kinegraph
