#include <algorithm>
#include <cctype>
#include <filesystem>

#include "kinegraph/formats/urdf_reader.h"
#include "kinegraph/scene/scene_format.h"

namespace kinegraph {

const std::vector<SceneFormat>& sceneFormats() {
  static const std::vector<SceneFormat> formats = {{".urdf", readUrdf}};
  return formats;
}

const SceneFormat* sceneFormatOf(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  for (const SceneFormat& format : sceneFormats()) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

}  // namespace kinegraph
