#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "docs/path_lines.h"
#include "docs/roadmap.h"
#include "feature_arguments.h"
#include "kinegraph/base/text.h"
#include "kinegraph/motion/plan_picture.h"
#include "kinegraph/motion/roadmap.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

namespace lines = docs::path_lines;

/// Runs without the interpreter lock, and looks for Ctrl-C.
template <class Work>
auto watched(const Work& work) {
  const nb::gil_scoped_release unlock;
  CheckInterrupts check;
  return work([&] {
    check();
    return false;
  });
}

RoadmapAnswer findPath(Roadmap& map, const Numbers& start, const Numbers& goal) {
  return watched([&](const MotionWatch& watch) { return map.findPath(start.values, goal.values, watch); });
}

}  // namespace

void bindRoadmap(nb::module_& m) {
  nb::class_<RoadmapAnswer>(m, "RoadmapPath", "What a Roadmap answers.")
      .def_prop_ro("feasible", &RoadmapAnswer::feasible, "True if there is a path. It is free at all times.")
      .def_prop_ro(
          "path", [](const RoadmapAnswer& a) { return toNumpy(a.path); }, "Postures, shape (K, n), rad or m.")
      .def_prop_ro(
          "message", [](const RoadmapAnswer& a) { return inPython(a.message); },
          "\"\" if there is a path; else why there is none.")
      .def_ro("checked", &RoadmapAnswer::checked, "Postures and motions that had to be looked at.")
      .def("__bool__", &RoadmapAnswer::feasible)
      .def("__repr__", [](const RoadmapAnswer& a) {
        return cat("<RoadmapPath ", a.feasible() ? cat(a.path.rows(), " postures") : inPython(a.message), ">");
      });
  nb::class_<Roadmap>(m, "Roadmap", docs::roadmap::type)
      .def(
          "__init__",
          [](Roadmap* self, const PyConfig& config, double margin, std::uint64_t seed) {
            new (self) Roadmap(config, margin, seed);
          },
          "config"_a, "margin"_a = 0., "seed"_a = 0, docs::roadmap::make)
      .def(
          "grow",
          [](Roadmap& map, int postures) -> Roadmap& {
            watched([&](const MotionWatch& watch) { map.grow(postures, watch); });
            return map;
          },
          "postures"_a, kChain, docs::roadmap::grow)
      .def("findPath", findPath, "start"_a, "goal"_a, docs::roadmap::findPath)
      .def(
          "setScene", [](Roadmap& map, const PyConfig& config) { map.setScene(config); }, "config"_a,
          docs::roadmap::setScene)
      .def(
          "save", [](const Roadmap& map, const PathText& file) { map.save(file.text); }, "path"_a, docs::roadmap::save)
      .def(
          "load", [](Roadmap& map, const PathText& file) { map.load(file.text); }, "path"_a, docs::roadmap::load)
      .def(
          "picture",
          [](const Roadmap& map, const PyConfig& config, const std::optional<FrameNames>& frames) {
            return PyConfig{roadmapPicture(config, map, frames ? toNames(*frames) : std::vector<std::string>()),
                            nullptr};
          },
          "config"_a, "frames"_a = nb::none(),
          cat(docs::roadmap::picture, lines::frames, lines::returnsPicture, lines::raises).c_str())
      .def("__len__", &Roadmap::size)
      .def_prop_ro("motions", &Roadmap::motions, "How many motions between postures it has.")
      .def_prop_ro("margin", &Roadmap::margin, "m, that all collidable pairs keep.")
      .def_prop_ro(
          "postures", [](const Roadmap& map) { return toNumpy(map.postures()); }, "Shape (N, n), rad or m.")
      .def("__repr__", [](const Roadmap& map) {
        return cat("<Roadmap of ", map.size(), " postures and ", map.motions(), " motions>");
      });
}

}  // namespace kinegraph::python
