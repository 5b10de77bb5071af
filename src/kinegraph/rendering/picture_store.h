#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string_view>
#include <vector>

#include "kinegraph/rendering/gl/gl_functions.h"
#include "kinegraph/rendering/picture_meshes.h"

namespace kinegraph::inline rendering_internal {

/// A shape in the memory of the graphics card.
struct StoredMesh {
  PictureMesh mesh;                ///< without its vertices
  std::vector<unsigned> textures;  ///< per part; 0: none
  std::vector<unsigned> own;       ///< textures of no other shape
  unsigned array = 0, buffer = 0, indices = 0;
  std::uint64_t serial = 0;  ///< of no other shape, even after its release
};

/// Draws triangles of a surface, whose array is bound.
void drawTriangles(const PictureMesh::Part& part);

/// The shapes of pictures in the memory of the graphics card. The context must be in use for all calls.
class PictureStore {
 public:
  PictureStore() : gl_(glFunctions()) {}
  ~PictureStore();
  PictureStore(const PictureStore&) = delete;
  PictureStore& operator=(const PictureStore&) = delete;

  /// Returns the mesh of a shape; uploads it at the first call. Throws FileError for a damaged image.
  const StoredMesh& of(const std::shared_ptr<const Geometry>& geometry);
  const StoredMesh& of(const std::shared_ptr<const PictureMesh>& mesh);
  const StoredMesh& marker(double length);

  /// Returns a square from (-1, -1) to (1, 1).
  const StoredMesh& square();

  /// Frees shapes that were not asked for since the last call, if there are many.
  void tidy();

 private:
  std::unique_ptr<StoredMesh> stored(PictureMesh mesh);
  unsigned textureOf(const Image& image);
  void tidyTextures();
  void release(StoredMesh& mesh);

  const GlFunctions& gl_;
  std::map<std::shared_ptr<const void>, std::unique_ptr<StoredMesh>> meshes_;
  std::set<std::shared_ptr<const void>> used_;  ///< since the last tidy()
  std::map<double, std::unique_ptr<StoredMesh>> markers_;
  std::unique_ptr<StoredMesh> square_;
  std::uint64_t stored_ = 0;                               ///< number of shapes so far
  std::map<std::string, unsigned, std::less<>> textures_;  ///< by the bytes of their files
};

}  // namespace kinegraph::inline rendering_internal
