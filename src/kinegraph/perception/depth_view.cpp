#include "kinegraph/perception/register_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

constexpr double kCenterOff = .2;                   // of the size of an image; half an image has .25 or .5
constexpr double kNearCenter = .06;                 // of the size of an image, as the centers of most cameras are
constexpr int kLargest = 8192;                      // pixels
constexpr double kNearest = .005, kFarthest = 50.;  // m; another median depth is not in meters

}  // namespace

void DepthView::validate(const std::string& where) const {
  const auto fail = [&](const std::string& text) { throw ValueError(cat(where, ": ", text)); };
  if (width > kLargest || height > kLargest)
    fail(cat("an image of ", width, " x ", height, " pixels; expected at most ", kLargest, " in each direction"));
  if (width <= 0 || height <= 0 || depth.size() != std::size_t(width) * std::size_t(height))
    fail(cat("depth has ", depth.size(), " numbers; expected height x width = ", height, " x ", width));
  if (!fxycxy.allFinite() || fxycxy[0] <= 0. || fxycxy[1] <= 0.)
    fail("fxycxy has invalid focal lengths; expected fx fy cx cy in pixels, fx and fy > 0");
  const auto isOff = [](double center, int size) { return std::abs(center / size - .5) > kCenterOff; };
  if (isOff(fxycxy[2], width) || isOff(fxycxy[3], height))
    fail(cat("the center (", fxycxy[2], ", ", fxycxy[3], ") of fxycxy does not fit an image of ", width, " x ", height,
             " pixels; expected about (", .5 * width, ", ", .5 * height, "), since fxycxy scales with the image"));
  const auto isNear = [](double center, int size) { return std::abs(center / size - .5) < kNearCenter; };
  if (isNear(fxycxy[2], height) && isNear(fxycxy[3], width) && !isNear(fxycxy[2], width) && !isNear(fxycxy[3], height))
    fail(cat("the center (", fxycxy[2], ", ", fxycxy[3], ") of fxycxy is that of an image of ", height, " x ", width,
             " pixels, and depth shows ", width, " x ", height, "; expected rows from top to bottom: transpose it"));
  if (!pose.p.allFinite() || !pose.q.coeffs().allFinite()) fail("the camera's pose has non-finite numbers");
  if (!(noise > 0.) || !(bias >= 0.) || !std::isfinite(noise) || !std::isfinite(bias))
    fail(cat("noise is ", noise, " and bias ", bias, "; expected noise > 0 and bias >= 0, both in 1/m"));
  bool is_near = false;
  float nearest_far = std::numeric_limits<float>::infinity(), farthest = 0.f;
  std::vector<float> measured;
  for (std::size_t i = 0; i < depth.size(); i += 7) {
    if (!std::isfinite(depth[i]) || depth[i] <= 0.f) continue;
    measured.push_back(depth[i]);
    is_near |= depth[i] <= kFarthest;
    if (depth[i] > kFarthest) nearest_far = std::min(nearest_far, depth[i]), farthest = std::max(farthest, depth[i]);
  }
  if (measured.empty()) return;
  const auto middle = measured.begin() + std::ptrdiff_t(measured.size() / 2);
  std::nth_element(measured.begin(), middle, measured.end());
  const bool marks_holes = is_near && nearest_far == farthest;  // one number for what was not measured
  if (*middle > kFarthest && !marks_holes)
    fail(cat("the median depth is ", *middle, " m. If depths are in millimeters, pass unit=0.001"));
  if (*middle < kNearest) fail(cat("the median depth is ", *middle, " m. If depths are in meters, pass unit=1"));
}

Pose DepthView::cameraPose(const Config& config) const {
  return camera.empty() ? pose : config.getFrame(camera).getPose();
}

}  // namespace kinegraph
