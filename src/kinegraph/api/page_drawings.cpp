#include "kinegraph/api/page_drawings.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "kinegraph/rendering/projection.h"
#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline api_internal {

namespace {

using Colors = PictureDrawing::Colors;

Vector4d colorOf(const PageDrawing& drawing) {
  const ColorBytes& c = drawing.colors[0];
  return Vector4d(c[0], c[1], c[2], c[3]) / 255.;
}

/// Returns the points at these indices.
template <class T>
std::vector<T> picked(const std::vector<T>& from, const std::vector<std::size_t>& indices) {
  std::vector<T> points;
  if (from.size() < 2) return points;  // one color for all
  for (const std::size_t i : indices) points.push_back(from[i]);
  return points;
}

PictureDrawing drawn(PictureMesh mesh, const PageDrawing& from, Colors colors = Colors::symbol) {
  return {std::make_shared<const PictureMesh>(std::move(mesh)), from.pose, colorOf(from), colors};
}

PictureDrawing drawnLine(const PageDrawing& from) {
  std::vector<std::size_t> ends;
  for (std::size_t i = 0; i + 1 < from.points.size(); ++i) ends.insert(ends.end(), {i, i + 1});
  PictureDrawing line = drawn(linesMesh(picked(from.points, ends), picked(from.colors, ends)), from);
  line.width = from.width;
  return line;
}

PictureDrawing drawnPoints(const PageDrawing& from) {
  const bool has_colors = from.colors.size() > 1;
  PictureDrawing points = drawn(pointsMesh(from.points, has_colors ? from.colors : std::vector<ColorBytes>()), from);
  points.color[3] = 1.;
  points.size = from.size;
  return points;
}

PictureDrawing drawnImage(const PageDrawing& from, double width, double height, double z) {
  PictureDrawing image = drawn(imageMesh({from.columns, from.rows, from.rgb}, width, height, z), from, Colors::image);
  image.color = Vector4d::Ones();
  return image;
}

/// The edges of a pyramid, a triangle above its upper side, and an image at its end, as on the page.
std::vector<PictureDrawing> drawnFrustum(const PageDrawing& from) {
  const double z = from.size, y = .5 * z / from.focal_length, x = y * from.aspect;
  const std::vector<Vector3d> corners = {
      {0., 0., 0.},           {-x, -y, z},           {x, -y, z},       {x, y, z}, {-x, y, z},
      {-.3 * x, -1.1 * y, z}, {.3 * x, -1.1 * y, z}, {0., -1.4 * y, z}};
  const std::vector<std::size_t> edges = {0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1, 5, 6, 6, 7, 7, 5};
  PictureDrawing lines = drawn(linesMesh(picked(corners, edges)), from);
  lines.width = from.width;
  std::vector<PictureDrawing> all{lines};
  if (!from.rgb.empty()) all.push_back(drawnImage(from, 2. * x, 2. * y, z));
  return all;
}

/// Returns the shapes of a drawing, in the coordinates of its frame.
std::vector<PictureDrawing> shapesOf(const PageDrawing& from) {
  if (from.type == "line") return {drawnLine(from)};
  if (from.type == "points") return {drawnPoints(from)};
  if (from.type == "arrow") return {drawn(arrowMesh(from.points[0], from.points[1], from.size), from, Colors::lit)};
  if (from.type == "axes") return {drawn(markerMesh(from.size), from)};
  if (from.type == "frustum") return drawnFrustum(from);
  if (from.type == "image") return {drawnImage(from, from.size, from.size / from.aspect, 0.)};
  return {};  // a label
}

/// Returns the pose of a drawing's frame; nothing if the scene does not have it.
std::optional<Pose> framePose(const PageDrawing& drawing, SceneTree& scene) {
  if (drawing.frame.empty()) return Pose{};
  const FrameData* frame = scene.find(drawing.frame);
  return frame ? std::optional(scene.worldPose(*frame)) : std::nullopt;
}

/// Returns where the text of a drawing stands, in the coordinates of its frame.
Vector3d textPlace(const PageDrawing& drawing) {
  if (drawing.points.empty()) return drawing.pose.p;
  const Vector3d at = drawing.type == "arrow" ? drawing.points[0] + drawing.points[1] : drawing.points[0];
  return drawing.pose.p + drawing.pose.q * at;
}

/// Without a range, everything before the camera is visible.
Camera withRange(Camera camera) {
  if (camera.has_range) return camera;
  camera.near = 1e-4;
  camera.far = 1e6;
  return camera;
}

struct Text {
  Vector3d at;  ///< column, row, and a number that grows with the depth
  const Letters* letters;
};

bool overlap(const Text& a, const Text& b) {
  const Eigen::Array2d apart = (a.at - b.at).head<2>().array().abs();
  return apart.x() <= .5 * (a.letters->width + b.letters->width) + 8. &&
         apart.y() <= .5 * (a.letters->height + b.letters->height);
}

}  // namespace

std::vector<PictureDrawing> PageDrawings::shapes(const Listed& drawings, SceneTree& scene) {
  std::vector<PictureDrawing> all;
  for (const auto& drawing : drawings) {
    auto known = known_.find(drawing);
    if (known == known_.end()) known = known_.emplace(drawing, shapesOf(*drawing)).first;
    const std::optional<Pose> X_WF = framePose(*drawing, scene);
    if (!X_WF) continue;
    for (PictureDrawing shape : known->second) {
      shape.pose = *X_WF * shape.pose;
      all.push_back(std::move(shape));
    }
  }
  const std::set<std::shared_ptr<const PageDrawing>> used(drawings.begin(), drawings.end());
  std::erase_if(known_, [&](const auto& entry) { return !used.contains(entry.first); });
  return all;
}

void PageDrawings::write(const Listed& drawings, SceneTree& scene, const Camera& camera, CameraRenderer& writer,
                         CameraImage& image) {
  const Eigen::Matrix4d to_image = projection(withRange(camera));
  std::set<const Letters*> used;
  std::vector<Text> texts;
  for (const auto& drawing : drawings) {
    const std::optional<Pose> X_WF = framePose(*drawing, scene);
    if (drawing->text.empty() || !X_WF) continue;
    const Eigen::Vector4d p = to_image * (X_WF->p + X_WF->q * textPlace(*drawing)).homogeneous();
    if (!(p[3] > 0.) || std::abs(p[2]) > p[3]) continue;  // not between the nearest and the farthest visible depth
    const Vector3d at = p.head<3>() / p[3];
    if (std::abs(at.x()) > 2. || std::abs(at.y()) > 2.) continue;
    const std::tuple key(drawing->text, image.width, image.height);
    auto known = letters_.find(key);
    if (known == letters_.end())
      known = letters_.emplace(key, writer.write(drawing->text, image.width, image.height)).first;
    used.insert(&known->second);
    texts.push_back({{.5 * (1. + at.x()) * image.width, .5 * (1. - at.y()) * image.height, at.z()}, &known->second});
  }
  std::stable_sort(texts.begin(), texts.end(), [](const Text& a, const Text& b) { return a.at.z() < b.at.z(); });
  std::vector<Text> seen;
  for (const Text& text : texts) {
    if (std::any_of(seen.begin(), seen.end(), [&](const Text& other) { return overlap(text, other); })) continue;
    drawLabel(image.rgb, image.width, *text.letters, int(std::lround(text.at.x())), int(std::lround(text.at.y())));
    seen.push_back(text);
  }
  std::erase_if(letters_, [&](const auto& entry) { return !used.contains(&entry.second); });
}

}  // namespace kinegraph::inline api_internal
