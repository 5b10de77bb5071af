#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "bindings.h"
#include "defaults.h"
#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"
#include "kinegraph/geometry/shapes/shape_types.h"
#include "kinegraph/scene/reader.h"
#include "kinegraph/scene/scene_bytes.h"
#include "scene_values.h"

namespace kinegraph::python {

Frame toFrame(const Config& config, nb::handle name_or_id) {
  if (nb::isinstance<nb::str>(name_or_id)) return config.getFrame(nb::cast<std::string>(name_or_id));
  if (nb::isinstance<nb::int_>(name_or_id)) return config.getFrame(nb::cast<int>(name_or_id));
  if (nb::isinstance<Frame>(name_or_id)) return nb::cast<Frame>(name_or_id);
  throw ValueError(cat("a frame is given by its name or id, not by a ",
                       nb::cast<std::string>(nb::str(name_or_id.type().attr("__name__")))));
}

namespace {

std::string pathText(nb::handle path) { return nb::cast<std::string>(nb::module_::import_("os").attr("fspath")(path)); }

template <class Result>
Result withWarnings(PyConfig& config, Result result) {
  emitWarnings(config);
  return result;
}

std::optional<Frame> getFrame(const PyConfig& config, const std::string& name, bool warn) {
  return warn ? config.getFrame(name) : config.findFrame(name);
}

nb::typed<nb::dict, nb::str, nb::any> checkFile(nb::handle file) {
  const SceneCheck check = checkSceneFile(pathText(file));
  nb::dict result;
  result["messages"] = check.messages;
  result["errors"] = check.errors;
  result["warnings"] = check.warnings;
  result["frames"] = check.frames;
  return result;
}

Frame frameOf(const PyConfig& config, nb::handle name_or_id) { return toFrame(config, name_or_id); }

/// A MotionContact with names.
struct Contact {
  double time, distance;
  std::pair<std::string, std::string> frames;
};

nb::typed<nb::list, nb::str> pairList(const PyConfig& config) {
  nb::list names;
  for (const auto& [a, b] : config.getCollidablePairs()) {
    names.append(config.getFrame(a).getName());
    names.append(config.getFrame(b).getName());
  }
  return names;
}

nb::typed<nb::list, nb::typed<nb::tuple, nb::str, nb::str, nb::float_>> collisions(const PyConfig& config,
                                                                                   double margin) {
  nb::list near;
  for (const Config::NearPair& pair : config.getCollisions(margin)) {
    near.append(nb::make_tuple(config.getFrame(pair.a).getName(), config.getFrame(pair.b).getName(), pair.distance));
  }
  return near;
}

nb::object checkMotion(const PyConfig& config, const Numbers& start, const Numbers& end, double margin,
                       double tolerance) {
  const std::optional<MotionContact> contact = config.checkMotion(start.values, end.values, margin, tolerance);
  if (!contact) return nb::none();
  return nb::cast(Contact{contact->time,
                          contact->distance,
                          {config.getFrame(contact->a).getName(), config.getFrame(contact->b).getName()}});
}

void setJointState(PyConfig& config, const NumbersView& q, const std::optional<std::vector<std::string>>& joints) {
  if (q.rank == 0 && config.getJointDimension() != 1) {
    throw ValueError(
        cat("setJointState: got a single number; the configuration has ", config.getJointDimension(), " dofs"));
  }
  config.joints = q.values;
  joints && !joints->empty() ? config.setJointState(config.joints, *joints) : config.setJointState(config.joints);
}

void setFrameState(PyConfig& config, const Numbers& poses, const std::vector<std::string>& frames) {
  if (poses.values.size() % 7 != 0)
    throw ValueError("setFrameState: expected n x 7 numbers, a row x y z qw qx qy qz per frame");
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

}  // namespace

void bindScene(nb::module_& m) {
  bindEnums(m);
  m.def("checkFile", checkFile, "filename"_a,
        "All that is wrong or odd about a scene file. Returns a dict: messages (list of str, with file:line:column, "
        "the line and\n"
        "a caret), and the numbers of errors, warnings and frames. Raises FileError if the file cannot be read.");
  nb::class_<Frame> frame(m, "Frame",
                          "A handle on one frame of a Config. Setters return it, so that calls can be chained.");
  nb::class_<Contact>(m, "MotionContact", "Where a motion of q first brings two frames too near.")
      .def_ro("time", &Contact::time, "In [0, 1]: 0 is the start of the motion, 1 its end. Until then it is free.")
      .def_ro("distance", &Contact::distance, "Of the two at that time, m; negative: penetration depth.")
      .def_ro("frames", &Contact::frames, "Their names.")
      .def("__repr__", [](const Contact& c) {
        return cat("<MotionContact: ", c.frames.first, " and ", c.frames.second, " at time ", c.time, ", distance ",
                   c.distance, ">");
      });
  nb::class_<PyConfig> config(m, "Config", "A scene: named frames with joints and shapes, and the joint vector q.");
  using Names = std::vector<std::string>;

  config.def(nb::init<>(), "An empty configuration.")
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
      .def("__iter__",
           [](const PyConfig& c) { return nb::typed<nb::iterator, Frame>(nb::iter(nb::cast(c.getFrames()))); })
      .def(
          "__contains__", [](const PyConfig& c, const std::string& name) { return c.findFrame(name).has_value(); },
          "name"_a)
      .def(
          "__contains__", [](const PyConfig& c, const Frame& frame) { return frame.scene() == c.scene(); }, "frame"_a)
      .def("__repr__",
           [](const PyConfig& c) {
             return cat("<Config: ", c.getFrameDimension(), " frames, ", c.getJointDimension(), " dofs>");
           })
      .def("clear", &PyConfig::clear, "Removes all frames.")
      .def(
          "addFile",
          [](PyConfig& c, nb::handle file, const std::optional<std::string>& prefix) {
            return withWarnings(c, c.addFile(pathText(file), prefix.value_or("")));
          },
          "filename"_a, "namePrefix"_a = nb::none(),
          "Adds the frames of a scene file (.g, .yml, .urdf, MuJoCo's .xml), names prefixed. Returns the first of "
          "them, or None.\n"
          "What an .srdf file says (named states, groups, pairs that never collide) is entered into the robot's "
          "frames, which are\n"
          "there already; one beside a .urdf file is read with it.\n"
          "An error (FileError, ParseError with file:line:column) leaves the configuration as it was.")
      .def(
          "addText",
          [](PyConfig& c, const std::string& text, const std::string& name) {
            return withWarnings(c, c.addText(text, name));
          },
          "text"_a, "name"_a = "text", "Adds the frames of a scene given as text.")
      .def(
          "addFrame",
          [](PyConfig& c, const std::string& name, nb::handle parent, const std::string& args) {
            const bool root = parent.is_none() || (nb::isinstance<nb::str>(parent) && nb::len(parent) == 0);
            return withWarnings(c, root ? c.addFrame(name, "", args) : c.addFrame(name, toFrame(c, parent), args));
          },
          "name"_a, "parent"_a = "", "args"_a = "",
          "Appends a frame at its parent's pose (or the world's origin). args: attributes as in a .g file. A name that "
          "exists gives\n"
          "that frame as it is, with a warning; asking for another parent or other attributes than it was made with is "
          "an error.")
      .def(
          "addConfigurationCopy",
          [](PyConfig& c, const PyConfig& other, const std::string& prefix, double) {
            return c.addConfigurationCopy(other, prefix);
          },
          "config"_a, "prefix"_a = "", "tau"_a = 1., "Appends copies of all frames of another configuration.")
      .def(
          "copy", [](PyConfig& c, const PyConfig& other) { static_cast<Config&>(c) = other; }, "other"_a,
          "Becomes a copy of another configuration.")
      .def(
          "copy",
          [](const PyConfig& c) {
            return PyConfig{Config(c), nullptr};
          },
          "A copy that shares nothing that can be changed, like copy.copy and copy.deepcopy.")
      .def(
          "delFrame", [](PyConfig& c, nb::handle f) { c.delFrame(toFrame(c, f)); }, "frame"_a,
          "Removes a frame; its children stay where they are, as roots.")
      .def(
          "attach", [](PyConfig& c, const std::string& parent, const std::string& child) { c.attach(parent, child); },
          "frame1"_a, "frame2"_a, "Cuts the link of frame2 off and attaches it, where it is, rigidly below frame1.")

      .def("getFrame", getFrame, "frameName"_a, "warnIfNotExist"_a = true,
           nb::sig("def getFrame(self, frameName: str, warnIfNotExist: bool = True) -> Frame"),  // None only where a
                                                                                                 // script asks for it
           "The first frame of that name. Unknown: FrameNotFound, or None with warnIfNotExist=False.")
      .def("frame", frameOf, "frame"_a, "The frame of that name or id.")
      .def("__getitem__", frameOf, "frame"_a, "The frame of that name or id.")
      .def("getFrames", &PyConfig::getFrames, "All frames, in order.")
      .def("frames", &PyConfig::getFrames, "All frames, in order.")
      .def("getRoots", &PyConfig::getRoots, "Frames without a parent.")
      .def("getJoints", &PyConfig::getJoints, "Frames whose joint is active and has dofs.")
      .def("getFrameNames", &PyConfig::getFrameNames, "Names of all frames, in order.")
      .def("getFrameDimension", &PyConfig::getFrameDimension, "Number of frames.")
      .def(
          "getFrameState", [](const PyConfig& c) { return toNumpy(c.getFrameState()); },
          "World poses of all frames: (n, 7), rows x y z (m) qw qx qy qz with qw >= 0.")
      .def("setFrameState", setFrameState, "X"_a, "frames"_a = Names(),
           "Sets the world poses of all, or of the named, frames.")

      .def("getJointDimension", &PyConfig::getJointDimension, "Length of q.")
      .def(
          "getJointState",
          [](const PyConfig& c, const std::optional<Names>& names) {
            return toNumpy(names ? c.getJointState(*names) : c.getJointState());
          },
          "joints"_a = nb::none(), "q (rad, m): (n,), a copy. Or the dofs of the named frames.")
      .def("setJointState", setJointState, "q"_a, "joints"_a = nb::none(),
           "Sets q (rad, m), or the dofs of the named frames, in that order.")
      .def(
          "setRandom", [](PyConfig& c, int, int) { c.setRandom(defaults().random); }, "timeSlices_d1"_a = 0,
          "verbose"_a = 0,
          "Draws q: per joint near its home with sampleSdv, or uniform within its limits with probability "
          "sampleUniform.\n"
          "ry.rnd_seed seeds it.")
      .def("getJointNames", &PyConfig::getJointNames, "One name per entry of q.")
      .def("getJointIDs", &PyConfig::getJointIDs, "Ids of the frames with active joints.")
      .def("getDofIDs", &PyConfig::getJointIDs, "The same as getJointIDs.")
      .def(
          "getStateNames",
          [](const PyConfig& c, const std::optional<std::string>& group) {
            return c.getStateNames(group.value_or(""));
          },
          "group"_a = nb::none(),
          "Names of joint states that the scene knows (SRDF, attribute joint_states), or of those of a group.")
      .def(
          "getNamedState",
          [](const PyConfig& c, const std::string& name, const std::optional<std::string>& group) {
            return toNumpy(c.getNamedState(name, group.value_or("")));
          },
          "name"_a, "group"_a = nb::none(),
          "The present q, shape (n,), with the values of a named state (rad, m): "
          "C.setJointState(C.getNamedState('home')).\n"
          "Joints that the state does not name keep theirs. Without a group, the states of that name of all groups "
          "together.\n"
          "Raises NameError for a name that is not there.")
      .def(
          "getJointGroups",
          [](const PyConfig& c) {
            nb::typed<nb::dict, nb::str, Names> groups;
            for (const auto& [name, joints] : c.getJointGroups()) groups[nb::cast(name)] = nb::cast(joints);
            return groups;
          },
          "Groups of joints (SRDF, attribute joint_groups): {name: names of the joints' frames}, for selectJoints.")
      .def(
          "getJointLimits", [](const PyConfig& c) { return toNumpy(c.getJointLimits()); },
          "(2, n): lower and upper limits; 0 and -1 for a dof without limits.")
      .def(
          "selectJoints", [](PyConfig& c, const Names& names, bool not_those) { c.selectJoints(names, not_those); },
          "jointNames"_a, "notThose"_a = false,
          "Makes the joints at or above the named frames the active ones (or all others).")
      .def("getCollidablePairs", pairList, "Names of the frames that may collide: a1 b1 a2 b2 ...")
      .def("getCollisions", collisions, "belowMargin"_a = 0.,
           "All collidable pairs nearer than the margin: (name, name, distance in m); negative: penetration.")
      .def(
          "coll_totalViolation", [](const PyConfig& c, bool maximal) { return c.getTotalPenetration(maximal); },
          "return_maximal"_a = false, "Sum of all penetration depths (m), or the largest.")
      .def(
          "getCollisionsTotalPenetration", [](const PyConfig& c) { return c.getTotalPenetration(); },
          "The same as coll_totalViolation().")
      .def(
          "computeCollisions", [](const PyConfig& c) { c.state(); },
          "Kept for older scripts: collisions are always computed for the present state.")
      .def("checkMotion", checkMotion, "start"_a, "end"_a, "margin"_a = 0., "tolerance"_a = 1e-4,
           "The first MotionContact on the straight motion of q from start (n,) to end (n,), or None where all "
           "collidable pairs keep\n"
           "margin (m) apart: at all times of the motion, not just at samples of it. A pair that comes within margin + "
           "tolerance may\n"
           "be reported as a contact.")
      .def("report", &PyConfig::report, "A line about the configuration.");

  bindFrame(m, frame);
  bindStructure(config);
  bindFeatures(m, config);
  bindBatch(config);
  bindDynamics(config);
  bindFormats(m, config, frame);
  bindViewer(m, config);
}

}  // namespace kinegraph::python
