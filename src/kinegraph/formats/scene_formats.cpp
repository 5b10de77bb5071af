#include <algorithm>
#include <cctype>
#include <filesystem>

#include "kinegraph/formats/mjcf_reader.h"
#include "kinegraph/formats/urdf_reader.h"
#include "kinegraph/formats/xml.h"
#include "kinegraph/scene/scene_format.h"

namespace kinegraph {

namespace {

/// A .xml is URDF if its root says so, and otherwise MJCF.
ParseResult readXml(std::string_view text, const std::string& file, const std::string& folder) {
  return xmlRootName(text) == "robot" ? readUrdf(text, file, folder) : readMjcf(text, file, folder);
}

}  // namespace

const std::vector<SceneFormat>& sceneFormats() {
  static const std::vector<SceneFormat> formats = {{".urdf", readUrdf}, {".xml", readXml}};
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
