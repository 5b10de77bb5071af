#pragma once

#include <nanobind/nanobind.h>

#include <chrono>
#include <functional>
#include <memory>
#include <string>

#include "arrays.h"
#include "kinds.h"
#include "kinegraph/collision/edge_checkers.h"
#include "kinegraph/collision/near_pairs.h"
#include "kinegraph/features/residual_cache.h"
#include "kinegraph/scene/config.h"
#include "recent_calls.h"

namespace kinegraph::python {

namespace nb = nanobind;
using namespace nb::literals;

struct PyViewer;

/// A Config in Python: the scene, the viewer that `view()` opens at first use, and caches of the last calls of `eval`,
/// `setJointState` and `getNearestPoints`.
struct PyConfig : Config {
  std::shared_ptr<PyViewer> viewer;
  mutable ResidualCache residuals = {};
  mutable RecentCalls calls = {};
  mutable std::shared_ptr<PairDistances> pairs = {};
  mutable EdgeCheckers checkers = {};
  VectorXd joints = {};
  mutable std::uint64_t warned_revision = 0;             ///< structure revision of the last contact warnings
  mutable std::uint64_t noted_revision = 0;              ///< that of the last warnings about missing contact
  mutable std::vector<std::string> given_warnings = {};  ///< the contact warnings given so far
};

/// Warns of `contactWarnings`, each once per scene.
void warnOfContacts(const PyConfig& config);

/// Warns of shapes and robots that cannot collide, each once per scene.
void warnOfMissingContacts(const PyConfig& config);

void bindErrors(nb::module_& m);
void bindLog();
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
void bindCustomFeatures(nb::module_& m);
void bindBatch(nb::class_<PyConfig>& config);
void bindNlp(nb::module_& m);
void bindSolvers(nb::module_& m);
void bindKomo(nb::module_& m);
void bindSkeleton(nb::module_& m);
void bindIk(nb::module_& m);
void bindTrajectory(nb::module_& m);
void bindRetime(nb::module_& m);
void bindToolPaths(nb::module_& m);
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
void bindPerception(nb::module_& m);
void bindSceneObserver(nb::module_& m);
void bindViewer(nb::module_& m, nb::class_<PyConfig>& config);

/// Reports warnings about a scene through Python's `warnings`.
void emitWarnings(Config& config);
void emitWarning(const std::string& message);

/// Resolves a Frame, or a frame's name or id in the configuration. Throws FrameNotFound for an unknown name; the
/// message names the caller `who`.
Frame toFrame(const Config& config, nb::handle name_or_id, const char* who = "getFrame");

/// For long calls without the GIL: acquires it, and throws KeyboardInterrupt after Ctrl-C.
void checkInterrupt();

/// A CancellationToken that calls checkInterrupt() at most every 20 ms. It never cancels; it throws.
class CheckInterrupts {
 public:
  /// Calls checkInterrupt() if the last call was at least 20 ms ago. Returns whether it did.
  bool checkIfDue();
  void operator()() { checkIfDue(); }

 private:
  std::chrono::steady_clock::time_point checked_ = std::chrono::steady_clock::now();
};

}  // namespace kinegraph::python
