#include "kinegraph/rendering/sun_shadows.h"

#include <algorithm>
#include <cmath>

#include "kinegraph/rendering/picture_shaders.h"
#include "kinegraph/rendering/projection.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr int kPixels = 1024;                            ///< across the map
constexpr double kSoftness = 1. / 2048;                  ///< on the map; shadows' edges are ten times as wide
constexpr double kSoft = 5. * kSoftness + 1. / kPixels;  ///< half width of a shadow's edge on the map, and a pixel
constexpr double kBias = .0002;                          ///< share of the depth, as in the shader

}  // namespace

SunShadows::SunShadows() : program_(shaders::kShadowVertex, shaders::kDepthFragment), frame_(GlFrame::Colors::none) {
  const GlFunctions& f = glFunctions();
  f.BindTexture(gl::kTexture2D, frame_.depth());
  f.TexParameteri(gl::kTexture2D, gl::kCompareMode, int(gl::kCompareToReference));
  f.TexParameteri(gl::kTexture2D, gl::kCompareFunction, int(gl::kLessOrEqual));
}

void SunShadows::place(const PictureView& view) {
  const Vector3d center = view.scene.center;
  const double radius = view.scene.radius, reach = std::max(1.1 * radius, std::min(1., 8. * radius));
  normal_bias_ = .006 * std::min(1., reach) * std::max(1., reach / 12.);
  Camera sun;
  sun.pose = lookAt(center + 2. * reach * view.towardsSun(), center);
  sun.width = sun.height = kPixels;
  sun.ortho_height = 2. * reach;
  sun.near = .1 * reach;
  sun.far = 4. * reach;
  to_map_ = projection(sun);
  Eigen::Matrix4d to_unit = .5 * Eigen::Matrix4d::Identity();
  to_unit.col(3) = Eigen::Vector4d(.5, .5, .5, 1.);
  to_shadow_ = to_unit * to_map_;
}

/// Clears a part of the map; the whole map the first time.
void SunShadows::clear(const Vector3d& lower, const Vector3d& upper) {
  const GlFunctions& f = glFunctions();
  if (is_clear_) {
    const auto pixel = [](double share) { return int(std::clamp(share * kPixels, 0., double(kPixels))); };
    const int x = pixel(lower.x()), y = pixel(lower.y());
    f.Enable(gl::kScissorTest);
    f.Scissor(x, y, pixel(upper.x()) + 1 - x, pixel(upper.y()) + 1 - y);
  }
  f.Clear(gl::kDepthBit);
  f.Disable(gl::kScissorTest);
  is_clear_ = true;
}

/// Primitives show it their backs only, against shadows on their fronts by rounding. Meshes have triangles for
/// both sides, unless they are closed.
void SunShadows::draw(const PictureView& view) {
  const GlFunctions& f = glFunctions();
  place(view);
  std::vector<Caster> casters;
  const Vector3d last_lower = lower_, last_upper = upper_;
  lower_ = Vector3d::Ones();
  upper_ = Vector3d::Zero();
  for (const PictureItem& item : view.scene.items) {
    if (!item.castsShadow()) continue;
    casters.emplace_back(item.stored->serial, to_map_ * item.pose);
    for (const Vector3d& p : item.corners()) {
      const Vector3d on_map = (to_shadow_ * p.homogeneous()).head<3>();
      lower_ = lower_.cwiseMin(on_map);
      upper_ = upper_.cwiseMax(on_map);
    }
  }
  if (casters == drawn_ && is_clear_) return;
  frame_.use(kPixels, kPixels);
  clear(lower_.cwiseMin(last_lower), upper_.cwiseMax(last_upper));
  program_.use();
  f.Enable(gl::kCullFace);
  std::size_t index = 0;
  for (const PictureItem& item : view.scene.items) {
    if (!item.castsShadow()) continue;
    f.CullFace(item.stored->mesh.is_file ? gl::kBack : gl::kFront);
    program_.set("to_map", casters[index++].second);
    f.BindVertexArray(item.stored->array);
    for (const PictureMesh::Part& part : item.stored->mesh.parts) drawTriangles(part);
  }
  drawn_ = std::move(casters);
}

void SunShadows::describe(GlProgram& program, bool has_shadows) const {
  const bool any = has_shadows && !drawn_.empty();
  program.set("to_shadow", to_shadow_);
  program.set("softness", kSoftness);
  program.set("normal_bias", normal_bias_);
  program.set("shade_from", any ? Vector3d(lower_ - Vector3d(kSoft, kSoft, kBias)) : Vector3d(2., 2., 2.));
  program.set("shade_to", Vector3d(upper_.x() + kSoft, upper_.y() + kSoft, 1.));
}

FloorPart SunShadows::shadedFloor(const PictureView& view) const {
  const double height = view.floorHeight();
  constexpr double kLeastRise = .02;  // of the sun
  const Eigen::Matrix4d from_shadow = to_shadow_.inverse();
  const Vector3d away = from_shadow.col(2).head<3>().normalized();  // from the sun
  if (std::abs(away.z()) < kLeastRise) return view.wholeFloor(height);
  const auto along = [&](const Eigen::Vector4d& on_map, double z) {
    const Vector3d p = (from_shadow * on_map).head<3>();
    return Vector3d(p + (z - p.z()) / away.z() * away);
  };
  const Vector3d middle = .5 * (lower_ + upper_), half = .5 * (upper_ - lower_).array() + kSoft;
  return {along({middle.x(), middle.y(), 0., 1.}, height), along({half.x(), 0., 0., 0.}, 0.),
          along({0., half.y(), 0., 0.}, 0.)};
}

}  // namespace kinegraph::inline rendering_internal
