#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/formats/gltf_writer.h"
#include "kinegraph/formats/mjcf_writer.h"
#include "kinegraph/formats/scene_writer.h"
#include "kinegraph/formats/urdf_writer.h"
#include "kinegraph/gfile/writer.h"
#include "scene_values.h"

namespace kinegraph::python {

namespace {

void emitAll(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) emitWarning(warning);
}

std::string pathText(nb::handle path) { return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(path)); }

std::string writeG(const PyConfig& config, nb::handle file) {
  std::vector<std::string> warnings;
  const std::string text =
      file.is_none() ? writeScene(config, &warnings) : saveScene(config, pathText(file), &warnings);
  emitAll(warnings);
  return text;
}

std::string writeURDF(const PyConfig& config, nb::handle file) {
  std::vector<std::string> warnings;
  const std::string text =
      file.is_none() ? writeUrdf(config, {}, &warnings) : saveUrdf(config, pathText(file), &warnings);
  emitAll(warnings);
  return text;
}

std::string asMJCF(const PyConfig& config) {
  std::vector<std::string> warnings;
  const std::string text = writeMjcf(config, {}, &warnings);
  emitAll(warnings);
  return text;
}

std::string writeMJCF(const PyConfig& config, nb::handle file) {
  std::vector<std::string> warnings;
  const std::string text = saveMjcf(config, pathText(file), &warnings);
  emitAll(warnings);
  return text;
}

std::string asYaml(const PyConfig& config, bool serial) {
  std::vector<std::string> warnings;
  const std::string text = writeYaml(config, serial, &warnings);
  emitAll(warnings);
  return text;
}

nb::dict asDict(const PyConfig& config) {
  std::vector<std::string> warnings;
  const Graph graph = describeScene(config, NameRule::unique, &warnings);
  emitAll(warnings);
  return toDict(graph);
}

/// A dict's entries as the lines of a `.g` file: its keys may hold parents and keywords, as a file's do.
std::string sceneText(nb::dict scene) {
  std::string text;
  for (const auto& [key, value] : scene) {
    const auto name = nb::cast<std::string>(key);
    text += cat(name, ": ", write(toValue(value, name)), "\n");
  }
  return text;
}

}  // namespace

void bindFormats(nb::module_&, nb::class_<PyConfig>& config, nb::class_<Frame>& frame) {
  config
      .def(
          "addDict",
          [](PyConfig& c, nb::dict scene) {
            const std::optional<Frame> first = c.addText(sceneText(scene), "dict");
            emitWarnings(c);
            return first;
          },
          "dict"_a,
          "Adds frames given as {'name (parent)': {attribute: value, ...}, ...}, as in a .g file. Returns the first, "
          "or None.")
      .def("asDict", asDict,
           "The scene as {'name(parent)': {attribute: value, ...}, ...}, in the order of the frames; addDict reads it.")
      .def("asYaml", asYaml, "serial"_a = false, "The scene as text that is YAML and .g at once; serial: on one line.")
      .def("write", writeG, "filename"_a = nb::none(),
           "The scene as .g text, numbers exact. With a filename it is written there: as URDF for .urdf, as MJCF for "
           ".xml, as YAML\n"
           "for .yml and .yaml, else as .g. Returns the text.")
      .def("writeURDF", writeURDF, "filename"_a = nb::none(),
           "The scene as URDF text. With a filename it is written there, and shapes that URDF has no element for go "
           "into .stl\n"
           "files in a folder beside it; without one they are left out with a warning.")
      .def("asMJCF", asMJCF,
           "The scene as MJCF text, which MuJoCo loads with the same poses; meshes stand in the text.")
      .def("writeMJCF", writeMJCF, "filename"_a,
           "Writes the scene as MJCF, which MuJoCo loads with the same poses: bodies, joints, geoms and sites have the "
           "names of\n"
           "their frames. Meshes that MuJoCo cannot read as they are go into a folder beside it. Returns the text.")
      .def(
          "writeGltf", [](const PyConfig& c, nb::handle file) { writeGltf(c, pathText(file)); }, "filename"_a,
          "Writes the scene, as it stands, as binary glTF (.glb): a node per frame with the surface that is shown for "
          "it, in its\n"
          "colors, y up as glTF has it.");

  frame
      .def(
          "asDict", [](const Frame& f) { return toDict(describeFrame(f.data())); },
          "What the frame is now, as attributes of a .g file.")
      .def(
          "info", [](const Frame& f) { return toDict(describeFrame(f.data())); }, "The same as asDict.");
}

}  // namespace kinegraph::python
