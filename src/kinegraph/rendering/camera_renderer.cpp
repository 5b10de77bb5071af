#include "kinegraph/rendering/camera_renderer.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_kinds.h"
#include "kinegraph/kinematics/kinematic_model.h"
#include "kinegraph/kinematics/state.h"
#include "kinegraph/rendering/gl/gl_context.h"
#include "kinegraph/rendering/letters.h"
#include "kinegraph/rendering/mesh_library.h"
#include "kinegraph/rendering/shown_shapes.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

namespace {

constexpr int kFineness = 2;             // pixels of a rendered letter per output pixel, in both directions
constexpr float kShadowHalfWidth = 2.5;  // m, of the area of the first light's shadow map
const Vector4d kDefaultColor(.8, .8, .8, 1.);

/// Returns one of `count` directional lights, from a position towards the center of the scene.
mjvLight directionalLight(int id, const Vector3d& from, std::size_t count, bool shadow) {
  const Vector3d to(0., 0., .8);
  mjvLight light{};
  light.id = id;
  light.type = mjLIGHT_DIRECTIONAL;
  light.castshadow = shadow;
  light.attenuation[0] = 1.;
  light.cutoff = 180.;
  const Vector3d direction = (to - from).normalized();
  for (int i = 0; i < 3; ++i) {
    light.pos[i] = float(from[i]);
    light.dir[i] = float(direction[i]);
    light.ambient[i] = .3f / float(count);
    light.diffuse[i] = .6f;
    light.specular[i] = .4f / float(count);
  }
  return light;
}

/// Returns a light that shows colors unchanged.
mjvLight flatLight() {
  mjvLight light = directionalLight(0, Vector3d::UnitZ(), 1, false);
  for (int i = 0; i < 3; ++i) {
    light.ambient[i] = 1.f;
    light.diffuse[i] = light.specular[i] = 0.f;
  }
  return light;
}

/// Colors the pixels with infinite depth. Translucent shapes have no depth: `over_white` has the colors before a white
/// background instead of a black one, or is empty if there are none.
void paintBackground(CameraImage& image, const Vector3d& color, const std::vector<std::uint8_t>& over_white) {
  for (std::size_t i = 0; i < image.depth.size(); ++i) {
    if (image.depth[i] > 0.f) continue;
    for (std::size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const int over_black = over_white.empty() ? 0 : image.rgb[k];
      const int seen = over_white.empty() ? 255 : std::max(0, over_white[k] - over_black);  // share of the background
      image.rgb[k] = std::uint8_t(std::lround(over_black + seen * std::clamp(color[Eigen::Index(k - 3 * i)], 0., 1.)));
    }
  }
}

/// Converts a depth buffer, 1 at `near` and 0 at `far`, to meters: 1/z is linear in its values (z, if orthographic).
void toMeters(std::vector<float>& depth, const Camera& camera) {
  const double near = camera.near, far = camera.far;
  for (float& d : depth) {
    if (d <= 0.f)
      d = -1.f;
    else if (camera.ortho_height > 0.)
      d = float(far - d * (far - near));
    else
      d = float(near * far / (near + d * (far - near)));
  }
}

/// Returns MuJoCo's own geom for a shape type, if there is one.
std::optional<mjtGeom> builtinShape(ShapeType type) {
  switch (type) {
    case ShapeType::box:
    case ShapeType::sdf:
    case ShapeType::tensor:
      return mjGEOM_BOX;
    case ShapeType::sphere:
      return mjGEOM_SPHERE;
    case ShapeType::capsule:
      return mjGEOM_CAPSULE;
    case ShapeType::cylinder:
      return mjGEOM_CYLINDER;
    default:
      return std::nullopt;
  }
}

/// Returns the half sides of a box, or the radius and half length of a round shape.
Vector3d builtinSize(const Geometry& shape) {
  const std::vector<double>& s = shape.size;
  switch (shape.type) {
    case ShapeType::sphere:
      return {s[0], s[0], s[0]};
    case ShapeType::capsule:
    case ShapeType::cylinder:
      return {s[1], .5 * s[0], 0.};
    default:
      return .5 * Vector3d(s[0], s[1], s[2]);
  }
}

}  // namespace

struct CameraRenderer::Impl {
  explicit Impl(const RendererOptions& renderer_options) : options(renderer_options) {
    mujoco().mjr_defaultContext(context.get());
    mujoco().mjv_defaultScene(scene.get());
  }
  ~Impl();

  void draw(SceneTree& tree, const Camera& camera, bool visuals_only, bool segmentation);
  bool hasTranslucentShapes() const;
  void drawBeforeWhite(const Camera& camera);
  void read(const Camera& camera, std::uint8_t* rgb, float* depth);
  CameraImage write(const std::string& text, int width, int height);

  RendererOptions options;
  std::optional<GlContext> gl;

 private:
  void makeContext();
  void makeRoom(int width, int height);
  void placeGeoms(const std::vector<ShownShape>& items, const State& state, const Camera& camera, int frames);
  void placeCamera(const Camera& camera);
  void placeLights();
  mjvGeom& addGeom(int type, const Vector3d& size, const RigidTransform& X_WG, const Vector4d& color, int segment);
  void addMarker(double length, const RigidTransform& X_WG, int segment);

  std::optional<MujocoModel> model;
  std::unique_ptr<mjrContext> context = std::make_unique<mjrContext>();
  std::unique_ptr<mjvScene> scene = std::make_unique<mjvScene>();
  MeshLibrary meshes;
  VisualMeshes visual_meshes;
};

CameraRenderer::Impl::~Impl() {
  if (!gl) return;
  try {
    const GlContext::Use use(*gl);
    const MujocoErrors errors;
    mujoco().mjr_freeContext(context.get());
    mujoco().mjv_freeScene(scene.get());
  } catch (const Error&) {  // the driver has gone, and its memory with it
  }
}

void CameraRenderer::Impl::makeContext() {
  mujoco().mjr_freeContext(context.get());
  mjModel listed = **model;  // the arrays belong to the model or the library
  listed.vis.quality.offsamples = 0;
  listed.vis.quality.shadowsize = options.shadows ? 1024 : 0;
  listed.vis.quality.numslices = options.slices;
  listed.vis.quality.numstacks = options.slices / 2;
  listed.vis.quality.numquads = 1;
  listed.stat.extent = 1.;
  listed.vis.map.shadowclip = kShadowHalfWidth;
  meshes.fill(listed);
  mujoco().mjr_makeContext(&listed, context.get(), kFineness * mjFONTSCALE_100);
  mujoco().mjr_setBuffer(mjFB_OFFSCREEN, context.get());
  context->readDepthMap = mjDEPTH_ZEROFAR;
}

mjvGeom& CameraRenderer::Impl::addGeom(int type, const Vector3d& size, const RigidTransform& X_WG,
                                       const Vector4d& color, int segment) {
  mjvGeom& geom = scene->geoms[scene->ngeom++];
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> R = X_WG.R;
  const Eigen::Vector4f rgba = color.cast<float>();
  mujoco().mjv_initGeom(&geom, type, size.data(), X_WG.p.data(), R.data(), rgba.data());
  geom.segid = segment;
  geom.transparent = color[3] < 1.;
  geom.castshadow = !geom.transparent;
  geom.specular = .4f;
  geom.shininess = 50.f / 128.f;
  geom.reflectance = 0.f;
  return geom;
}

void CameraRenderer::Impl::addMarker(double length, const RigidTransform& X_WG, int segment) {
  const Vector4d colors[] = {{.84, .27, .27, 1.}, {.25, .61, .29, 1.}, {.23, .44, .84, 1.}};
  for (int axis = 0; axis < 3; ++axis) {
    Matrix3d R;  // z is the axis
    R << Vector3d::Unit((axis + 1) % 3), Vector3d::Unit((axis + 2) % 3), Vector3d::Unit(axis);
    const RigidTransform X_WA = X_WG * RigidTransform{R, Vector3d::Zero()};
    addGeom(mjGEOM_ARROW, {.02 * length, .02 * length, length}, X_WA, colors[axis], segment).castshadow = false;
  }
}

void CameraRenderer::Impl::placeGeoms(const std::vector<ShownShape>& items, const State& state, const Camera& camera,
                                      int frames) {
  std::size_t count = 2;  // the floor, and the white background
  for (const ShownShape& item : items)
    count += std::max<std::size_t>(3, shapeKind(item.geometry->type).is_symbol || builtinShape(item.geometry->type)
                                          ? 0
                                          : meshes.parts(item.geometry).size());
  if (std::size_t(scene->maxgeom) < count) {
    mujoco().mjv_freeScene(scene.get());
    mujoco().mjv_makeScene(model->get(), scene.get(), int(2 * count));
  }
  scene->ngeom = 0;
  if (options.floor) {
    Vector4d color;
    color << options.floor_color, 1.;
    mjvGeom& floor = addGeom(mjGEOM_MESH, Vector3d::Ones(), {}, color, frames);
    floor.dataid = 0;
    floor.specular = 0.f;
    floor.castshadow = false;  // its shadow on itself would be speckled if the light is far away
  }
  for (const ShownShape& item : items) {
    const RigidTransform& X_WG = state.pose(item.frame);
    const Vector4d color = item.shape->color.value_or(kDefaultColor);
    const int first = scene->ngeom;
    if (shapeKind(item.geometry->type).is_symbol) {
      addMarker(item.geometry->size.empty() ? .1 : item.geometry->size.back(), X_WG, item.frame);
    } else if (const auto builtin = builtinShape(item.geometry->type)) {
      addGeom(*builtin, builtinSize(*item.geometry), X_WG, color, item.frame);
    } else {
      const std::vector<MeshLibrary::Part>& parts = meshes.parts(item.geometry);
      for (const MeshLibrary::Part& part : parts) {
        const bool own = part.color && (parts.size() > 1 || !item.shape->color || part.material >= 0);
        Vector4d shown = own ? *part.color : color;
        if (own) shown[3] *= color[3];
        mjvGeom& geom = addGeom(mjGEOM_MESH, Vector3d::Ones(), X_WG, shown, item.frame);
        geom.dataid = 2 * part.mesh;
        if (part.material < 0) continue;
        geom.matid = part.material;
        geom.texcoord = 1;
      }
    }
    for (int i = first; i < scene->ngeom; ++i) scene->geoms[i].camdist = float((X_WG.p - camera.pose.p).norm());
  }
}

void CameraRenderer::Impl::placeCamera(const Camera& camera) {
  const Matrix3d R = camera.pose.q.toRotationMatrix();
  for (mjvGLCamera& eye : scene->camera) {
    for (int i = 0; i < 3; ++i) {
      eye.pos[i] = float(camera.pose.p[i]);
      eye.forward[i] = float(R(i, 2));
      eye.up[i] = float(-R(i, 1));
    }
    const double half = camera.ortho_height > 0. ? .5 * camera.ortho_height : .5 * camera.near / camera.focal_length;
    eye.orthographic = camera.ortho_height > 0.;
    eye.frustum_center = 0.f;
    eye.frustum_width = float(half * camera.width / camera.height);
    eye.frustum_bottom = float(-half);
    eye.frustum_top = float(half);
    eye.frustum_near = float(camera.near);
    eye.frustum_far = float(camera.far);
  }
}

void CameraRenderer::Impl::placeLights() {
  const std::vector<Vector3d> usual = {{-3., 2., 3.}, {3., 0., 4.}};
  const std::vector<Vector3d>& places = options.lights.empty() ? usual : options.lights;
  scene->nlight = options.flat_colors ? 1 : int(places.size());
  if (options.flat_colors) {
    scene->lights[0] = flatLight();
    return;
  }
  for (std::size_t i = 0; i < places.size(); ++i) {
    scene->lights[i] = directionalLight(int(i), places[i], places.size(), options.shadows && i == 0);
  }
}

void CameraRenderer::Impl::makeRoom(int width, int height) {
  if (width <= context->offWidth && height <= context->offHeight) return;
  mujoco().mjr_resizeOffscreen(std::max(width, context->offWidth), std::max(height, context->offHeight), context.get());
}

/// Renders white letters on black.
CameraImage CameraRenderer::Impl::write(const std::string& text, int width, int height) {
  if (!model) {
    model = emptyModel();
    meshes.update({});
    makeContext();
  }
  std::vector<std::string> lines = brokenLines(text, kFineness * width, context->charWidth);
  lines.resize(std::min(lines.size(), std::size_t(std::max(1, kFineness * height / context->charHeight))));
  int widest = 1;
  for (const std::string& line : lines) {
    int used = 0;
    for (const char c : line) used += context->charWidth[static_cast<unsigned char>(c)];
    widest = std::max(widest, used);
  }
  const auto roundedUp = [](int x) { return (x + kFineness - 1) / kFineness * kFineness; };
  CameraImage image{roundedUp(widest), roundedUp(int(lines.size()) * context->charHeight), {}, {}};
  const mjrRect all{0, 0, image.width, image.height};
  makeRoom(all.width, all.height);
  mujoco().mjr_setBuffer(mjFB_OFFSCREEN, context.get());
  mujoco().mjr_rectangle(all, 0.f, 0.f, 0.f, 1.f);
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const float from_top = float(int(i + 1) * context->charHeight) / float(all.height);
    mujoco().mjr_text(mjFONT_NORMAL, lines[i].c_str(), context.get(), 0.f, 1.f - from_top, 1.f, 1.f, 1.f);
  }
  image.depth.assign(std::size_t(all.width) * std::size_t(all.height), 0.f);
  image.rgb.resize(3 * image.depth.size());
  Camera whole;
  whole.width = all.width;
  whole.height = all.height;
  read(whole, image.rgb.data(), nullptr);
  return image;
}

void CameraRenderer::Impl::draw(SceneTree& tree, const Camera& camera, bool visuals_only, bool segmentation) {
  const std::vector<ShownShape> items = shownShapes(tree, visual_meshes, visuals_only);
  MeshLibrary::Shapes shapes;
  for (const ShownShape& item : items) {
    if (!shapeKind(item.geometry->type).is_symbol && !builtinShape(item.geometry->type)) shapes.insert(item.geometry);
  }
  if (!model) model = emptyModel();
  if (meshes.update(shapes)) makeContext();
  makeRoom(camera.width, camera.height);
  placeGeoms(items, tree.state(), camera, int(tree.frames().size()));
  placeCamera(camera);
  placeLights();
  scene->stereo = mjSTEREO_NONE;
  std::fill(std::begin(scene->flags), std::end(scene->flags), mjtByte(0));
  scene->flags[mjRND_CULL_FACE] = 1;
  scene->flags[mjRND_SHADOW] = options.shadows && !options.flat_colors && !segmentation;
  scene->flags[mjRND_WIREFRAME] = options.wireframe && !segmentation;
  scene->flags[mjRND_SEGMENT] = scene->flags[mjRND_IDCOLOR] = segmentation;
  mujoco().mjr_setBuffer(mjFB_OFFSCREEN, context.get());
  mujoco().mjr_render({0, 0, camera.width, camera.height}, scene.get(), context.get());
}

bool CameraRenderer::Impl::hasTranslucentShapes() const {
  return std::any_of(scene->geoms, scene->geoms + scene->ngeom, [](const mjvGeom& geom) { return geom.transparent; });
}

/// Draws the scene of the last draw() before a bright white wall near the end of the view.
void CameraRenderer::Impl::drawBeforeWhite(const Camera& camera) {
  constexpr double kShareOfView = .999;
  const Matrix3d R = camera.pose.q.toRotationMatrix();
  const double far = camera.far, wide = 100. * far;
  mjvGeom& wall = addGeom(mjGEOM_BOX, {wide, wide, 1e-4 * far}, {R, camera.pose.p + kShareOfView * far * R.col(2)},
                          Vector4d::Ones(), -1);
  wall.emission = 1.f;
  wall.specular = 0.f;
  wall.castshadow = false;
  mujoco().mjr_render({0, 0, camera.width, camera.height}, scene.get(), context.get());
}

void CameraRenderer::Impl::read(const Camera& camera, std::uint8_t* rgb, float* depth) {
  mujoco().mjr_readPixels(rgb, depth, {0, 0, camera.width, camera.height}, context.get());
  const std::size_t row = std::size_t(camera.width);  // OpenGL's rows run from bottom to top
  for (std::size_t top = 0, bottom = std::size_t(camera.height) - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(rgb + 3 * row * top, rgb + 3 * row * (top + 1), rgb + 3 * row * bottom);
    if (depth) std::swap_ranges(depth + row * top, depth + row * (top + 1), depth + row * bottom);
  }
}

CameraRenderer::CameraRenderer(const RendererOptions& options) : impl_(std::make_unique<Impl>(options)) {
  constexpr std::size_t kMaxLights = 8;
  if (options.lights.size() > kMaxLights) {
    throw ValueError(cat("camera: ", options.lights.size(), " lights; expected at most ", kMaxLights));
  }
}
CameraRenderer::~CameraRenderer() = default;

CameraImage CameraRenderer::render(SceneTree& scene, const Camera& camera, bool visuals_only) {
  camera.validate();
  const int factor = impl_->options.supersampling;
  Camera fine = camera;
  fine.width *= factor;
  fine.height *= factor;
  CameraImage image{fine.width, fine.height, {}, {}};
  image.depth.resize(std::size_t(fine.width) * std::size_t(fine.height));
  image.rgb.resize(3 * image.depth.size());
  if (!impl_->gl) impl_->gl.emplace();
  const GlContext::Use use(*impl_->gl);
  const MujocoErrors errors;
  impl_->draw(scene, fine, visuals_only, false);
  impl_->read(fine, image.rgb.data(), image.depth.data());
  std::vector<std::uint8_t> over_white;
  const auto empty = [](float depth) { return depth <= 0.f; };
  if (impl_->hasTranslucentShapes() && std::ranges::any_of(image.depth, empty)) {
    over_white.resize(image.rgb.size());
    impl_->drawBeforeWhite(fine);
    impl_->read(fine, over_white.data(), nullptr);
  }
  paintBackground(image, impl_->options.background, over_white);
  if (factor > 1) image = shrunk(image, factor);
  toMeters(image.depth, camera);
  return image;
}

Letters CameraRenderer::write(const std::string& text, int width, int height) {
  if (!impl_->gl) impl_->gl.emplace();
  const GlContext::Use use(*impl_->gl);
  const MujocoErrors errors;
  const CameraImage image = shrunk(impl_->write(text, width, height), kFineness);
  Letters letters{image.width, image.height, std::vector<std::uint8_t>(image.depth.size())};
  for (std::size_t i = 0; i < letters.cover.size(); ++i) letters.cover[i] = image.rgb[3 * i];
  return letters;
}

std::vector<std::int32_t> CameraRenderer::segment(SceneTree& scene, const Camera& camera, bool visuals_only) {
  camera.validate();
  std::vector<std::int32_t> ids(std::size_t(camera.width) * std::size_t(camera.height));
  std::vector<std::uint8_t> rgb(3 * ids.size());
  if (!impl_->gl) impl_->gl.emplace();
  const GlContext::Use use(*impl_->gl);
  const MujocoErrors errors;
  impl_->draw(scene, camera, visuals_only, true);
  impl_->read(camera, rgb.data(), nullptr);
  const int frames = int(scene.frames().size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const int id = rgb[3 * i] + (rgb[3 * i + 1] << 8) + (rgb[3 * i + 2] << 16) - 1;
    ids[i] = id < frames ? id : -1;  // the floor has the index after the last frame
  }
  return ids;
}

}  // namespace kinegraph
