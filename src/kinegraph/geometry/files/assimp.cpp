#include "kinegraph/geometry/files/assimp.h"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <mutex>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

Assimp loadAssimp() {
  const DynamicLibrary library(KINEGRAPH_ASSIMP_LIBRARY, "a mesh file");
  Assimp functions;
  KINEGRAPH_ASSIMP_FUNCTIONS(KINEGRAPH_LIBRARY_LOAD)
  return functions;
}

/// Serializes imports: assimp's C interface has one error message for all threads.
AssimpScene import(const std::string& path) {
  static std::mutex reading;
  const std::lock_guard lock(reading);
  const Assimp& ai = assimp();
  const std::unique_ptr<aiPropertyStore, decltype(ai.aiReleasePropertyStore)> settings(ai.aiCreatePropertyStore(),
                                                                                       ai.aiReleasePropertyStore);
  // Robot descriptions expect Collada meshes without the conversion of the up direction.
  ai.aiSetImportPropertyInteger(settings.get(), AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  AssimpScene scene(ai.aiImportFileExWithProperties(path.c_str(), 0, nullptr, settings.get()), ai.aiReleaseImport);
  if (!scene) throw FileError(cat("mesh file '", path, "' cannot be read: ", ai.aiGetErrorString()));
  return scene;
}

void checkFaces(const aiScene& scene, const std::string& path) {
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    const aiMesh& part = *scene.mMeshes[m];
    for (unsigned f = 0; f < part.mNumFaces; ++f) {
      const aiFace& face = part.mFaces[f];
      for (unsigned i = 0; i < face.mNumIndices; ++i) {
        if (face.mIndices[i] < part.mNumVertices) continue;
        throw FileError(
            cat("mesh file '", path, "': face ", f, " names vertex ", face.mIndices[i], " of ", part.mNumVertices));
      }
    }
  }
}

}  // namespace

const Assimp& assimp() {
  static const Assimp functions = loadAssimp();
  return functions;
}

AssimpScene readAssimpScene(const std::string& path) {
  AssimpScene scene = import(path);
  checkFaces(*scene, path);                // the next steps rely on it
  const aiScene* whole = scene.release();  // assimp releases it if a step fails
  scene.reset(assimp().aiApplyPostProcessing(whole, aiProcess_Triangulate | aiProcess_JoinIdenticalVertices));
  if (!scene || !scene->mRootNode) throw FileError(cat("mesh file '", path, "' cannot be read: it has no triangles"));
  return scene;
}

}  // namespace kinegraph
