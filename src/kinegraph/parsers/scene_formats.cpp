#include "kinegraph/parsers/scene_formats.h"

#include "kinegraph/common/file_paths.h"
#include "kinegraph/parsers/mjcf/mjcf_reader.h"
#include "kinegraph/parsers/urdf/urdf_reader.h"
#include "kinegraph/parsers/xml/xml.h"

namespace kinegraph::inline parsers_internal {

namespace {

/// Reads an XML text as URDF if its root is <robot>, and as MJCF otherwise.
ParseResult readXml(std::string_view text, const std::string& file, const std::string& folder) {
  return xmlRootName(text) == "robot" ? readUrdf(text, file, folder) : readMjcf(text, file, folder);
}

}  // namespace

const std::vector<SceneFormat>& sceneFormats() {
  static const std::vector<SceneFormat> formats = {{".urdf", readXml}, {".xml", readXml}, {".mjcf", readXml}};
  return formats;
}

const SceneFormat* sceneFormatOf(const std::string& file) {
  const std::string extension = lowerExtension(file);
  for (const SceneFormat& format : sceneFormats()) {
    if (extension == format.extension) return &format;
  }
  return nullptr;
}

}  // namespace kinegraph::inline parsers_internal
