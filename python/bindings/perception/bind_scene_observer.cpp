#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/perception/occupancy_map.h"
#include "perception/depth_views.h"
#include "perception/perception_docs.h"
#include "perception/scene_observer_object.h"
#include "python_names.h"

namespace kinegraph::python {

namespace {

void makeObserver(PySceneObserver* self, const nb::object& take, std::vector<std::string> frames,
                  const std::optional<std::string>& support, double search_radius, const std::string& prior,
                  const nb::object& map, const std::string& unseen) {
  RegisterOptions options;
  options.prior = priorFromName(prior);
  options.support = support.value_or("");
  options.search_radius = search_radius;
  OccupancyMap* cells = map.is_none() ? nullptr : &nb::cast<OccupancyMap&>(map);
  const auto views = [take] {
    const nb::gil_scoped_acquire lock;
    const nb::object taken = take();
    try {
      return depthViews(taken);
    } catch (const nb::cast_error&) {
      throw ValueError(cat("SceneObserver: take returned an object of type ",
                           nb::cast<std::string>(taken.type().attr("__name__")),
                           "; expected a DepthView or a sequence of them"));
    }
  };
  auto observer = std::make_unique<SceneObserver>(views, std::move(frames), options, cells, unseenFromName(unseen));
  new (self) PySceneObserver{take, map, std::move(observer)};
}

nb::dict observeWith(PySceneObserver& self, PyConfig& config) {
  std::map<std::string, std::optional<Pose>> poses;
  {
    const nb::gil_scoped_release unlock;
    poses = self.observe(config);
  }
  nb::dict result;
  for (const auto& [name, pose] : poses) result[name.c_str()] = pose ? nb::cast(seenPose(*pose)) : nb::none();
  return result;
}

}  // namespace

std::map<std::string, std::optional<Pose>> PySceneObserver::observe(Config& scene) {
  std::map<std::string, std::optional<Pose>> poses = observer->observe(scene);
  const nb::gil_scoped_acquire lock;
  for (const std::string& warning : observer->seen().warnings) emitWarning(cat("SceneObserver: ", inPython(warning)));
  return poses;
}

void bindSceneObserver(nb::module_& m) {
  nb::class_<PySceneObserver>(m, "SceneObserver", docs::perception::sceneObserver)
      .def("__init__", makeObserver, "take"_a, "frames"_a, nb::kw_only(), "support"_a = nb::none(),
           "search_radius"_a = RegisterOptions().search_radius, "prior"_a = "last", "map"_a = nb::none(),
           "unseen"_a = "shadows",
           nb::sig("def __init__(self, take: collections.abc.Callable[[], DepthView | "
                   "collections.abc.Sequence[DepthView]], frames: collections.abc.Sequence[str], *, support: str | "
                   "None = None, search_radius: float = 0.05, prior: str = 'last', map: OccupancyMap | None = None, "
                   "unseen: str = "
                   "'shadows') -> None"),
           docs::perception::makeObserver)
      .def("observe", observeWith, "config"_a, docs::perception::observe,
           nb::sig("def observe(self, config: Config) -> dict[str, numpy.ndarray | None]"))
      .def_prop_ro(
          "seen", [](const PySceneObserver& self) { return self.observer->seen(); },
          "The SeenScene of the last images: what they showed of the things.")
      .def_ro("map", &PySceneObserver::map, nb::for_getter(nb::sig("def map(self, /) -> OccupancyMap | None")),
              "The OccupancyMap, or None.");
}

}  // namespace kinegraph::python
