#include "kinegraph/rendering/picture_renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/rendering/gl_program.h"
#include "kinegraph/rendering/picture_shaders.h"
#include "kinegraph/rendering/picture_store.h"
#include "kinegraph/rendering/projection.h"
#include "kinegraph/rendering/shown_shapes.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

// The numbers of the page: viewer/src/lights.ts, floor.ts, stage.ts and viewpoint.ts.
constexpr int kFiner = 2;  ///< drawn pixels per pixel and direction, against aliasing
constexpr int kShadowPixels = 2048;
constexpr double kFogFrom = 9., kFogTo = 28.;       ///< m, for usual scenes
constexpr double kFloorDepth = .001;                ///< of the lines below z = 0: they hide no bottoms of shapes
constexpr double kLineWidth = 2., kPointSize = 4.;  ///< pixels
const Vector3d kSun(-2.5, 2.2, 4.5), kFill(3., -2., 2.5), kCenterOfLights(0., 0., .8);
const Vector4d kUsualColor(.8, .8, .8, 1.);
constexpr double kSunlight = 2.35, kSkylight = 1.85;  ///< intensities

/// The page's background in daylight.
Vector3d paper() { return Vector3d(0xdf, 0xe3, 0xea) / 255.; }

/// Converts a color 0xrrggbb, times an intensity.
Vector3d light(unsigned rgb, double intensity) {
  return intensity * linearColor(Vector3d(rgb >> 16, rgb >> 8 & 255, rgb & 255) / 255.);
}

}  // namespace

void PictureOptions::validate() const {
  constexpr std::size_t kMaxLights = 8;
  if (lights.size() > kMaxLights)
    throw ValueError(cat("picture: ", lights.size(), " lights; expected at most ", kMaxLights));
  if (!(distance > 0. && std::isfinite(distance)))
    throw ValueError(cat("picture: the distance is ", distance, " m; expected a positive number"));
}

struct PictureRenderer::Impl {
  ~Impl();
  CameraImage render(SceneTree& tree, Camera camera, const PictureOptions& options, bool visuals_only);

  std::optional<GlContext> context;

 private:
  /// A shape at its pose.
  struct Item {
    const StoredMesh* stored;
    Eigen::Matrix4d pose;
    Vector4d color;
    bool is_symbol, has_color;
  };
  struct Programs {
    GlProgram surface{shaders::kSurfaceVertex, std::string(shaders::kCommon) + shaders::kSurfaceFragment};
    GlProgram shadow{shaders::kSurfaceVertex, shaders::kShadowFragment};
    GlProgram lines{shaders::kLineVertex, std::string(shaders::kCommon) + shaders::kTintFragment};
    GlProgram points{shaders::kPointVertex, std::string(shaders::kCommon) + shaders::kTintFragment};
    GlProgram floor{shaders::kFloorVertex, std::string(shaders::kCommon) + shaders::kFloorFragment};
    PictureStore store;
  };

  void prepare(int width, int height);
  void collect(SceneTree& tree, bool visuals_only);
  void findBall();
  void fitRange(Camera& camera, double distance) const;
  void drawShadows(const PictureOptions& options);
  void setView(const Camera& camera, const PictureOptions& options);
  void drawItem(const Item& item, const PictureOptions& options);
  void drawSurface(const Item& item, const PictureOptions& options);
  void drawFloor(const Camera& camera, const PictureOptions& options);
  void drawSolidFloor(const Camera& camera, const PictureOptions& options);

  std::optional<Programs> programs;
  VisualMeshes visual_meshes;
  std::vector<Item> items;
  Vector3d center = Vector3d::Zero();  ///< of a ball around all items
  double radius = 1.;
  Vector3d towards_sun;
  Eigen::Matrix4d to_shadow;
  double normal_bias = 0.;
  unsigned frame = 0, color = 0, depth = 0, shadow_frame = 0, shadow_map = 0;
  int frame_width = 0, frame_height = 0;
};

PictureRenderer::Impl::~Impl() {
  if (!context) return;
  try {
    const GlContext::Use use(*context);
    programs.reset();
    if (!frame) return;
    const GlFunctions& f = glFunctions();
    for (const unsigned buffer : {frame, shadow_frame}) f.DeleteFramebuffers(1, &buffer);
    for (const unsigned buffer : {color, depth}) f.DeleteRenderbuffers(1, &buffer);
    f.DeleteTextures(1, &shadow_map);
  } catch (const Error&) {  // the driver has gone, and its memory with it
  }
}

/// Makes the programs, the shadow map and an image of at least that size.
void PictureRenderer::Impl::prepare(int width, int height) {
  const GlFunctions& f = glFunctions();
  if (!programs) {
    programs.emplace();
    f.GenFramebuffers(1, &frame);
    f.GenFramebuffers(1, &shadow_frame);
    f.GenRenderbuffers(1, &color);
    f.GenRenderbuffers(1, &depth);
    f.GenTextures(1, &shadow_map);
    f.BindTexture(gl::kTexture2D, shadow_map);
    f.TexImage2D(gl::kTexture2D, 0, int(gl::kDepth24), kShadowPixels, kShadowPixels, 0, gl::kDepthComponent, gl::kFloat,
                 nullptr);
    for (const unsigned filter : {gl::kMinFilter, gl::kMagFilter})
      f.TexParameteri(gl::kTexture2D, filter, int(gl::kLinear));
    for (const unsigned direction : {gl::kWrapS, gl::kWrapT})
      f.TexParameteri(gl::kTexture2D, direction, int(gl::kClampToEdge));
    f.TexParameteri(gl::kTexture2D, gl::kCompareMode, int(gl::kCompareToReference));
    f.TexParameteri(gl::kTexture2D, gl::kCompareFunction, int(gl::kLessOrEqual));
    f.BindFramebuffer(gl::kFramebuffer, shadow_frame);
    f.FramebufferTexture2D(gl::kFramebuffer, gl::kDepthAttachment, gl::kTexture2D, shadow_map, 0);
    f.DrawBuffer(gl::kNone);
    f.ReadBuffer(gl::kNone);
  }
  f.BindFramebuffer(gl::kFramebuffer, frame);
  if (width <= frame_width && height <= frame_height) return;
  frame_width = std::max(width, frame_width);
  frame_height = std::max(height, frame_height);
  for (const auto& [buffer, format, place] :
       {std::tuple(color, gl::kRgba8, gl::kColorAttachment), std::tuple(depth, gl::kDepth32F, gl::kDepthAttachment)}) {
    f.BindRenderbuffer(gl::kRenderbuffer, buffer);
    f.RenderbufferStorage(gl::kRenderbuffer, format, frame_width, frame_height);
    f.FramebufferRenderbuffer(gl::kFramebuffer, place, gl::kRenderbuffer, buffer);
  }
  if (f.CheckFramebufferStatus(gl::kFramebuffer) != gl::kComplete)
    throw Error(cat("the OpenGL driver cannot draw pictures of ", width, " x ", height, " pixels"));
}

void PictureRenderer::Impl::collect(SceneTree& tree, bool visuals_only) {
  items.clear();
  const State& state = tree.state();
  for (const ShownShape& shown : shownShapes(tree, visual_meshes, visuals_only)) {
    Item item;
    const std::vector<double>& size = shown.geometry->size;
    item.is_symbol = shapeKind(shown.geometry->type).is_symbol;
    item.stored =
        item.is_symbol ? &programs->store.marker(size.empty() ? .1 : size.back()) : &programs->store.of(shown.geometry);
    if (item.stored->mesh.parts.empty()) continue;
    const RigidTransform X_WG = state.pose(shown.frame);
    item.pose = Eigen::Matrix4d::Identity();
    item.pose.topLeftCorner<3, 3>() = X_WG.R;
    item.pose.topRightCorner<3, 1>() = X_WG.p;
    item.has_color = shown.shape->color.has_value();
    item.color = shown.shape->color.value_or(kUsualColor);
    items.push_back(item);
  }
  programs->store.tidy();
}

/// Finds the ball around the box around the boxes of all items, as the page does.
void PictureRenderer::Impl::findBall() {
  Vector3d lower(-1., -1., 0.), upper(1., 1., 1.);
  bool first = true;
  for (const Item& item : items) {
    const PictureMesh& mesh = item.stored->mesh;
    for (int corner = 0; corner < 8; ++corner) {
      Eigen::Vector4d at(0., 0., 0., 1.);
      for (int k = 0; k < 3; ++k) at[k] = corner >> k & 1 ? mesh.upper[k] : mesh.lower[k];
      const Vector3d p = (item.pose * at).head<3>();
      lower = first ? p : Vector3d(lower.cwiseMin(p));
      upper = first ? p : Vector3d(upper.cwiseMax(p));
      first = false;
    }
  }
  center = .5 * (lower + upper);
  radius = std::max(.5 * (upper - lower).norm(), 1e-4);
}

void PictureRenderer::Impl::fitRange(Camera& camera, double distance) const {
  if (camera.has_range) return;
  const double reach = (camera.pose.p - center).norm() + radius;
  camera.near = std::min(std::max(.01, .002 * reach), .02 * distance);
  camera.far = std::max(200., 4. * reach);
}

/// Draws the depths that the sun sees. Of primitives it draws the backs only, so that their fronts have no shadows by
/// rounding.
void PictureRenderer::Impl::drawShadows(const PictureOptions& options) {
  const GlFunctions& f = glFunctions();
  const double reach = std::max(1.1 * radius, std::min(1., 8. * radius));
  normal_bias = .006 * std::min(1., reach) * std::max(1., reach / 12.);
  Camera sun;
  sun.pose = lookAt(center + 2. * reach * towards_sun, center);
  sun.width = sun.height = kShadowPixels;
  sun.ortho_height = 2. * reach;
  sun.near = .1 * reach;
  sun.far = 4. * reach;
  const Eigen::Matrix4d to_map = projection(sun);
  Eigen::Matrix4d to_unit = .5 * Eigen::Matrix4d::Identity();
  to_unit.col(3) = Eigen::Vector4d(.5, .5, .5, 1.);
  to_shadow = to_unit * to_map;
  if (!options.shadows || options.flat_colors) return;
  f.BindFramebuffer(gl::kFramebuffer, shadow_frame);
  f.Viewport(0, 0, kShadowPixels, kShadowPixels);
  f.Clear(gl::kDepthBit);
  programs->shadow.use();
  programs->shadow.set("to_image", to_map);
  for (const Item& item : items) {
    const PictureMesh& mesh = item.stored->mesh;
    if (item.is_symbol || item.color[3] < 1. || mesh.kind != PictureMesh::Kind::surface) continue;
    mesh.is_file ? f.Disable(gl::kCullFace) : f.Enable(gl::kCullFace);
    f.CullFace(gl::kFront);
    programs->shadow.set("pose", item.pose);
    f.BindVertexArray(item.stored->array);
    for (const PictureMesh::Part& part : mesh.parts) f.DrawArrays(gl::kTriangles, part.first, part.count);
  }
  f.BindFramebuffer(gl::kFramebuffer, frame);
}

/// Sets what all programs have in common.
void PictureRenderer::Impl::setView(const Camera& camera, const PictureOptions& options) {
  const GlFunctions& f = glFunctions();
  const Eigen::Matrix4d to_image = projection(camera);
  const double reach = (camera.pose.p - center).norm() + radius, fog = std::max(kFogFrom, reach);
  std::vector<Vector3d> towards{towards_sun}, strength{light(0xfff6ea, kSunlight)};
  for (std::size_t i = 1; i < options.lights.size(); ++i) {
    towards.push_back((options.lights[i] - kCenterOfLights).normalized());
    strength.push_back(Vector3d::Constant(1.2));
  }
  if (options.lights.empty()) {
    towards.push_back(kFill.normalized());
    strength.push_back(light(0xe3ebff, .55));
  }
  f.ActiveTexture(gl::kTexture0 + 1);
  f.BindTexture(gl::kTexture2D, shadow_map);
  f.ActiveTexture(gl::kTexture0);
  Programs& p = *programs;
  for (GlProgram* program : {&p.surface, &p.lines, &p.points, &p.floor}) {
    program->use();
    program->set("to_image", to_image);
    program->set("to_shadow", to_shadow);
    program->set("shadow_map", 1);
    program->set("shadow_pixels", options.shadows && !options.flat_colors ? double(kShadowPixels) : 0.);
    program->set("fog_color", options.background.value_or(paper()));
    program->set("fog", Eigen::Vector2d(fog, kFogTo / kFogFrom * fog));
    program->set("eye", camera.pose.p);
    program->set("forward", Vector3d(camera.pose.q.toRotationMatrix().col(2)));
    program->set("size", Eigen::Vector2d(camera.width, camera.height));
  }
  p.surface.use();
  p.surface.set("picture", 0);
  p.surface.set("sky", light(0xf6f9ff, kSkylight));
  p.surface.set("ground", light(0x7d7b7a, kSkylight));
  p.surface.set("towards", towards);
  p.surface.set("strength", strength);
  p.surface.set("lights", int(towards.size()));
  p.surface.set("is_orthographic", camera.ortho_height > 0. ? 1. : 0.);
  p.surface.set("normal_bias", normal_bias);
}

void PictureRenderer::Impl::drawSurface(const Item& item, const PictureOptions& options) {
  const GlFunctions& f = glFunctions();
  GlProgram& program = programs->surface;
  const PictureMesh& mesh = item.stored->mesh;
  program.set("pose", item.pose);
  program.set("shading", options.flat_colors ? 0 : item.is_symbol ? 1 : 2);
  program.set("receives", item.color[3] < 1. ? 0. : 1.);
  f.BindVertexArray(item.stored->array);
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const PictureMesh::Part& part = mesh.parts[i];
    const bool own = part.color && (item.is_symbol || mesh.has_colors || !item.has_color);
    Vector4d shown = own ? *part.color : item.color;
    shown.head<3>() = linearColor(shown.head<3>());
    shown[3] = item.is_symbol ? 1. : item.color[3];
    program.set("color", shown);
    program.set("has_picture", item.stored->textures[i] != 0 ? 1. : 0.);
    f.BindTexture(gl::kTexture2D, item.stored->textures[i]);
    f.DrawArrays(gl::kTriangles, part.first, part.count);
  }
}

void PictureRenderer::Impl::drawItem(const Item& item, const PictureOptions& options) {
  const GlFunctions& f = glFunctions();
  const PictureMesh& mesh = item.stored->mesh;
  if (mesh.kind == PictureMesh::Kind::surface) {
    programs->surface.use();
    f.Enable(gl::kCullFace);
    if (mesh.is_file && item.color[3] < 1.) {  // both sides of meshes
      f.CullFace(gl::kFront);
      drawSurface(item, options);
    }
    f.CullFace(gl::kBack);
    drawSurface(item, options);
    return;
  }
  const bool is_lines = mesh.kind == PictureMesh::Kind::lines;
  GlProgram& program = is_lines ? programs->lines : programs->points;
  Vector4d shown = mesh.has_colors ? Vector4d(1., 1., 1., item.color[3]) : item.color;
  shown.head<3>() = linearColor(shown.head<3>());
  program.use();
  program.set("pose", item.pose);
  program.set("color", shown);
  program.set("width", kFiner * (is_lines ? kLineWidth : kPointSize));
  program.set("shading", options.flat_colors ? 0 : 1);
  f.Disable(gl::kCullFace);
  f.BindVertexArray(item.stored->array);
  f.DrawArrays(is_lines ? gl::kTriangles : gl::kPoints, 0, mesh.parts[0].count);
}

void PictureRenderer::Impl::drawSolidFloor(const Camera& camera, const PictureOptions& options) {
  const double half = 4. * camera.far;
  Item floor{&programs->store.square(), Eigen::Matrix4d::Identity(), Vector4d::Ones(), false, true};
  floor.pose.diagonal() << half, half, 1., 1.;
  floor.pose(2, 3) = -2. * kFloorDepth;
  floor.color.head<3>() = *options.floor_color;
  drawItem(floor, options);
}

/// Draws lines and shadows on the floor.
void PictureRenderer::Impl::drawFloor(const Camera& camera, const PictureOptions& options) {
  const GlFunctions& f = glFunctions();
  const double square = std::pow(10., std::floor(std::log10(std::max(options.distance, 1e-6))));
  const Vector3d background = linearColor(options.background.value_or(paper()));
  const bool is_bright = background.dot(Vector3d(.2, .7, .1)) > .2;
  GlProgram& program = programs->floor;
  program.use();
  program.set("square", square);
  program.set("ink", is_bright ? Vector3d(.17, .2, .24) : Vector3d(.5, .54, .6));
  program.set("center", Vector3d(camera.pose.p.x(), camera.pose.p.y(), -kFloorDepth * std::min(square, 1.)));
  program.set("half_width", std::max(30. * square, (camera.pose.p - center).norm() + 1.1 * radius));
  f.Disable(gl::kCullFace);
  f.BindVertexArray(programs->store.square().array);
  f.DrawArrays(gl::kTriangles, 0, 6);
}

CameraImage PictureRenderer::Impl::render(SceneTree& tree, Camera camera, const PictureOptions& options,
                                          bool visuals_only) {
  const GlFunctions& f = glFunctions();
  camera.width *= kFiner;
  camera.height *= kFiner;
  prepare(camera.width, camera.height);
  collect(tree, visuals_only);
  findBall();
  fitRange(camera, options.distance);
  towards_sun = (options.lights.empty() ? kSun : Vector3d(options.lights[0] - kCenterOfLights)).normalized();

  f.Enable(gl::kDepthTest);
  f.Enable(gl::kProgramPointSize);
  f.Disable(gl::kBlend);
  f.DepthFunc(gl::kLessOrEqual);
  f.DepthMask(1);
  f.ColorMask(1, 1, 1, 1);
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  drawShadows(options);
  setView(camera, options);
  f.Viewport(0, 0, camera.width, camera.height);
  const Vector3d background = options.background.value_or(paper());
  f.ClearColor(float(background[0]), float(background[1]), float(background[2]), 1.f);
  f.Clear(gl::kColorBit | gl::kDepthBit);

  std::vector<std::pair<double, const Item*>> transparent;
  const Vector3d forward = camera.pose.q.toRotationMatrix().col(2);
  f.PolygonMode(gl::kFrontAndBack, options.wireframe ? gl::kLine : gl::kFill);
  for (const Item& item : items) {
    if (item.color[3] < 1. && !item.is_symbol)
      transparent.emplace_back(-forward.dot(item.pose.topRightCorner<3, 1>()), &item);
    else
      drawItem(item, options);
  }
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  if (options.has_floor && options.floor_color) drawSolidFloor(camera, options);

  f.Enable(gl::kBlend);
  f.BlendFuncSeparate(gl::kSourceAlpha, gl::kOneMinusSourceAlpha, gl::kOne, gl::kOneMinusSourceAlpha);
  f.DepthMask(0);
  if (options.has_floor) drawFloor(camera, options);
  std::stable_sort(transparent.begin(), transparent.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  f.PolygonMode(gl::kFrontAndBack, options.wireframe ? gl::kLine : gl::kFill);
  for (const auto& [depth_of, item] : transparent) drawItem(*item, options);
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  f.DepthMask(1);
  f.Disable(gl::kBlend);

  if (options.has_floor) {  // its depth alone
    f.ColorMask(0, 0, 0, 0);
    f.Enable(gl::kCullFace);
    f.CullFace(gl::kBack);
    programs->floor.use();
    programs->floor.set("center", Vector3d(camera.pose.p.x(), camera.pose.p.y(), 0.));
    f.BindVertexArray(programs->store.square().array);
    f.DrawArrays(gl::kTriangles, 0, 6);
    f.ColorMask(1, 1, 1, 1);
  }

  CameraImage image{camera.width, camera.height, {}, {}};
  image.depth.resize(std::size_t(camera.width) * std::size_t(camera.height));
  image.rgb.resize(3 * image.depth.size());
  f.PixelStorei(gl::kPackAlignment, 1);
  f.ReadPixels(0, 0, camera.width, camera.height, gl::kRgb, gl::kUnsignedByte, image.rgb.data());
  f.ReadPixels(0, 0, camera.width, camera.height, gl::kDepthComponent, gl::kFloat, image.depth.data());
  f.BindFramebuffer(gl::kFramebuffer, 0);
  f.UseProgram(0);
  f.BindVertexArray(0);
  flipRows(image);
  image = shrunk(image, kFiner);
  depthToMeters(image.depth, camera);
  return image;
}

PictureRenderer::PictureRenderer() : impl_(std::make_unique<Impl>()) {}
PictureRenderer::~PictureRenderer() = default;

CameraImage PictureRenderer::render(SceneTree& scene, const Camera& camera, const PictureOptions& options,
                                    bool visuals_only) {
  camera.validate();
  options.validate();
  if (!impl_->context) impl_->context.emplace();
  const GlContext::Use use(*impl_->context);
  return impl_->render(scene, camera, options, visuals_only);
}

}  // namespace kinegraph
