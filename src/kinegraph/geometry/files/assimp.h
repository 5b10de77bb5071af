#pragma once

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <memory>
#include <string>
#include <vector>

#include "kinegraph/common/dynamic_library.h"

namespace kinegraph::inline geometry_internal {

// clang-format off
#define KINEGRAPH_ASSIMP_FUNCTIONS(X) \
  X(aiCreatePropertyStore) X(aiReleasePropertyStore) X(aiSetImportPropertyInteger) X(aiImportFileExWithProperties) \
  X(aiApplyPostProcessing) X(aiReleaseImport) X(aiGetErrorString) X(aiGetMaterialColor) \
  X(aiGetMaterialString) X(aiGetMaterialTexture)
// clang-format on

/// The assimp functions used here, under their own names.
struct Assimp {
  KINEGRAPH_ASSIMP_FUNCTIONS(KINEGRAPH_LIBRARY_MEMBER)
};

/// Returns assimp, loaded at the first call: scenes without such mesh files do not need it. Throws FileError with the
/// library's name if it is missing.
const Assimp& assimp();

using AssimpScene = std::unique_ptr<const aiScene, decltype(&aiReleaseImport)>;

/// Reads a mesh file as triangles with valid vertex indices. Appends the paths of all files that it opens to `files`.
/// Throws FileError.
AssimpScene readAssimpScene(const std::string& path, std::vector<std::string>* files = nullptr);

}  // namespace kinegraph::inline geometry_internal
