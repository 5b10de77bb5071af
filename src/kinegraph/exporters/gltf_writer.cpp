#include "kinegraph/exporters/writers.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/json.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_file.h"
#include "kinegraph/geometry/shapes/tessellation.h"
#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/scene/tree/visual_meshes.h"

namespace kinegraph {

namespace {

namespace json = boost::json;

// Enumeration values of the glTF specification.
constexpr int kFloat = 5126, kUint32 = 5125, kByte = 5121, kVertexData = 34962, kIndexData = 34963, kPoints = 0,
              kTriangles = 4;
constexpr std::uint32_t kGltf = 0x46546C67, kJson = 0x4E4F534A, kBinary = 0x004E4942;
constexpr std::array<std::uint8_t, 4> kGray = {204, 204, 204, 255};

json::array list(std::initializer_list<double> numbers) {
  json::array values;
  for (const double x : numbers) values.push_back(jsonOf(x));
  return values;
}

void appendWord(std::string& bytes, std::uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += char((word >> shift) & 255);
}

class GltfWriter {
 public:
  explicit GltfWriter(const Config& config) : config_(config) {}

  std::string write() {
    json::array roots;
    for (const auto& frame : config_.scene()->frames()) {
      addNode(*frame);
      if (!frame->parent) roots.push_back(frame->id);
    }
    const double half = std::sqrt(.5);
    json::object scene{{"name", "scene"}, {"rotation", list({-half, 0., 0., half})}};
    addUnlessEmpty(scene, "children", roots);
    nodes_.push_back(std::move(scene));
    json::object document{{"asset", json::object{{"version", "2.0"}, {"generator", "Kinegraph"}}},
                          {"scene", 0},
                          {"scenes", json::array{json::object{{"nodes", json::array{nodes_.size() - 1}}}}},
                          {"nodes", nodes_}};
    addUnlessEmpty(document, "meshes", meshes_);
    addUnlessEmpty(document, "materials", materials_);
    addUnlessEmpty(document, "textures", textures_);
    addUnlessEmpty(document, "images", images_);
    addUnlessEmpty(document, "accessors", accessors_);
    addUnlessEmpty(document, "bufferViews", views_);
    if (!data_.empty()) document["buffers"] = json::array{json::object{{"byteLength", data_.size()}}};
    return packed(json::serialize(document));
  }

 private:
  /// Accessor indices of a mesh in the file.
  struct MeshData {
    int positions = -1, colors = -1, triangles = -1, texcoords = -1;
    std::vector<std::pair<int, int>> textured;  ///< triangles and their texture; `triangles` are the others
    std::array<std::uint8_t, 4> color = kGray;  ///< used if the mesh has a single color
  };

  static void addUnlessEmpty(json::object& object, std::string_view name, const json::array& entries) {
    if (!entries.empty()) object[name] = entries;
  }

  /// Assembles the file: a header, the JSON text, the binary part.
  std::string packed(std::string json) const {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    const std::size_t total = 12 + 8 + json.size() + (data_.empty() ? 0 : 8 + data_.size());
    if (total > std::numeric_limits<std::uint32_t>::max())
      throw FileError("the scene is too large for a .glb file of 4 GB");
    std::string bytes;
    bytes.reserve(total);
    for (const std::uint32_t word : {kGltf, std::uint32_t(2), std::uint32_t(total), std::uint32_t(json.size()), kJson})
      appendWord(bytes, word);
    bytes += json;
    if (!data_.empty()) {
      appendWord(bytes, std::uint32_t(data_.size()));
      appendWord(bytes, kBinary);
      bytes += data_;
    }
    return bytes;
  }

  void addNode(const FrameData& frame) {
    const Pose pose = frame.relativePose();
    json::object node{{"name", jsonOf(frame.name)}};
    if (!pose.p.isZero(0.)) node["translation"] = list({pose.p[0], pose.p[1], pose.p[2]});
    if (!pose.q.vec().isZero(0.)) node["rotation"] = list({pose.q.x(), pose.q.y(), pose.q.z(), pose.q.w()});
    if (const int mesh = frame.shape ? addMesh(*frame.shape) : -1; mesh >= 0) node["mesh"] = mesh;
    json::array children;
    for (const FrameData* child : frame.children) children.push_back(child->id);
    addUnlessEmpty(node, "children", children);
    nodes_.push_back(std::move(node));
  }

  /// Adds the mesh of a shape with its material; returns -1 if nothing is visible.
  int addMesh(const Shape& shape) {
    std::shared_ptr<const Geometry> geometry = visual_meshes_.of(shape);
    if (!geometry) geometry = shape.geometry;
    const MeshData& data = addData(geometry);
    if (data.positions < 0) return -1;
    Vector4d rgba;
    for (int i = 0; i < 4; ++i) rgba[i] = data.colors >= 0 ? 1. : data.color[std::size_t(i)] / 255.;
    if (shape.color) rgba = data.colors >= 0 ? Vector4d(1., 1., 1., (*shape.color)[3]) : *shape.color;
    rgba = rgba.cwiseMax(0.).cwiseMin(1.);
    json::array primitives;
    if (data.triangles >= 0 || data.textured.empty()) {
      json::object attributes{{"POSITION", data.positions}};
      if (data.colors >= 0) attributes["COLOR_0"] = data.colors;
      json::object primitive{{"mode", data.triangles >= 0 ? kTriangles : kPoints}, {"attributes", attributes}};
      if (data.triangles >= 0) primitive["indices"] = data.triangles;
      primitive["material"] = materialOf(rgba, -1);
      primitives.push_back(std::move(primitive));
    }
    for (const auto& [triangles, texture] : data.textured) {
      const Vector4d white(1., 1., 1., shape.color ? rgba[3] : 1.);
      primitives.push_back(
          json::object{{"mode", kTriangles},
                       {"attributes", json::object{{"POSITION", data.positions}, {"TEXCOORD_0", data.texcoords}}},
                       {"indices", triangles},
                       {"material", materialOf(white, texture)}});
    }
    return indexOf(json::object{{"primitives", primitives}}, meshes_, mesh_index_);
  }

  /// Index of an entry; equal entries are stored once.
  static int indexOf(json::object entry, json::array& entries, std::map<std::string, int>& index) {
    const auto [known, is_new] = index.emplace(json::serialize(entry), int(entries.size()));
    if (is_new) entries.push_back(std::move(entry));
    return known->second;
  }

  int materialOf(const Vector4d& rgba, int texture) {
    json::object material{{"doubleSided", true}};
    if (rgba[3] < 1.) material["alphaMode"] = "BLEND";
    json::object look{{"metallicFactor", 0},
                      {"roughnessFactor", .8},
                      {"baseColorFactor", list({rgba[0], rgba[1], rgba[2], rgba[3]})}};
    if (texture >= 0) look["baseColorTexture"] = json::object{{"index", texture}};
    material["pbrMetallicRoughness"] = std::move(look);
    return indexOf(std::move(material), materials_, material_index_);
  }

  const MeshData& addData(const std::shared_ptr<const Geometry>& geometry) {
    const auto [entry, is_new] = data_of_.emplace(geometry, MeshData{});
    MeshData& added = entry->second;
    if (!is_new || geometry->type == ShapeType::lines) return added;
    const Mesh surface =
        geometry->type == ShapeType::pointCloud && geometry->mesh ? *geometry->mesh : tessellate(*geometry);
    if (surface.vertices.empty()) return added;
    added.positions = addPositions(surface.vertices);
    if (surface.colors.size() == 1) added.color = surface.colors[0];
    if (surface.colors.size() == surface.vertices.size() && surface.colors.size() > 1)
      added.colors = addColors(surface);
    std::vector<bool> is_textured(surface.triangles.size());
    if (!surface.textures.empty()) added.texcoords = addTexcoords(surface);
    for (const TexturedTriangles& textured : surface.textures) {
      std::vector<std::array<std::uint32_t, 3>> triangles(surface.triangles.begin() + textured.first,
                                                          surface.triangles.begin() + textured.first + textured.count);
      std::fill_n(is_textured.begin() + textured.first, textured.count, true);
      const int texture = textureOf(textured.image);
      added.textured.emplace_back(addTriangles(triangles), texture);
    }
    std::vector<std::array<std::uint32_t, 3>> plain;
    for (std::size_t i = 0; i < surface.triangles.size(); ++i) {
      if (!is_textured[i]) plain.push_back(surface.triangles[i]);
    }
    if (!plain.empty()) added.triangles = addTriangles(plain);
    return added;
  }

  int textureOf(const std::shared_ptr<const Image>& image) {
    const auto [known, is_new] = texture_index_.try_emplace(image->bytes, int(textures_.size()));
    if (!is_new) return known->second;
    views_.push_back(json::object{{"buffer", 0}, {"byteOffset", data_.size()}, {"byteLength", image->bytes.size()}});
    data_ += image->bytes;
    data_.resize((data_.size() + 3) / 4 * 4);  // keeps the next block 4-byte aligned
    images_.push_back(json::object{{"bufferView", views_.size() - 1}, {"mimeType", mediaType(*image)}});
    textures_.push_back(json::object{{"source", images_.size() - 1}});
    return known->second;
  }

  int addAccessor(std::size_t start, int target, int component, const char* type, std::size_t count,
                  const json::object& more) {
    views_.push_back(
        json::object{{"buffer", 0}, {"byteOffset", start}, {"byteLength", data_.size() - start}, {"target", target}});
    json::object accessor{
        {"bufferView", views_.size() - 1}, {"componentType", component}, {"count", count}, {"type", type}};
    accessor.insert(more.begin(), more.end());
    accessors_.push_back(std::move(accessor));
    return int(accessors_.size()) - 1;
  }

  int addPositions(const std::vector<Vector3d>& points) {
    const std::size_t start = data_.size();
    Eigen::Vector3f low = points[0].cast<float>(), high = low;
    for (const Vector3d& point : points) {
      const Eigen::Vector3f p = point.cast<float>();
      low = low.cwiseMin(p);
      high = high.cwiseMax(p);
      for (const float x : p) appendWord(data_, std::bit_cast<std::uint32_t>(x));
    }
    const auto bounds = [](const Eigen::Vector3f& v) { return list({v[0], v[1], v[2]}); };
    return addAccessor(start, kVertexData, kFloat, "VEC3", points.size(),
                       json::object{{"min", bounds(low)}, {"max", bounds(high)}});
  }

  int addColors(const Mesh& mesh) {
    const std::size_t start = data_.size();
    for (const auto& color : mesh.colors) data_.append(color.begin(), color.end());
    return addAccessor(start, kVertexData, kByte, "VEC4", mesh.colors.size(), json::object{{"normalized", true}});
  }

  int addTexcoords(const Mesh& mesh) {
    const std::size_t start = data_.size();
    for (const auto& [right, up] : mesh.texcoords) {
      for (const float x : {right, 1.f - up}) appendWord(data_, std::bit_cast<std::uint32_t>(x));
    }
    return addAccessor(start, kVertexData, kFloat, "VEC2", mesh.texcoords.size(), {});
  }

  int addTriangles(const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    const std::size_t start = data_.size();
    for (const auto& triangle : triangles) {
      for (const std::uint32_t corner : triangle) appendWord(data_, corner);
    }
    return addAccessor(start, kIndexData, kUint32, "SCALAR", 3 * triangles.size(), {});
  }

  const Config& config_;
  VisualMeshes visual_meshes_;
  json::array nodes_, meshes_, materials_, textures_, images_, accessors_, views_;
  std::map<std::string, int> mesh_index_, material_index_;
  std::map<std::string, int> texture_index_;  ///< by the bytes of the file
  std::map<std::shared_ptr<const Geometry>, MeshData> data_of_;
  std::string data_;  ///< the binary part
};

}  // namespace

std::string gltfBytes(const Config& config) { return GltfWriter(config).write(); }

void writeGltf(const Config& config, const std::string& path) {
  const std::string bytes = gltfBytes(config);
  std::ofstream stream(path, std::ios::binary);
  stream << bytes;
  stream.flush();
  if (!stream) throw FileError(cat("scene file '", path, "' cannot be written"));
}

}  // namespace kinegraph
