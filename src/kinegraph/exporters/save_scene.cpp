#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/file_paths.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"

namespace kinegraph {

namespace fs = std::filesystem;

namespace {

void writeText(const std::string& text, const std::string& path) {
  std::ofstream stream(path, std::ios::binary);
  stream << text;
  stream.flush();
  if (!stream) throw FileError(cat("scene file '", path, "' cannot be written"));
}

}  // namespace

std::string saveUrdf(const Config& config, const std::string& path, std::vector<std::string>* warnings) {
  UrdfOptions options;
  options.robot_name = fs::path(path).stem().string();
  options.mesh_folder = (fs::path(path).parent_path() / (options.robot_name + "_meshes")).string();
  const std::string semantics = writeSrdf(config, options, warnings);
  std::vector<std::string> of_text;
  const std::string text = writeUrdf(config, options, &of_text);
  if (!semantics.empty()) of_text.pop_back();  // the SRDF file settles the last warning
  if (warnings) warnings->insert(warnings->end(), of_text.begin(), of_text.end());
  writeText(text, path);
  const std::string beside = fs::path(path).replace_extension(".srdf").string();
  std::error_code ignored;
  fs::remove(beside, ignored);  // removes the semantics of an earlier scene of that name
  if (!semantics.empty()) writeText(semantics, beside);
  return text;
}

std::string saveMjcf(const Config& config, const std::string& path, std::vector<std::string>* warnings, bool motors) {
  MjcfOptions options;
  options.motors = motors;
  options.model_name = fs::path(path).stem().string();
  options.mesh_folder = (fs::path(path).parent_path() / (options.model_name + "_meshes")).string();
  const std::string text = writeMjcf(config, options, warnings);
  writeText(text, path);
  return text;
}

std::string saveScene(const Config& config, const std::string& path, std::vector<std::string>* warnings) {
  const std::string extension = lowerExtension(path);
  if (extension == ".urdf") return saveUrdf(config, path, warnings);
  if (extension == ".xml") return saveMjcf(config, path, warnings);
  const bool yaml = extension == ".yml" || extension == ".yaml";
  if (!yaml && extension != ".g") {
    const bool is_gltf = extension == ".glb" || extension == ".gltf";
    throw ValueError(cat("write: the suffix of '", path, "' is ",
                         extension.empty() ? "missing" : cat("'", extension, "'"),
                         "; expected .g, .yml, .yaml, .urdf or .xml (MJCF)",
                         is_gltf                                      ? "; writeGltf writes glTF"
                         : extension == ".dae"                        ? "; writeCollada writes COLLADA"
                         : extension == ".srdf"                       ? "; .urdf writes the SRDF file beside it"
                         : extension == ".json"                       ? "; json.dumps(C.asDict()) gives JSON"
                         : extension == ".ply" || extension == ".stl" ? "; writeMesh writes surfaces"
                         : extension.starts_with(".usd")              ? "; USD is not supported"
                                                                      : ""));
  }
  const std::string text = yaml ? writeYaml(config, false, warnings) : writeScene(config, warnings);
  writeText(text, path);
  return text;
}

}  // namespace kinegraph
