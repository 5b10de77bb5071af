#include "kinegraph/geometry/files/assimp.h"

#include <assimp/cfileio.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"

namespace kinegraph::inline geometry_internal {

namespace {

Assimp loadAssimp() {
  const DynamicLibrary library(KINEGRAPH_ASSIMP_LIBRARY, "a mesh file", "aiReleaseImport");
  Assimp functions;
  KINEGRAPH_ASSIMP_FUNCTIONS(KINEGRAPH_LIBRARY_LOAD)
  return functions;
}

/// Writes .5 as 0.5 in an OBJ text: assimp reads only the latter.
std::string withLeadingZeros(const std::string& text) {
  std::string out;
  out.reserve(text.size() + text.size() / 16);
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char before = i > 0 ? text[i - 1] : ' ';
    const bool behind_gap = before == ' ' || before == '\t' || before == '-' || before == '+';
    const bool number = text[i] == '.' && i + 1 < text.size() && std::isdigit(static_cast<unsigned char>(text[i + 1]));
    if (number && behind_gap) out += '0';
    out += text[i];
  }
  return out;
}

/// A file of which assimp reads.
struct OpenFile {
  aiFile interface;
  std::string bytes;
  std::size_t at = 0;

  static OpenFile& of(aiFile* file) { return *reinterpret_cast<OpenFile*>(file->UserData); }
};

std::size_t readOpenFile(aiFile* file, char* buffer, std::size_t size, std::size_t count) {
  OpenFile& open = OpenFile::of(file);
  if (size == 0) return 0;
  count = std::min(count, (open.bytes.size() - open.at) / size);
  std::memcpy(buffer, open.bytes.data() + open.at, size * count);
  open.at += size * count;
  return count;
}

aiReturn seekOpenFile(aiFile* file, std::size_t offset, aiOrigin origin) {
  OpenFile& open = OpenFile::of(file);
  const std::size_t start = origin == aiOrigin_SET ? 0 : origin == aiOrigin_CUR ? open.at : open.bytes.size();
  if (start + offset > open.bytes.size()) return aiReturn_FAILURE;
  open.at = start + offset;
  return aiReturn_SUCCESS;
}

/// Opens files for assimp and records their paths.
aiFile* openFile(aiFileIO* io, const char* path, const char* mode) {
  if (auto* files = reinterpret_cast<std::vector<std::string>*>(io->UserData)) files->push_back(path);
  std::error_code error;
  if (mode[0] != 'r' || !std::filesystem::is_regular_file(path, error)) return nullptr;
  std::ifstream stream(path, std::ios::binary);
  std::stringstream bytes;
  bytes << stream.rdbuf();
  auto open = std::make_unique<OpenFile>();
  open->bytes = lowerExtension(path) == ".obj" ? withLeadingZeros(bytes.str()) : bytes.str();
  aiFile& file = open->interface;
  file.ReadProc = readOpenFile;
  file.WriteProc = [](aiFile*, const char*, std::size_t, std::size_t) -> std::size_t { return 0; };
  file.TellProc = [](aiFile* f) { return OpenFile::of(f).at; };
  file.FileSizeProc = [](aiFile* f) { return OpenFile::of(f).bytes.size(); };
  file.SeekProc = seekOpenFile;
  file.FlushProc = [](aiFile*) {};
  file.UserData = reinterpret_cast<aiUserData>(open.get());
  return &open.release()->interface;
}

void closeFile(aiFileIO*, aiFile* file) { delete &OpenFile::of(file); }

/// Serializes imports: assimp's C interface has one error message for all threads.
AssimpScene import(const std::string& path, std::vector<std::string>* files) {
  static std::mutex reading;
  const std::lock_guard lock(reading);
  const Assimp& ai = assimp();
  const std::unique_ptr<aiPropertyStore, decltype(ai.aiReleasePropertyStore)> settings(ai.aiCreatePropertyStore(),
                                                                                       ai.aiReleasePropertyStore);
  // Robot descriptions expect Collada meshes without the conversion of the up direction.
  ai.aiSetImportPropertyInteger(settings.get(), AI_CONFIG_IMPORT_COLLADA_IGNORE_UP_DIRECTION, 1);
  aiFileIO io{openFile, closeFile, reinterpret_cast<aiUserData>(files)};
  AssimpScene scene(ai.aiImportFileExWithProperties(path.c_str(), 0, &io, settings.get()), ai.aiReleaseImport);
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

AssimpScene readAssimpScene(const std::string& path, std::vector<std::string>* files) {
  AssimpScene scene = import(path, files);
  checkFaces(*scene, path);                // the next step relies on it
  const aiScene* whole = scene.release();  // assimp releases it if a step fails
  scene.reset(assimp().aiApplyPostProcessing(whole, aiProcess_Triangulate));
  if (!scene || !scene->mRootNode) throw FileError(cat("mesh file '", path, "' cannot be read: it has no triangles"));
  return scene;
}

}  // namespace kinegraph::inline geometry_internal
