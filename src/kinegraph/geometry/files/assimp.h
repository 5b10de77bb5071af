#pragma once

#include <assimp/cimport.h>
#include <assimp/material.h>
#include <assimp/scene.h>

#include <memory>
#include <string>

namespace kinegraph {

/// The functions of assimp that are used here, by their own names.
struct Assimp {
  decltype(&::aiCreatePropertyStore) aiCreatePropertyStore;
  decltype(&::aiReleasePropertyStore) aiReleasePropertyStore;
  decltype(&::aiSetImportPropertyInteger) aiSetImportPropertyInteger;
  decltype(&::aiImportFileExWithProperties) aiImportFileExWithProperties;
  decltype(&::aiApplyPostProcessing) aiApplyPostProcessing;
  decltype(&::aiReleaseImport) aiReleaseImport;
  decltype(&::aiGetErrorString) aiGetErrorString;
  decltype(&::aiGetMaterialColor) aiGetMaterialColor;
  decltype(&::aiGetMaterialTexture) aiGetMaterialTexture;
};

/// Assimp, loaded by the first call: a scene without such mesh files does without. Throws FileError, which names the
/// library, if it is missing.
const Assimp& assimp();

using AssimpScene = std::unique_ptr<const aiScene, decltype(&aiReleaseImport)>;

/// What a mesh file holds, as triangles whose corners exist. Throws FileError.
AssimpScene readAssimpScene(const std::string& path);

}  // namespace kinegraph
