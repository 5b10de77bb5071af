#pragma once

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <memory>
#include <string>

#include "kinegraph/common/dynamic_library.h"

namespace kinegraph {

// clang-format off
#define KINEGRAPH_ASSIMP_FUNCTIONS(X) \
  X(aiCreatePropertyStore) X(aiReleasePropertyStore) X(aiSetImportPropertyInteger) X(aiImportFileExWithProperties) \
  X(aiApplyPostProcessing) X(aiReleaseImport) X(aiGetErrorString) X(aiGetMaterialColor) X(aiGetMaterialTexture)
// clang-format on

/// The functions of assimp that are used here, by their own names.
struct Assimp {
  KINEGRAPH_ASSIMP_FUNCTIONS(KINEGRAPH_LIBRARY_MEMBER)
};

/// Assimp, loaded by the first call: a scene without such mesh files does without. Throws FileError, which names the
/// library, if it is missing.
const Assimp& assimp();

using AssimpScene = std::unique_ptr<const aiScene, decltype(&aiReleaseImport)>;

/// What a mesh file holds, as triangles whose corners exist. Throws FileError.
AssimpScene readAssimpScene(const std::string& path);

}  // namespace kinegraph
