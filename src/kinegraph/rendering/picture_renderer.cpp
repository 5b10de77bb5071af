#include "kinegraph/rendering/picture_renderer.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/rendering/gl/gl_frame.h"
#include "kinegraph/rendering/picture_programs.h"
#include "kinegraph/rendering/picture_view.h"
#include "kinegraph/rendering/projection.h"
#include "kinegraph/rendering/sun_shadows.h"

namespace kinegraph {

namespace {

constexpr double kLineWidth = 2., kPointSize = 4.;  ///< pixels

/// The depths of kinds of pixels: without a shape (0, or where the floor has been drawn), with samples that are alike,
/// and with others.
constexpr double kFloorLines = .0625, kFloorShadows = .125, kAlike = .25, kMixed = .5;
constexpr double kFloorBefore = .3125, kAllButMixed = .375;

/// Values of the shaders' parameters `kind` and `shading`.
constexpr int kLit = 1, kWithoutFog = 2, kFlat = 0, kSymbol = 1, kByLights = 2;

Vector4d linear(Vector4d color) {
  color.head<3>() = linearColor(color.head<3>());
  return color;
}

/// Returns how samples store a color: the square root of a lit color, or the shown color itself.
Vector4d storedColor(Vector4d color, int shading) {
  if (shading == kFlat) return color;
  Vector3d c = linearColor(color.head<3>());
  constexpr double kBends = .8;  // as in the shader
  const double peak = c.maxCoeff();
  if (shading == kSymbol && peak >= kBends) c *= (1. - .04 / (peak - .6)) / peak;
  color.head<3>() = shading == kSymbol ? encodedColor(c) : Vector3d(c.cwiseSqrt());
  return color;
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
  CameraImage render(SceneTree& tree, const std::vector<PictureDrawing>& drawings, const Camera& camera,
                     const PictureOptions& options, bool visuals_only);

  std::optional<GlContext> context;

 private:
  /// The contents of the context.
  struct Drawing {
    Drawing();  // defined below: Clang cannot use initializers of members before the end of Impl

    std::optional<PicturePrograms> programs;
    PictureStore store;
    SunShadows shadows;
    GlFrame samples{GlFrame::Colors::integers}, glass{GlFrame::Colors::rgba, samples}, pixels{GlFrame::Colors::rgba};
  };

  GlProgram& use(PictureProgram& program);
  void drawSamples();
  void drawGlass();
  void drawPixels();
  void drawItem(const PictureItem& item, ShapePrograms& programs);
  void drawSurface(const PictureItem& item, ShapePrograms& programs);
  void drawSolidFloor();
  void drawScreen(PictureProgram& program, double level);
  void drawFloor();
  void drawFloorPart(PictureProgram& program, const FloorPart& part, double level);
  void limitToShapes();
  void readColors(CameraImage& image) const;
  void readDepth(CameraImage& image);

  std::optional<Drawing> drawing;
  VisualMeshes visual_meshes;
  std::optional<PictureView> view;
  unsigned pictures = 0;  ///< drawn so far
};

PictureRenderer::Impl::~Impl() {
  if (!context) return;
  try {
    const GlContext::Use use_it(*context);
    drawing.reset();
  } catch (const Error&) {  // the driver has gone, and its memory with it
  }
}

/// Selects a program, which then knows the view.
GlProgram& PictureRenderer::Impl::use(PictureProgram& program) {
  GlProgram& compiled = program.compiled();
  compiled.use();
  if (program.described_in != pictures) {
    view->describe(compiled);
    drawing->shadows.describe(compiled, view->hasShadows());
  }
  program.described_in = pictures;
  return compiled;
}

void PictureRenderer::Impl::drawSurface(const PictureItem& item, ShapePrograms& programs) {
  const GlFunctions& f = glFunctions();
  const PictureMesh& mesh = item.stored->mesh;
  const int shading = view->options.flat_colors || item.is_image ? kFlat : item.is_symbol ? kSymbol : kByLights;
  f.BindVertexArray(item.stored->array);
  for (std::size_t i = 0; i < mesh.parts.size(); ++i) {
    const PictureMesh::Part& part = mesh.parts[i];
    const bool own = part.color && (item.is_symbol || mesh.has_colors || !item.has_color);
    Vector4d shown = own ? *part.color : item.color;
    shown[3] = item.is_symbol ? 1. : item.color[3];
    const unsigned texture = item.stored->textures[i];
    GlProgram& program = use(texture ? programs.textured : programs.surface);
    program.set("pose", item.pose);
    program.set("kind", shading == kByLights ? kLit : 0);
    program.set("shading", shading);
    program.set("color", linear(shown));
    program.set("stored_color", storedColor(shown, shading));
    program.set("has_picture", texture ? 1. : 0.);
    f.BindTexture(gl::kTexture2D, texture);
    drawTriangles(part);
  }
}

void PictureRenderer::Impl::drawItem(const PictureItem& item, ShapePrograms& programs) {
  const GlFunctions& f = glFunctions();
  const PictureMesh& mesh = item.stored->mesh;
  if (mesh.kind == PictureMesh::Kind::surface) {
    f.Enable(gl::kCullFace);
    if (mesh.is_file && item.color[3] < 1.) {  // both sides of meshes
      f.CullFace(gl::kFront);
      drawSurface(item, programs);
    }
    f.CullFace(gl::kBack);
    drawSurface(item, programs);
    return;
  }
  const bool is_lines = mesh.kind == PictureMesh::Kind::lines;
  GlProgram& program = use(is_lines ? programs.lines : programs.points);
  program.set("pose", item.pose);
  program.set("color", linear(mesh.has_colors ? Vector4d(1., 1., 1., item.color[3]) : item.color));
  const double usual = is_lines ? kLineWidth : item.size > 0. ? 0. : kPointSize;
  program.set("width", PictureView::kFiner * (item.width > 0. ? item.width : usual));
  const Camera& camera = view->camera;
  const double samples_per_meter =
      camera.height / (camera.ortho_height > 0. ? camera.ortho_height : 1. / camera.focal_length);
  program.set("wider_at_1m", item.size * samples_per_meter);
  program.set("kind", kWithoutFog);
  program.set("shading", view->options.flat_colors ? kFlat : kSymbol);
  f.Disable(gl::kCullFace);
  f.BindVertexArray(item.stored->array);
  f.DrawArrays(is_lines ? gl::kTriangles : gl::kPoints, 0, mesh.parts[0].count);
}

void PictureRenderer::Impl::drawSolidFloor() {
  const double half = 4. * view->camera.far;
  PictureItem floor{&drawing->store.square(), Eigen::Matrix4d::Identity(), Vector4d::Ones(), false, true};
  floor.pose.diagonal() << half, half, 1., 1.;
  floor.pose(2, 3) = PictureView::kSolidFloor;
  floor.color.head<3>() = *view->options.floor_color;
  drawItem(floor, drawing->programs->samples);
}

/// Draws the samples of opaque shapes.
void PictureRenderer::Impl::drawSamples() {
  const GlFunctions& f = glFunctions();
  drawing->samples.use(view->camera.width, view->camera.height);
  constexpr unsigned kNothing[] = {0xff000000, 0, 0, 0};  // no shape has this kind
  constexpr float kFar = 1.f;
  f.ClearBufferuiv(gl::kColor, 0, kNothing);
  f.ClearBufferfv(gl::kDepth, 0, &kFar);
  f.PolygonMode(gl::kFrontAndBack, view->options.wireframe ? gl::kLine : gl::kFill);
  for (const PictureItem& item : view->scene.items) {
    if (!item.isTransparent()) drawItem(item, drawing->programs->samples);
  }
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  if (view->options.has_floor && view->options.floor_color) drawSolidFloor();
}

/// Draws transparent shapes, the farthest first, in front of the opaque ones.
void PictureRenderer::Impl::drawGlass() {
  const GlFunctions& f = glFunctions();
  std::vector<std::pair<double, const PictureItem*>> items;
  const Vector3d forward = view->camera.pose.q.toRotationMatrix().col(2);
  for (const PictureItem& item : view->scene.items) {
    if (item.isTransparent()) items.emplace_back(-forward.dot(item.pose.topRightCorner<3, 1>()), &item);
  }
  std::stable_sort(items.begin(), items.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  drawing->glass.use(view->camera.width, view->camera.height);
  f.ClearColor(0.f, 0.f, 0.f, 0.f);
  f.Clear(gl::kColorBit);
  f.Enable(gl::kBlend);
  f.BlendFuncSeparate(gl::kSourceAlpha, gl::kOneMinusSourceAlpha, gl::kOne, gl::kOneMinusSourceAlpha);
  f.DepthMask(0);
  f.PolygonMode(gl::kFrontAndBack, view->options.wireframe ? gl::kLine : gl::kFill);
  for (const auto& [nearness, item] : items) drawItem(*item, drawing->programs->glass);
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  f.DepthMask(1);
  f.Disable(gl::kBlend);
}

void PictureRenderer::Impl::drawScreen(PictureProgram& program, double level) {
  use(program).set("level", level);
  drawTriangles(drawing->store.square().mesh.parts[0]);
}

void PictureRenderer::Impl::drawFloorPart(PictureProgram& program, const FloorPart& part, double level) {
  GlProgram& used = use(program);
  used.set("level", level);
  used.set("center", part.center);
  used.set("half_x", part.half_x);
  used.set("half_y", part.half_y);
  drawTriangles(drawing->store.square().mesh.parts[0]);
}

/// Draws shadows and lines where no shapes are. Before shapes below the floor, too, if there are any.
void PictureRenderer::Impl::drawFloor() {
  const GlFunctions& f = glFunctions();
  PicturePrograms& programs = *drawing->programs;
  const double height = view->floorHeight();
  f.Enable(gl::kBlend);
  f.BlendFuncSeparate(gl::kSourceAlpha, gl::kOneMinusSourceAlpha, gl::kOne, gl::kOneMinusSourceAlpha);
  f.DepthFunc(gl::kGreater);
  const Camera& camera = view->camera;
  const bool from_below =
      camera.ortho_height > 0. ? (camera.pose.q * Vector3d::UnitZ()).z() > 0. : camera.pose.p.z() < height;
  if (view->options.floor_color || view->scene.lowest < height || from_below) {
    drawFloorPart(programs.floor_before, view->wholeFloor(height), kFloorBefore);
  } else {
    if (view->hasShadows()) drawFloorPart(programs.floor_shadows, drawing->shadows.shadedFloor(*view), kFloorShadows);
    drawFloorPart(programs.floor_lines, view->linedFloor(), kFloorLines);
  }
  f.Disable(gl::kBlend);
}

/// Limits drawing to a rectangle around all opaque shapes.
void PictureRenderer::Impl::limitToShapes() {
  const GlFunctions& f = glFunctions();
  if (view->options.floor_color) return;
  const Eigen::Matrix4d to_image = projection(view->camera);
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Eigen::Array2d lower = Eigen::Array2d::Constant(kInfinity), upper = -lower;
  double margin = 4.;  // pixels
  for (const PictureItem& item : view->scene.items) {
    if (item.isTransparent()) continue;
    margin = std::max(margin, item.width);
    for (const Vector3d& corner : item.corners()) {
      const Eigen::Vector4d p = to_image * corner.homogeneous();
      if (p[3] <= 0.) return;  // behind the camera
      lower = lower.min(p.head<2>().array() / p[3]);
      upper = upper.max(p.head<2>().array() / p[3]);
    }
  }
  const Eigen::Array2d size(view->camera.width / PictureView::kFiner, view->camera.height / PictureView::kFiner);
  const Eigen::Array2d from = (.5 * (lower + 1.) * size - margin).max(0.).min(size);
  const Eigen::Array2d to = (.5 * (upper + 1.) * size + margin).max(from).min(size);
  f.Enable(gl::kScissorTest);
  f.Scissor(int(from[0]), int(from[1]), int(std::ceil(to[0])) - int(from[0]), int(std::ceil(to[1])) - int(from[1]));
}

/// Lights each pixel.
void PictureRenderer::Impl::drawPixels() {
  const GlFunctions& f = glFunctions();
  PicturePrograms& programs = *drawing->programs;
  drawing->pixels.use(view->camera.width / PictureView::kFiner, view->camera.height / PictureView::kFiner);
  for (const auto& [place, texture] : {std::pair(PictureTextures::kShadowMap, drawing->shadows.map()),
                                       {PictureTextures::kSamples, drawing->samples.color()},
                                       {PictureTextures::kDepths, drawing->samples.depth()},
                                       {PictureTextures::kGlass, drawing->glass.color()}}) {
    f.ActiveTexture(gl::kTexture0 + place);
    f.BindTexture(gl::kTexture2D, texture);
  }
  f.ActiveTexture(gl::kTexture0 + PictureTextures::kPicture);
  f.Disable(gl::kCullFace);
  f.BindVertexArray(drawing->store.square().array);
  const Vector3d background = view->background();
  f.ClearColor(float(background[0]), float(background[1]), float(background[2]), 1.f);
  constexpr float kNoShape = 0.f;
  f.Clear(gl::kColorBit);
  f.ClearBufferfv(gl::kDepth, 0, &kNoShape);

  limitToShapes();
  f.ColorMask(0, 0, 0, 0);
  f.DepthFunc(gl::kAlways);
  GlProgram& kinds = use(programs.kinds);
  kinds.set("alike", kAlike);
  kinds.set("mixed", kMixed);
  drawScreen(programs.kinds, 0.);
  f.ColorMask(1, 1, 1, 1);
  f.DepthFunc(gl::kEqual);
  drawScreen(programs.alike_surface, kAlike);
  drawScreen(programs.mixed_surface, kMixed);
  f.Disable(gl::kScissorTest);
  if (view->options.has_floor) drawFloor();
  if (!view->scene.has_transparent) return;
  f.Enable(gl::kBlend);
  f.BlendFuncSeparate(gl::kOne, gl::kOneMinusSourceAlpha, gl::kOne, gl::kOneMinusSourceAlpha);
  f.DepthFunc(gl::kGreater);
  drawScreen(programs.glass_pixel, kAllButMixed);
  f.Disable(gl::kBlend);
}

void PictureRenderer::Impl::readColors(CameraImage& image) const {
  std::vector<std::uint8_t> read(4 * std::size_t(image.width) * std::size_t(image.height));
  glFunctions().ReadPixels(0, 0, image.width, image.height, gl::kRgba, gl::kUnsignedByte, read.data());
  image.rgb.resize(read.size() / 4 * 3);
  std::uint8_t* to = image.rgb.data();
  for (int row = image.height - 1; row >= 0; --row) {  // rows of OpenGL run from bottom to top
    const std::uint8_t* from = &read[4 * std::size_t(row) * std::size_t(image.width)];
    for (int column = 0; column < image.width; ++column, from += 4, to += 3) std::copy_n(from, 3, to);
  }
}

/// Reads the depth of the lower right sample of each pixel, with the floor.
void PictureRenderer::Impl::readDepth(CameraImage& image) {
  const GlFunctions& f = glFunctions();
  drawing->samples.use(view->camera.width, view->camera.height);
  f.DepthFunc(gl::kLessOrEqual);
  if (view->options.has_floor) {
    f.ColorMask(0, 0, 0, 0);
    f.Enable(gl::kCullFace);
    f.CullFace(gl::kBack);
    f.BindVertexArray(drawing->store.square().array);
    drawFloorPart(drawing->programs->floor_depth, view->wholeFloor(0.), 0.);
    f.ColorMask(1, 1, 1, 1);
  }
  const std::size_t row_length = std::size_t(view->camera.width);
  std::vector<float> read(row_length * std::size_t(view->camera.height));
  f.ReadPixels(0, 0, view->camera.width, view->camera.height, gl::kDepthComponent, gl::kFloat, read.data());
  image.depth.reserve(read.size() / (PictureView::kFiner * PictureView::kFiner));
  for (int row = image.height - 1; row >= 0; --row) {
    const float* from = &read[std::size_t(PictureView::kFiner * row) * row_length];
    for (int column = 0; column < image.width; ++column)
      image.depth.push_back(from[PictureView::kFiner * column + PictureView::kFiner - 1]);
  }
  depthToMeters(image.depth, view->camera);
}

PictureRenderer::Impl::Drawing::Drawing() = default;

CameraImage PictureRenderer::Impl::render(SceneTree& tree, const std::vector<PictureDrawing>& drawings,
                                          const Camera& camera, const PictureOptions& options, bool visuals_only) {
  const GlFunctions& f = glFunctions();
  if (!drawing) drawing.emplace();
  ++pictures;
  view.emplace(pictureScene(tree, visual_meshes, drawing->store, visuals_only, drawings), camera, options);
  CameraImage image{camera.width, camera.height, {}, {}};
  if (!drawing->programs || drawing->programs->lights != view->lights()) drawing->programs.emplace(view->lights());

  f.Enable(gl::kDepthTest);
  f.Enable(gl::kProgramPointSize);
  f.Disable(gl::kBlend);
  f.Disable(gl::kScissorTest);
  f.DepthFunc(gl::kLessOrEqual);
  f.DepthMask(1);
  f.ColorMask(1, 1, 1, 1);
  f.PolygonMode(gl::kFrontAndBack, gl::kFill);
  f.PixelStorei(gl::kPackAlignment, 1);
  if (view->hasShadows()) drawing->shadows.draw(*view);
  drawSamples();
  if (view->scene.has_transparent) drawGlass();
  drawPixels();
  readColors(image);
  if (options.has_depth) readDepth(image);
  f.BindFramebuffer(gl::kFramebuffer, 0);
  f.UseProgram(0);
  f.BindVertexArray(0);
  return image;
}

PictureRenderer::PictureRenderer() : impl_(std::make_unique<Impl>()) {}
PictureRenderer::~PictureRenderer() = default;

CameraImage PictureRenderer::render(SceneTree& scene, const Camera& camera, const PictureOptions& options,
                                    bool visuals_only) {
  return render(scene, {}, camera, options, visuals_only);
}

CameraImage PictureRenderer::render(SceneTree& scene, const std::vector<PictureDrawing>& drawings, const Camera& camera,
                                    const PictureOptions& options, bool visuals_only) {
  camera.validate();
  options.validate();
  if (!impl_->context) impl_->context.emplace();
  const GlContext::Use use(*impl_->context);
  return impl_->render(scene, drawings, camera, options, visuals_only);
}

}  // namespace kinegraph
