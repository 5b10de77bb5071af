#include <filesystem>

#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/packages.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/loading/reader.h"
#include "kinegraph/scene/tree/scene_bytes.h"
#include "scene/scene_docs.h"

namespace kinegraph::python {

Frame toFrame(const Config& config, nb::handle name_or_id, const char* who) {
  if (nb::isinstance<nb::str>(name_or_id))
    return Frame(config.scene(), config.scene()->get(nb::cast<std::string>(name_or_id), who));
  if (nb::isinstance<nb::int_>(name_or_id)) return Config(config.scene()).getFrame(nb::cast<int>(name_or_id));
  if (nb::isinstance<Frame>(name_or_id)) return nb::cast<Frame>(name_or_id);
  throw ValueError(cat("a frame is given by its name or id, not by a ",
                       nb::cast<std::string>(nb::str(name_or_id.type().attr("__name__")))));
}

namespace {

using Names = std::vector<std::string>;

template <class Result>
Result withWarnings(PyConfig& config, Result result) {
  emitWarnings(config);
  return result;
}

std::optional<Frame> getFrame(PyConfig& config, const std::string& name, bool warn) {
  return warn ? config.getFrame(name) : config.findFrame(name);
}

/// The values of xacro arguments as text: str(value), and true or false.
XacroArguments xacroArguments(const std::optional<Attributes>& given) {
  XacroArguments arguments;
  if (!given) return arguments;
  for (const auto& [name, value] : *given) {
    arguments[nb::cast<std::string>(nb::str(name))] = nb::isinstance<nb::bool_>(value)
                                                          ? (nb::cast<bool>(value) ? "true" : "false")
                                                          : nb::cast<std::string>(nb::str(value));
  }
  return arguments;
}

std::string expandInPython(const std::string& path, const XacroArguments& arguments) {
  const nb::gil_scoped_acquire lock;
  nb::dict values;
  for (const auto& [name, value] : arguments) values[name.c_str()] = value;
  return nb::cast<std::string>(nb::module_::import_("kinegraph.xacro_files").attr("expand")(path, values));
}

std::string packageFolder(const std::string& name, const std::string& folder) {
  std::string found;
  visitPackageFolders(name, folder, [&](const std::string& candidate) {
    std::error_code error;
    if (std::filesystem::is_directory(candidate, error)) found = candidate;
    return !found.empty();
  });
  return found;
}

Attributes checkFile(const PathText& file) {
  const SceneCheck check = checkSceneFile(file.text);
  Attributes result;
  result["messages"] = check.messages;
  result["errors"] = check.errors;
  result["warnings"] = check.warnings;
  result["frames"] = check.frames;
  return result;
}

Frame frameOf(const PyConfig& config, const FrameArgument& name_or_id) { return toFrame(config, name_or_id); }

void setFrameState(PyConfig& config, const Numbers& poses, const std::vector<std::string>& frames) {
  if (poses.values.size() % 7 != 0)
    throw ValueError("setFrameState: expected n x 7 numbers, one pose x y z qw qx qy qz per frame");
  const Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 7, Eigen::RowMajor>> rows(poses.values.data(),
                                                                                         poses.values.size() / 7, 7);
  config.setFrameState(rows, frames);
}

void bindEnums(nb::module_& m) {
  auto shape_types = nb::enum_<ShapeType>(m, "ST", nb::is_arithmetic(), "Shape types.");
  shape_types.value("none", ShapeType::none);
  for (const auto& [name, type] : shapeTypeNames()) shape_types.value(name.c_str(), type);
  auto joint_types = nb::enum_<JointType>(m, "JT", nb::is_arithmetic(), "Joint types.");
  for (const auto& [name, type] : jointTypeNames()) joint_types.value(name.c_str(), type);
}

/// Binds copying, pickling and the protocols of a collection of frames.
void bindProtocols(nb::class_<PyConfig>& config) {
  config.def(nb::init<>(), "An empty scene.")
      .def("__copy__",
           [](const PyConfig& c) {
             return PyConfig{Config(c), nullptr};
           })
      .def(
          "__deepcopy__",
          [](const PyConfig& c, nb::object) {
            return PyConfig{Config(c), nullptr};
          },
          "memo"_a)
      .def("__getstate__",
           [](const PyConfig& c) {
             const std::string bytes = sceneToBytes(*c.scene());
             return nb::bytes(bytes.data(), bytes.size());
           })
      .def("__setstate__",
           [](PyConfig& c, const nb::bytes& bytes) {
             new (&c) PyConfig{Config(sceneFromBytes({bytes.c_str(), bytes.size()})), nullptr};
           })
      .def("__len__", &PyConfig::getFrameDimension)
      .def("__iter__", [](PyConfig& c) { return nb::typed<nb::iterator, Frame>(nb::iter(nb::cast(c.getFrames()))); })
      .def(
          "__contains__", [](const PyConfig& c, const std::string& name) { return c.findFrame(name).has_value(); },
          "name"_a)
      .def(
          "__contains__", [](const PyConfig& c, const Frame& frame) { return frame.scene() == c.scene(); }, "frame"_a)
      .def("__repr__", [](const PyConfig& c) {
        return cat("<Config: ", c.getFrameDimension(), " frames, ", c.getJointDimension(), " dofs>");
      });
}

void bindBuilding(nb::class_<PyConfig>& config) {
  config.def("clear", &PyConfig::clear, "Removes all frames.")
      .def(
          "addFile",
          [](PyConfig& c, const PathText& file, const std::optional<std::string>& prefix, bool strict,
             const std::optional<Attributes>& xacro, bool floating, bool orphans) {
            const FileOptions options{
                .strict = strict, .xacro = xacroArguments(xacro), .floating = floating, .orphans = orphans};
            return withWarnings(c, c.addFile(file.text, prefix.value_or(""), options));
          },
          "filename"_a, "namePrefix"_a = nb::none(), nb::kw_only(), "strict"_a = false, "xacro"_a = nb::none(),
          "floating"_a = false, "orphans"_a = false, docs::scene::addFile)
      .def(
          "addText",
          [](PyConfig& c, const std::string& text, const std::string& name, bool strict) {
            return withWarnings(c, c.addText(text, name, "", strict));
          },
          "text"_a, "name"_a = "text", "strict"_a = false, docs::scene::addText)
      .def("fileWarnings", &PyConfig::fileWarnings, docs::scene::fileWarnings)
      .def(
          "addFrame",
          [](PyConfig& c, const std::string& name, const std::optional<FrameArgument>& parent,
             const std::string& args) {
            const bool root = !parent || (nb::isinstance<nb::str>(*parent) && nb::len(*parent) == 0);
            return withWarnings(
                c, root ? c.addFrame(name, "", args) : c.addFrame(name, toFrame(c, *parent, "addFrame"), args));
          },
          "name"_a, "parent"_a = "", "args"_a = "", docs::scene::addFrame)
      .def(
          "addConfigurationCopy",
          [](PyConfig& c, const PyConfig& other, const std::string& prefix, double) {
            return c.addConfigurationCopy(other, prefix);
          },
          "config"_a, "prefix"_a = "", "tau"_a = 1., docs::scene::addConfigurationCopy)
      .def(
          "copy", [](PyConfig& c, const PyConfig& other) { static_cast<Config&>(c) = other; }, "other"_a,
          docs::scene::copyFrom)
      .def(
          "copy",
          [](const PyConfig& c) {
            return PyConfig{Config(c), nullptr};
          },
          "Returns an independent copy, like copy.copy and copy.deepcopy.")
      .def(
          "delFrame", [](PyConfig& c, const FrameArgument& f) { c.delFrame(toFrame(c, f, "delFrame")); }, "frame"_a,
          docs::scene::delFrame)
      .def(
          "attach", [](PyConfig& c, const std::string& parent, const std::string& child) { c.attach(parent, child); },
          "frame1"_a, "frame2"_a, docs::scene::attach);
}

void bindFrameAccess(nb::class_<PyConfig>& config) {
  config

      .def("getFrame", getFrame, "frameName"_a, "warnIfNotExist"_a = true,
           nb::sig("def getFrame(self, frameName: str, warnIfNotExist: bool = True) -> Frame"), docs::scene::getFrame)
      .def("__getitem__", frameOf, "frame"_a, docs::scene::frame)
      .def(
          "getFrames", [](PyConfig& c) { return c.getFrames(); }, "Returns all frames, in order.")
      .def(
          "getRoots", [](PyConfig& c) { return c.getRoots(); }, "Returns the frames without a parent.")
      .def("getFrameNames", &PyConfig::getFrameNames, "Returns the names of all frames, in order.")
      .def("getFrameDimension", &PyConfig::getFrameDimension, "Returns the number of frames.")
      .def(
          "getFrameState", [](const PyConfig& c) { return toNumpy(c.getFrameState()); },
          "Returns the world poses of all frames, shape (frames, 7): x y z (m) qw qx qy qz with qw >= 0.")
      .def("setFrameState", setFrameState, "X"_a, "frames"_a = Names(), docs::scene::setFrameState)
      .def("report", &PyConfig::report,
           "Describes the scene: numbers of frames, joints, dofs and shapes, the colliding shapes, and "
           "contactWarnings().");
}

}  // namespace

void bindScene(nb::module_& m) {
  bindEnums(m);
  setXacroExpander(expandInPython);
  m.def("_packageFolder", packageFolder, "name"_a, "folder"_a,
        "Returns the folder of a ROS package, searched as in Config.addFile, or an empty text.");
  m.def("checkFile", checkFile, "filename"_a, docs::scene::checkFile);
  nb::class_<Frame> frame(m, "Frame",
                          "A handle on one frame of a Config. Setters return the frame, so calls can be chained.");
  nb::class_<PyConfig> config(m, "Config", "A scene: named frames with joints and shapes, and the joint vector q.");
  bindProtocols(config);
  bindBuilding(config);
  bindFrameAccess(config);
  bindJoints(config);
  bindCollisions(m, config);
  bindFrame(frame);
  bindStructure(config);
  bindFeatures(m, config);
  bindBatch(config);
  bindDynamics(config);
  bindCompatibility(config);
  bindFormats(config, frame);
  bindViewer(m, config);
}

}  // namespace kinegraph::python
