#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include <sstream>

#include "arguments.h"
#include "bindings.h"
#include "features/feature_arguments.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/roadmap.h"
#include "pickling.h"
#include "planning/path_lines_docs.h"
#include "planning/roadmap_docs.h"
#include "python_names.h"
#include "viewer/notebook_page.h"

namespace kinegraph::python {

namespace {

namespace lines = docs::path_lines;

/// A roadmap with a copy of its scene.
struct PyRoadmap : Roadmap {
  PyRoadmap(std::shared_ptr<const Config> scene, double margin, std::uint64_t seed)
      : Roadmap(*scene, margin, seed), config(std::move(scene)) {}
  std::shared_ptr<const Config> config;
};

/// Runs without the interpreter lock; Ctrl-C interrupts.
template <class Work>
auto watched(const Work& work) {
  const nb::gil_scoped_release unlock;
  return work(CheckInterrupts());
}

RoadmapPath findPath(PyRoadmap& map, const Numbers& start, const Numbers& goal) {
  return watched(
      [&](const CancellationToken& cancellation) { return map.findPath(start.values, goal.values, cancellation); });
}

nb::tuple mapState(const PyRoadmap& map) {
  std::ostringstream out(std::ios::binary);
  map.save(out);
  const std::string bytes = out.str();
  return nb::make_tuple(PyConfig{Config(*map.config), nullptr}, map.margin(), nb::bytes(bytes.data(), bytes.size()));
}

void setMapState(PyRoadmap& map, const nb::tuple& state) {
  PyRoadmap made(std::make_shared<const Config>(nb::cast<const PyConfig&>(state[0])), nb::cast<double>(state[1]), 0);
  const auto bytes = nb::cast<nb::bytes>(state[2]);
  std::istringstream in(std::string(bytes.c_str(), bytes.size()), std::ios::binary);
  made.load(in, "Roadmap");
  new (&map) PyRoadmap(std::move(made));
}

}  // namespace

void bindRoadmap(nb::module_& m) {
  nb::class_<RoadmapPath>(m, "RoadmapPath", "The answer of Roadmap.findPath.")
      .def_prop_ro("feasible", &RoadmapPath::feasible, "True if there is a path; it is continuously collision-free.")
      .def_prop_ro(
          "path", [](const RoadmapPath& a) { return toNumpy(a.path); }, "Configurations, shape (K, n), rad or m.")
      .def_prop_ro(
          "message", [](const RoadmapPath& a) { return inPython(a.message); },
          "\"\" if there is a path, else why there is none.")
      .def_ro("evaluations", &RoadmapPath::evaluations, "Number of collision checks of this query.")
      .def("__bool__", &RoadmapPath::feasible)
      .def("__repr__",
           [](const RoadmapPath& a) {
             return cat("<RoadmapPath ", a.feasible() ? cat(a.path.rows(), " configurations") : inPython(a.message),
                        ">");
           })
      .def("__getstate__",
           [](const RoadmapPath& a) { return nb::make_tuple(toNumpy(a.path), a.message, a.evaluations); })
      .def(
          "__setstate__",
          [](RoadmapPath& a, const nb::tuple& state) {
            new (&a) RoadmapPath{matrixFrom(state[0]), nb::cast<std::string>(state[1]), nb::cast<long>(state[2])};
          },
          "state"_a);
  nb::class_<PyRoadmap>(m, "Roadmap", docs::roadmap::type)
      .def(
          "__init__",
          [](PyRoadmap* self, const PyConfig& config, double margin, std::uint64_t seed) {
            new (self) PyRoadmap(std::make_shared<const Config>(config), margin, seed);
          },
          "config"_a, "margin"_a = 0., "seed"_a = 0, docs::roadmap::make)
      .def(
          "grow",
          [](PyRoadmap& map, int configurations) -> PyRoadmap& {
            watched([&](const CancellationToken& cancellation) { map.grow(configurations, cancellation); });
            return map;
          },
          "configurations"_a, kChain, docs::roadmap::grow)
      .def("findPath", findPath, "start"_a, "goal"_a, docs::roadmap::findPath)
      .def(
          "setScene",
          [](PyRoadmap& map, const PyConfig& config) {
            auto scene = std::make_shared<const Config>(config);
            map.setScene(*scene);
            map.config = std::move(scene);
          },
          "config"_a, docs::roadmap::setScene)
      .def(
          "save", [](const PyRoadmap& map, const PathText& file) { map.save(file.text); }, "path"_a,
          docs::roadmap::save)
      .def("__getstate__", mapState)
      .def("__setstate__", setMapState, "state"_a)
      .def(
          "load", [](PyRoadmap& map, const PathText& file) { map.load(file.text); }, "path"_a, docs::roadmap::load)
      .def(
          "picture",
          [](const PyRoadmap& map, const PyConfig& config, const std::optional<FrameNames>& frames) {
            return PyConfig{map.picture(config, frames ? toNames(*frames) : std::vector<std::string>()), nullptr};
          },
          "config"_a, "frames"_a = nb::none(),
          cat(docs::roadmap::picture, lines::frames, lines::returnsPicture, lines::raises).c_str())
      .def(
          "_repr_html_",
          [](const PyRoadmap& map) {
            return notebookPage(map.picture(*map.config), nullptr, "Roadmap",
                                cat(map.size(), " configurations and ", map.edges(), " edges"));
          },
          "Returns a page for notebooks with the picture of the roadmap.")
      .def("__len__", &Roadmap::size)
      .def_prop_ro("edges", &Roadmap::edges, "Number of edges.")
      .def_prop_ro("margin", &Roadmap::margin, "Distance that all collidable pairs keep, m.")
      .def_prop_ro(
          "configurations", [](const PyRoadmap& map) { return toNumpy(map.configurations()); },
          "Shape (N, n), rad or m.")
      .def("__repr__", [](const PyRoadmap& map) {
        return cat("<Roadmap of ", map.size(), " configurations and ", map.edges(), " edges>");
      });
}

}  // namespace kinegraph::python
