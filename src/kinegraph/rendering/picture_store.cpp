#include "kinegraph/rendering/picture_store.h"

#include <cstring>
#include <functional>
#include <utility>

#include "kinegraph/geometry/files/image_file.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr std::size_t kMostUnused = 64;

/// Numbers of each attribute of a vertex, in order.
std::vector<int> attributesOf(PictureMesh::Kind kind) {
  switch (kind) {
    case PictureMesh::Kind::surface:
      return {3, 3, 2};
    case PictureMesh::Kind::lines:
      return {3, 3, 2, 3};
    default:
      return {3, 3};
  }
}

/// Vertices without most of their repetitions, and the number of each vertex of the triangles.
struct IndexedVertices {
  std::vector<float> vertices;
  std::vector<unsigned> indices;
};

/// Uploads an image. Beyond its edges it continues as `beyond` says.
unsigned uploaded(const Pixels& pixels, unsigned beyond) {
  const GlFunctions& f = glFunctions();
  unsigned texture = 0;
  f.GenTextures(1, &texture);
  f.BindTexture(gl::kTexture2D, texture);
  f.PixelStorei(gl::kUnpackAlignment, 1);
  f.TexImage2D(gl::kTexture2D, 0, int(gl::kSrgb8), pixels.width, pixels.height, 0, gl::kRgb, gl::kUnsignedByte,
               pixels.rgb.data());
  f.GenerateMipmap(gl::kTexture2D);
  f.TexParameteri(gl::kTexture2D, gl::kMinFilter, int(gl::kLinearMipmap));
  f.TexParameteri(gl::kTexture2D, gl::kMagFilter, int(gl::kLinear));
  for (const unsigned direction : {gl::kWrapS, gl::kWrapT}) f.TexParameteri(gl::kTexture2D, direction, int(beyond));
  return texture;
}

/// Finds a repetition if few other vertices are in between, as in surfaces of neighboring triangles.
IndexedVertices indexed(const std::vector<float>& vertices, std::size_t stride) {
  constexpr std::size_t kPlaces = 1 << 14;
  const std::size_t bytes = stride * sizeof(float);
  IndexedVertices result;
  std::vector<unsigned> last(kPlaces, 0);  // 1 + the last vertex with that hash
  result.indices.reserve(vertices.size() / stride);
  for (std::size_t i = 0; i < vertices.size(); i += stride) {
    const std::string_view vertex(reinterpret_cast<const char*>(&vertices[i]), bytes);
    unsigned& place = last[std::hash<std::string_view>()(vertex) % kPlaces];
    if (place == 0 || std::memcmp(&result.vertices[(place - 1) * stride], vertex.data(), bytes) != 0) {
      const auto from = vertices.begin() + std::ptrdiff_t(i);
      result.vertices.insert(result.vertices.end(), from, from + std::ptrdiff_t(stride));
      place = unsigned(result.vertices.size() / stride);
    }
    result.indices.push_back(place - 1);
  }
  return result;
}

}  // namespace

void drawTriangles(const PictureMesh::Part& part) {
  const std::uintptr_t from = sizeof(unsigned) * std::size_t(part.first);
  glFunctions().DrawElements(gl::kTriangles, part.count, gl::kUnsignedInt, reinterpret_cast<const void*>(from));
}

PictureStore::~PictureStore() {
  for (auto& [geometry, mesh] : meshes_) release(*mesh);
  for (auto& [length, mesh] : markers_) release(*mesh);
  if (square_) release(*square_);
  for (const auto& [bytes, texture] : textures_) gl_.DeleteTextures(1, &texture);
}

void PictureStore::release(StoredMesh& mesh) {
  gl_.DeleteVertexArrays(1, &mesh.array);
  for (const unsigned buffer : {mesh.buffer, mesh.indices}) gl_.DeleteBuffers(1, &buffer);
  for (const unsigned texture : mesh.own) gl_.DeleteTextures(1, &texture);
}

unsigned PictureStore::textureOf(const Image& image) {
  if (const auto known = textures_.find(image.bytes); known != textures_.end()) return known->second;
  return textures_[image.bytes] = uploaded(decodeImage(image), gl::kRepeat);
}

std::unique_ptr<StoredMesh> PictureStore::stored(PictureMesh mesh) {
  auto result = std::make_unique<StoredMesh>();
  result->serial = ++stored_;
  for (PictureMesh::Part& part : mesh.parts) {
    unsigned texture = part.image ? textureOf(*part.image) : 0;
    if (part.pixels) {
      texture = uploaded(*std::exchange(part.pixels, nullptr), gl::kClampToEdge);
      result->own.push_back(texture);
    }
    result->textures.push_back(texture);
  }
  gl_.GenVertexArrays(1, &result->array);
  gl_.BindVertexArray(result->array);
  gl_.GenBuffers(1, &result->buffer);
  gl_.BindBuffer(gl::kArrayBuffer, result->buffer);
  if (mesh.kind == PictureMesh::Kind::surface) {
    IndexedVertices shared = indexed(mesh.vertices, std::size_t(mesh.stride()));
    mesh.vertices = std::move(shared.vertices);
    gl_.GenBuffers(1, &result->indices);
    gl_.BindBuffer(gl::kIndexBuffer, result->indices);
    gl_.BufferData(gl::kIndexBuffer, std::ptrdiff_t(shared.indices.size() * sizeof(unsigned)), shared.indices.data(),
                   gl::kStaticDraw);
  }
  gl_.BufferData(gl::kArrayBuffer, std::ptrdiff_t(mesh.vertices.size() * sizeof(float)), mesh.vertices.data(),
                 gl::kStaticDraw);
  unsigned index = 0;
  std::uintptr_t offset = 0;
  for (const int numbers : attributesOf(mesh.kind)) {
    gl_.EnableVertexAttribArray(index);
    gl_.VertexAttribPointer(index++, unsigned(numbers), gl::kFloat, 0, int(sizeof(float)) * mesh.stride(),
                            reinterpret_cast<const void*>(offset));
    offset += sizeof(float) * std::size_t(numbers);
  }
  result->mesh = std::move(mesh);
  std::vector<float>().swap(result->mesh.vertices);
  return result;
}

const StoredMesh& PictureStore::of(const std::shared_ptr<const Geometry>& geometry) {
  used_.insert(geometry);
  std::unique_ptr<StoredMesh>& mesh = meshes_[geometry];
  if (!mesh) mesh = stored(pictureMesh(*geometry));
  return *mesh;
}

const StoredMesh& PictureStore::of(const std::shared_ptr<const PictureMesh>& drawn) {
  used_.insert(drawn);
  std::unique_ptr<StoredMesh>& mesh = meshes_[drawn];
  if (!mesh) mesh = stored(*drawn);
  return *mesh;
}

const StoredMesh& PictureStore::marker(double length) {
  std::unique_ptr<StoredMesh>& mesh = markers_[length];
  if (!mesh) mesh = stored(markerMesh(length));
  return *mesh;
}

const StoredMesh& PictureStore::square() {
  if (square_) return *square_;
  PictureMesh mesh;
  for (const auto& [x, y] : {std::pair(-1.f, -1.f), {1.f, -1.f}, {1.f, 1.f}, {-1.f, -1.f}, {1.f, 1.f}, {-1.f, 1.f}})
    mesh.vertices.insert(mesh.vertices.end(), {x, y, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f});
  mesh.parts.push_back({0, 6});
  square_ = stored(std::move(mesh));
  return *square_;
}

void PictureStore::tidy() {
  if (meshes_.size() > used_.size() + kMostUnused) {
    std::erase_if(meshes_, [&](auto& entry) {
      if (used_.contains(entry.first)) return false;
      if (entry.second) release(*entry.second);
      return true;
    });
    tidyTextures();
  }
  used_.clear();
}

/// Frees the textures that no shape has.
void PictureStore::tidyTextures() {
  std::set<unsigned> used;
  for (const auto& [shape, mesh] : meshes_) {
    if (mesh) used.insert(mesh->textures.begin(), mesh->textures.end());
  }
  std::erase_if(textures_, [&](const auto& entry) {
    if (used.contains(entry.second)) return false;
    gl_.DeleteTextures(1, &entry.second);
    return true;
  });
}

}  // namespace kinegraph::inline rendering_internal
