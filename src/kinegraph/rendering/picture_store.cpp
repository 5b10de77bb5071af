#include "kinegraph/rendering/picture_store.h"

#include <cstdint>

#include "kinegraph/geometry/files/image_file.h"

namespace kinegraph {

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

}  // namespace

PictureStore::~PictureStore() {
  for (auto& [geometry, mesh] : meshes_) release(*mesh);
  for (auto& [length, mesh] : markers_) release(*mesh);
  if (square_) release(*square_);
  for (const auto& [bytes, texture] : textures_) gl_.DeleteTextures(1, &texture);
}

void PictureStore::release(StoredMesh& mesh) {
  gl_.DeleteVertexArrays(1, &mesh.array);
  gl_.DeleteBuffers(1, &mesh.buffer);
}

unsigned PictureStore::textureOf(const Image& image) {
  if (const auto known = textures_.find(image.bytes); known != textures_.end()) return known->second;
  const Pixels pixels = decodeImage(image);
  unsigned texture = 0;
  gl_.GenTextures(1, &texture);
  gl_.BindTexture(gl::kTexture2D, texture);
  gl_.PixelStorei(gl::kUnpackAlignment, 1);
  gl_.TexImage2D(gl::kTexture2D, 0, int(gl::kSrgb8), pixels.width, pixels.height, 0, gl::kRgb, gl::kUnsignedByte,
                 pixels.rgb.data());
  gl_.GenerateMipmap(gl::kTexture2D);
  gl_.TexParameteri(gl::kTexture2D, gl::kMinFilter, int(gl::kLinearMipmap));
  gl_.TexParameteri(gl::kTexture2D, gl::kMagFilter, int(gl::kLinear));
  for (const unsigned direction : {gl::kWrapS, gl::kWrapT})
    gl_.TexParameteri(gl::kTexture2D, direction, int(gl::kRepeat));
  return textures_[image.bytes] = texture;
}

std::unique_ptr<StoredMesh> PictureStore::stored(PictureMesh mesh) {
  auto result = std::make_unique<StoredMesh>();
  for (const PictureMesh::Part& part : mesh.parts) result->textures.push_back(part.image ? textureOf(*part.image) : 0);
  gl_.GenVertexArrays(1, &result->array);
  gl_.BindVertexArray(result->array);
  gl_.GenBuffers(1, &result->buffer);
  gl_.BindBuffer(gl::kArrayBuffer, result->buffer);
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
  }
  used_.clear();
}

}  // namespace kinegraph
