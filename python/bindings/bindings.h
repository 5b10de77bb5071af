#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "arrays.h"
#include "kinds.h"
#include "kinegraph/collision/edge_checkers.h"
#include "kinegraph/features/residual_cache.h"
#include "kinegraph/scene/config.h"
#include "recent_calls.h"

namespace kinegraph::python {

namespace nb = nanobind;
using namespace nb::literals;

struct PyViewer;

/// What Python calls a Config: the scene, the viewer that `view()` opens at first use, and what was last asked of
/// `eval`, `setJointState` and `getNearestPoints`.
struct PyConfig : Config {
  std::shared_ptr<PyViewer> viewer;
  mutable ResidualCache residuals = {};
  mutable RecentCalls calls = {};
  mutable std::shared_ptr<PairDistances> pairs = {};
  mutable EdgeCheckers checkers = {};
  VectorXd joints = {};
  mutable std::uint64_t noted = 0;              ///< structure revision for which notes were given
  mutable std::vector<std::string> notes = {};  ///< those that were given
};

/// Warns of `contactWarnings`, of each once per scene.
void warnOfContacts(const PyConfig& config);

void bindErrors(nb::module_& m);
void bindScene(nb::module_& m);
void bindJoints(nb::class_<PyConfig>& config);
void bindCollisions(nb::module_& m, nb::class_<PyConfig>& config);
void bindFrame(nb::class_<Frame>& frame);
void bindFramePoses(nb::class_<Frame>& frame);
void bindFrameJoint(nb::class_<Frame>& frame);
void bindShapes(nb::class_<Frame>& frame);
void bindMeshes(nb::class_<Frame>& frame);
void bindStructure(nb::class_<PyConfig>& config);
void bindFeatures(nb::module_& m, nb::class_<PyConfig>& config);
void bindOwnFeatures(nb::module_& m);
void bindBatch(nb::class_<PyConfig>& config);
void bindNlp(nb::module_& m);
void bindSolvers(nb::module_& m);
void bindKomo(nb::module_& m);
void bindSkeleton(nb::module_& m);
void bindIk(nb::module_& m);
void bindTrajectory(nb::module_& m);
void bindRetime(nb::module_& m);
void bindPathFinder(nb::module_& m);
void bindPlan(nb::module_& m);
void bindRoadmap(nb::module_& m);
void bindSpline(nb::module_& m);
void bindSplineMotion(nb::module_& m);
void bindRobot(nb::module_& m);
void bindDynamics(nb::class_<PyConfig>& config);
void bindCompatibility(nb::class_<PyConfig>& config);
void bindFormats(nb::class_<PyConfig>& config, nb::class_<Frame>& frame);
void bindRendering(nb::module_& m);
void bindViewer(nb::module_& m, nb::class_<PyConfig>& config);

/// Passes on what was odd about a scene through Python's `warnings`.
void emitWarnings(Config& config);
void emitWarning(const std::string& message);

/// A Frame or a frame's name, id in the configuration. Throws FrameNotFound for a name that is not there, which says that
/// `who` asked for it.
Frame toFrame(const Config& config, nb::handle name_or_id, const char* who = "getFrame");

/// For long calls that run without the interpreter lock: takes it, and throws KeyboardInterrupt if Ctrl-C was pressed.
void checkInterrupt();

/// The same, but only every 20 ms: then true.
class CheckInterrupts {
 public:
  bool operator()();

 private:
  std::chrono::steady_clock::time_point checked_ = std::chrono::steady_clock::now();
};

}  // namespace kinegraph::python
