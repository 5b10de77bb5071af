#include "kinegraph/rendering/picture_view.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/rendering/projection.h"

namespace kinegraph::inline rendering_internal {

namespace {

// The numbers of the page: viewer/src/lights.ts, floor.ts, stage.ts and viewpoint.ts.
constexpr double kFogFrom = 9., kFogTo = 28.;  ///< m, for usual scenes
constexpr double kFloorDepth = .001;           ///< of the lines below z = 0: they hide no bottoms of shapes
constexpr double kLinesReach = 14.;            ///< squares around the camera, as in the shader
const Vector3d kTowardsSun(-2.5, 2.2, 4.5), kTowardsFill(3., -2., 2.5), kCenterOfLights(0., 0., .8);
constexpr double kSunlight = 2.35, kSkylight = 1.85;  ///< intensities

/// Converts a color 0xrrggbb, times an intensity.
Vector3d light(unsigned rgb, double intensity) {
  return intensity * linearColor(Vector3d(rgb >> 16, rgb >> 8 & 255, rgb & 255) / 255.);
}

}  // namespace

PictureView::PictureView(PictureScene shown, const Camera& shown_by, const PictureOptions& chosen)
    : scene(std::move(shown)), camera(shown_by), options(chosen) {
  camera.width *= kFiner;
  camera.height *= kFiner;
  if (camera.has_range) return;
  const double reach = (camera.pose.p - scene.center).norm() + scene.radius;
  camera.near = std::min(std::max(.01, .002 * reach), .02 * options.distance);
  camera.far = std::max(200., 4. * reach);
}

void PictureView::describe(GlProgram& program) const {
  const double reach = (camera.pose.p - scene.center).norm() + scene.radius, fog = std::max(kFogFrom, reach);
  program.set("fog_color", background());
  program.set("fog", Eigen::Vector2d(fog, kFogTo / kFogFrom * fog));

  const Matrix3d R = camera.pose.q.toRotationMatrix();
  const bool is_orthographic = camera.ortho_height > 0.;
  const double half = .5 * (is_orthographic ? camera.ortho_height : 1. / camera.focal_length);
  program.set("to_image", projection(camera));
  program.set("eye", camera.pose.p);
  program.set("forward", Vector3d(R.col(2)));
  program.set("to_right", Vector3d(half * camera.width / camera.height * R.col(0)));
  program.set("to_bottom", Vector3d(half * R.col(1)));
  program.set("is_orthographic", is_orthographic ? 1. : 0.);
  program.set("range", Eigen::Vector2d(camera.near, camera.far));
  program.set("size", Eigen::Vector2d(camera.width, camera.height));

  std::vector<Vector3d> towards{towardsSun()}, strength{light(0xfff6ea, kSunlight)};
  for (std::size_t i = 1; i < options.lights.size(); ++i) {
    towards.push_back((options.lights[i] - kCenterOfLights).normalized());
    strength.push_back(Vector3d::Constant(1.2));
  }
  if (options.lights.empty()) {
    towards.push_back(kTowardsFill.normalized());
    strength.push_back(light(0xe3ebff, .55));
  }
  program.set("sky", light(0xf6f9ff, kSkylight));
  program.set("ground", light(0x7d7b7a, kSkylight));
  program.set("towards", towards);
  program.set("strength", strength);

  const bool is_bright = linearColor(background()).dot(Vector3d(.2, .7, .1)) > .2;
  program.set("square", square());
  program.set("floor_height", floorHeight());
  program.set("ink", is_bright ? Vector3d(.17, .2, .24) : Vector3d(.5, .54, .6));
  program.set("has_floor", options.has_floor ? 1. : 0.);
  program.set("has_glass", scene.has_transparent ? 1. : 0.);

  program.set("picture", int(PictureTextures::kPicture));
  program.set("shadow_map", int(PictureTextures::kShadowMap));
  program.set("samples", int(PictureTextures::kSamples));
  program.set("depths", int(PictureTextures::kDepths));
  program.set("glass", int(PictureTextures::kGlass));
}

/// The page's background in daylight, unless another is given.
Vector3d PictureView::background() const { return options.background.value_or(Vector3d(0xdf, 0xe3, 0xea) / 255.); }

Vector3d PictureView::towardsSun() const {
  return (options.lights.empty() ? kTowardsSun : Vector3d(options.lights[0] - kCenterOfLights)).normalized();
}

int PictureView::lights() const { return options.lights.empty() ? 2 : int(options.lights.size()); }

double PictureView::square() const { return std::pow(10., std::floor(std::log10(std::max(options.distance, 1e-6)))); }

double PictureView::floorHeight() const { return -kFloorDepth * std::min(square(), 1.); }

FloorPart PictureView::floorAround(double half, double height) const {
  return {{camera.pose.p.x(), camera.pose.p.y(), height}, half * Vector3d::UnitX(), half * Vector3d::UnitY()};
}

FloorPart PictureView::wholeFloor(double height) const {
  return floorAround(std::max(30. * square(), (camera.pose.p - scene.center).norm() + 1.1 * scene.radius), height);
}

FloorPart PictureView::linedFloor() const { return floorAround(kLinesReach * square(), floorHeight()); }

}  // namespace kinegraph::inline rendering_internal
