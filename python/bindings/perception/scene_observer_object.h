#pragma once

#include <nanobind/nanobind.h>

#include "kinegraph/perception/scene_observer.h"

namespace kinegraph::python {

/// A SceneObserver, and the Python objects that it uses.
struct PySceneObserver {
  nb::object take, map;
  std::unique_ptr<SceneObserver> observer;

  /// Called without the lock of the interpreter. Gives warnings as Python warnings.
  std::map<std::string, std::optional<Pose>> observe(Config& scene);
};

}  // namespace kinegraph::python
