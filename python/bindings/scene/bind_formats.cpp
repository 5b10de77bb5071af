#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/exporters/writers.h"
#include "kinegraph/gfile/writer.h"
#include "scene/formats_docs.h"
#include "scene/scene_values.h"

namespace kinegraph::python {

namespace {

void emitAll(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) emitWarning(warning);
}

std::string writeG(const PyConfig& config, const std::optional<PathText>& file) {
  std::vector<std::string> warnings;
  const std::string text = file ? saveScene(config, file->text, &warnings) : writeScene(config, &warnings);
  emitAll(warnings);
  return text;
}

std::string writeURDF(const PyConfig& config, const std::optional<PathText>& file) {
  std::vector<std::string> warnings;
  const std::string text = file ? saveUrdf(config, file->text, &warnings) : writeUrdf(config, {}, &warnings);
  emitAll(warnings);
  return text;
}

std::string asSRDF(const PyConfig& config) {
  std::vector<std::string> warnings;
  const std::string text = writeSrdf(config, {}, &warnings);
  emitAll(warnings);
  return text;
}

std::string asMJCF(const PyConfig& config, bool motors) {
  std::vector<std::string> warnings;
  MjcfOptions options;
  options.motors = motors;
  const std::string text = writeMjcf(config, options, &warnings);
  emitAll(warnings);
  return text;
}

std::string writeMJCF(const PyConfig& config, const PathText& file, bool motors) {
  std::vector<std::string> warnings;
  const std::string text = saveMjcf(config, file.text, &warnings, motors);
  emitAll(warnings);
  return text;
}

std::string asYaml(const PyConfig& config, bool serial) {
  std::vector<std::string> warnings;
  const std::string text = writeYaml(config, serial, &warnings);
  emitAll(warnings);
  return text;
}

Attributes asDict(const PyConfig& config) {
  std::vector<std::string> warnings;
  const Graph graph = describeScene(config, NameRule::unique, &warnings);
  emitAll(warnings);
  return Attributes(toDict(graph));
}

/// Writes a dict's entries as lines of a `.g` file; its keys may contain parents and keywords.
std::string sceneText(const Attributes& scene) {
  std::string text;
  for (const auto& [key, value] : scene) {
    const auto name = nb::cast<std::string>(key);
    text += cat(name, ": ", write(toValue(value, name)), "\n");
  }
  return text;
}

void writeCollada(const PyConfig& config, const PathText& file, const std::string& format) {
  if (format != "collada")
    throw ValueError(cat("writeCollada: format '", format, "' is not supported; expected 'collada'"));
  saveCollada(config, file.text);
}

void bindMeshFiles(nb::class_<PyConfig>& config) {
  config
      .def(
          "writeMesh", [](const PyConfig& c, const PathText& file) { saveWorldMesh(c, file.text); }, "filename"_a,
          docs::formats::writeMesh)
      .def(
          "writeMeshes",
          [](const PyConfig& c, const std::string& prefix, bool, bool enumerate) {
            return saveMeshes(c, prefix, enumerate);
          },
          "pathPrefix"_a, "copyTextures"_a = true, "enumerateAssets"_a = false, docs::formats::writeMeshes)
      .def(
          "writeConvexStls",
          [](const PyConfig& c, const std::string& prefix, double shrink, int) {
            return saveConvexStls(c, prefix, shrink);
          },
          "pathPrefix"_a, "shrinkRadius"_a = -1., "verbose"_a = 1, docs::formats::writeConvexStls)
      .def("writeCollada", writeCollada, "filename"_a, "format"_a = "collada", docs::formats::writeCollada)
      .def(
          "writeGltf", [](const PyConfig& c, const PathText& file) { writeGltf(c, file.text); }, "filename"_a,
          docs::formats::writeGltf);
}

}  // namespace

void bindFormats(nb::class_<PyConfig>& config, nb::class_<Frame>& frame) {
  config
      .def(
          "addDict",
          [](PyConfig& c, const Attributes& scene) {
            const std::optional<Frame> first = c.addText(sceneText(scene), "dict");
            emitWarnings(c);
            return first;
          },
          "dict"_a, docs::formats::addDict)
      .def("asDict", asDict, docs::formats::asDict)
      .def("asYaml", asYaml, "serial"_a = false, docs::formats::asYaml)
      .def("write", writeG, "filename"_a = nb::none(), docs::formats::write)
      .def("writeURDF", writeURDF, "filename"_a = nb::none(), docs::formats::writeURDF)
      .def("asSRDF", asSRDF, docs::formats::asSRDF)
      .def("asMJCF", asMJCF, nb::kw_only(), "motors"_a = false, docs::formats::asMJCF)
      .def("writeMJCF", writeMJCF, "filename"_a, nb::kw_only(), "motors"_a = false, docs::formats::writeMJCF);
  frame.def(
      "asDict", [](const Frame& f) { return Attributes(toDict(describeFrame(f.data()))); },
      "Returns the frame's current state as attributes of a .g file.");
  bindMeshFiles(config);
}

}  // namespace kinegraph::python
