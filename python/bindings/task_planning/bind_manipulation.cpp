#include <nanobind/stl/optional.h>
#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/komo/path/path.h"
#include "task_planning/bind_tasks.h"
#include "task_planning/manipulation_docs.h"
#include "task_planning/py_manipulation.h"

namespace kinegraph::python {

namespace {

using M = PyManipulation;
using Name = const FrameName&;
using Text = const std::string&;
using Palm = const std::optional<FrameName>&;

/// Passes on what had no effect.
void warn(M& m) {
  for (const std::string& warning : m.komo->takeWarnings()) emitWarning(warning);
}

std::vector<std::string> namesOf(const std::vector<FrameName>& frames) {
  std::vector<std::string> names;
  for (const FrameName& frame : frames) names.push_back(frame.name);
  return names;
}

std::string nameOf(Palm palm) { return palm ? palm->name : std::string(); }

Vector3d vector3(const Numbers& numbers, const char* what) {
  if (numbers.values.size() == 3) return numbers.values;
  throw ValueError(cat(what, " has ", numbers.values.size(), " numbers; expected 3"));
}

void bindSetups(nb::class_<M>& helper) {
  helper
      .def(
          "setup_inverse_kinematics",
          [](M& m, const PyConfig& C, double homing, bool collisions, bool limits, bool norms) {
            m.setup_inverse_kinematics(C, homing, {collisions, limits, norms});
          },
          "C"_a, "homing_scale"_a = 1e-1, "accumulated_collisions"_a = true, "joint_limits"_a = true,
          "quaternion_norms"_a = true, docs::manipulation::setup_inverse_kinematics)
      .def(
          "setup_sequence",
          [](M& m, const PyConfig& C, double K, double homing, double velocity, bool collisions, bool limits,
             bool norms) {
            m.setup_sequence(C, K, homing, velocity, {collisions, limits, norms});
          },
          "C"_a, "K"_a, "homing_scale"_a = 1e-2, "velocity_scale"_a = 1e-1, "accumulated_collisions"_a = true,
          "joint_limits"_a = true, "quaternion_norms"_a = true, docs::manipulation::setup_sequence)
      .def(
          "setup_motion",
          [](M& m, const PyConfig& C, double K, int steps, double homing, double acceleration, bool collisions,
             bool limits, bool norms) {
            m.setup_motion(C, K, steps, homing, acceleration, {collisions, limits, norms});
          },
          "C"_a, "K"_a, "steps_per_phase"_a, "homing_scale"_a = 0., "acceleration_scale"_a = 1e-1,
          "accumulated_collisions"_a = true, "joint_limits"_a = true, "quaternion_norms"_a = true,
          docs::manipulation::setup_motion)
      .def(
          "setup_pick_and_place_waypoints",
          [](M& m, const PyConfig& C, Name gripper, Name obj, double homing, double velocity, bool collisions,
             bool limits, bool norms) {
            m.setup_pick_and_place_waypoints(C, gripper, obj, homing, velocity, {collisions, limits, norms});
            warn(m);
          },
          "C"_a, "gripper"_a, "obj"_a, "homing_scale"_a = 1e-2, "velocity_scale"_a = 1e-1,
          "accumulated_collisions"_a = true, "joint_limits"_a = true, "quaternion_norms"_a = false,
          docs::manipulation::setup_pick_and_place_waypoints)
      .def(
          "setup_point_to_point_motion",
          [](M& m, const PyConfig& C, const Numbers& q1, double homing, double acceleration, bool collisions,
             bool limits, bool norms) {
            m.setup_point_to_point_motion(C, q1.values, homing, acceleration, {collisions, limits, norms});
          },
          "C"_a, "q1"_a, "homing_scale"_a = 1e-2, "acceleration_scale"_a = 1e-1, "accumulated_collisions"_a = true,
          "joint_limits"_a = true, "quaternion_norms"_a = false, docs::manipulation::setup_point_to_point_motion);
}

void bindGrasps(nb::class_<M>& helper) {
  helper
      .def(
          "add_stable_frame",
          [](M& m, JointType type, Name parent, Text name, const std::optional<FrameName>& init, double) {
            m.add_stable_frame(type, parent, name, init ? init->name : "");
          },
          "jointType"_a, "parent"_a, "name"_a, "initFrame"_a = nb::none(), "markerSize"_a = -1.,
          docs::manipulation::add_stable_frame)
      .def(
          "add_place_frame",
          [](M& m, Name parent, Name obj, Text name) {
            m.add_place_frame(parent, obj, name);
            warn(m);
          },
          "parent"_a, "obj"_a, "name"_a, docs::manipulation::add_place_frame)
      .def(
          "snap_switch",
          [](M& m, double time, Name parent, Name obj) {
            m.snap_switch(time, parent, obj);
            warn(m);
          },
          "time"_a, "parent"_a, "obj"_a, docs::manipulation::snap_switch)
      .def(
          "grasp_top_box",
          [](M& m, double time, Name gripper, Name obj, Text direction) {
            m.grasp_top_box(time, gripper, obj, direction);
            warn(m);
          },
          "time"_a, "gripper"_a, "obj"_a, "grasp_direction"_a = "xz", docs::manipulation::grasp_top_box)
      .def(
          "grasp_box",
          [](M& m, double time, Name gripper, Name obj, Palm palm, Text direction, double margin) {
            m.grasp_box(time, gripper, obj, nameOf(palm), direction, margin);
            warn(m);
          },
          "time"_a, "gripper"_a, "obj"_a, "palm"_a.none(), "grasp_direction"_a = "x", "margin"_a = .02,
          docs::manipulation::grasp_box)
      .def(
          "grasp_cylinder",
          [](M& m, double time, Name gripper, Name obj, Palm palm, double margin) {
            m.grasp_cylinder(time, gripper, obj, nameOf(palm), margin);
            warn(m);
          },
          "time"_a, "gripper"_a, "obj"_a, "palm"_a.none(), "margin"_a = .02, docs::manipulation::grasp_cylinder)
      .def(
          "place_box",
          [](M& m, double time, Name obj, Name table, Palm palm, Text direction, double margin) {
            m.place_box(time, obj, table, nameOf(palm), direction, margin);
            warn(m);
          },
          "time"_a, "obj"_a, "table"_a, "palm"_a.none(), "place_direction"_a = "z", "margin"_a = .02,
          docs::manipulation::place_box);
}

void bindMotions(nb::class_<M>& helper) {
  const auto moving = [&](const char* name, auto call, const char* text) {
    helper.def(
        name,
        [call](M& m, const Numbers& times, Name gripper, double dist) {
          (m.*call)(times.list(), gripper, dist);
          warn(m);
        },
        "time_interval"_a, "gripper"_a, "dist"_a = .03, text);
  };
  using H = ManipulationHelper;
  moving("retract", &H::retract, docs::manipulation::retract);
  moving("approach", &H::approach, docs::manipulation::approach);
  moving("retractPush", &H::retractPush, docs::manipulation::retractPush);
  moving("approachPush", &H::approachPush, docs::manipulation::approachPush);
  helper
      .def(
          "straight_push",
          [](M& m, const Numbers& times, Name obj, Name gripper, Name table, double scale, Text frame) {
            const std::string helper = m.straight_push(times.list(), obj, gripper, table, scale, frame);
            warn(m);
            return helper;
          },
          "time_interval"_a, "obj"_a, "gripper"_a, "table"_a, "scale"_a = 1e1, "helper"_a = "",
          docs::manipulation::straight_push)
      .def(
          "pull",
          [](M& m, const Numbers& times, Name obj, Name gripper, Name table) {
            m.pull(times.list(), obj, gripper, table);
            warn(m);
          },
          "times"_a, "obj"_a, "gripper"_a, "table"_a, docs::manipulation::pull);
}

void bindConditions(nb::class_<M>& helper) {
  helper
      .def(
          "no_collisions",
          [](M& m, const Numbers& times, const std::vector<FrameName>& pairs, double margin, double scale) {
            m.no_collisions(times.list(), namesOf(pairs), margin, scale);
            warn(m);
          },
          "time_interval"_a, "objs"_a, "margin"_a = .001, "scale"_a = 1e1, docs::manipulation::no_collisions)
      .def(
          "freeze_joint",
          [](M& m, const Numbers& times, const std::vector<FrameName>& joints) {
            m.freeze_joint(times.list(), namesOf(joints));
            warn(m);
          },
          "time_interval"_a, "joints"_a, docs::manipulation::freeze_joint)
      .def(
          "freeze_relativePose",
          [](M& m, const Numbers& times, Name to, Name from) {
            m.freeze_relativePose(times.list(), to, from);
            warn(m);
          },
          "time_interval"_a, "obj"_a, "relFrom"_a, docs::manipulation::freeze_relativePose)
      .def(
          "target_position",
          [](M& m, double time, Name obj, const Numbers& at) {
            m.target_position(time, obj, vector3(at, "target_position: pos"));
          },
          "time"_a, "obj"_a, "pos"_a, docs::manipulation::target_position)
      .def(
          "target_relative_xy_position",
          [](M& m, double time, Name obj, Name to, const Numbers& at) {
            m.target_relative_xy_position(time, obj, to, at.values);
          },
          "time"_a, "obj"_a, "relativeTo"_a, "pos"_a, docs::manipulation::target_relative_xy_position)
      .def(
          "target_x_orientation",
          [](M& m, double time, Name obj, const Numbers& x) {
            m.target_x_orientation(time, obj, vector3(x, "target_x_orientation: x_vector"));
          },
          "time"_a, "obj"_a, "x_vector"_a, docs::manipulation::target_x_orientation)
      .def(
          "bias", [](M& m, double time, const Numbers& q, double scale) { m.bias(time, q.values, scale); }, "time"_a,
          "qBias"_a, "scale"_a = 1., docs::manipulation::bias);
}

}  // namespace

void bindManipulation(nb::module_& m) {
  nb::class_<M> helper(
      m, "ManipulationHelper", nb::dynamic_attr(),
      "Builds manipulation problems in a few calls; KOMO_ManipulationHelper also solves and shows them. Frames are "
      "given by name or as a Frame.");
  helper.def(nb::init<>(), "Without a problem; call one of the setups.")
      .def_prop_rw(
          "komo", &M::pyKomo, [](M& self, std::shared_ptr<PyKomo> komo) { self.komo = std::move(komo); },
          nb::for_setter(nb::arg("komo").none()), "The KOMO; None before a setup.")
      .def_prop_ro(
          "x", [](const M& m) { return toNumpy(m.komo ? m.komo->path().variables() : VectorXd()); },
          "The variables of the problem at its current path, those of stable frames first, shape (d,).");
  bindSetups(helper);
  bindGrasps(helper);
  bindMotions(helper);
  bindConditions(helper);
}

}  // namespace kinegraph::python
