#include <nanobind/stl/string.h>

#include <cstdlib>

#include "arguments.h"
#include "bindings.h"
#include "call_errors.h"
#include "control/control.h"
#include "kinegraph/gfile/parser.h"
#include "module_docs.h"
#include "scene/scene_values.h"
#include "simulation/simulation_objects.h"
#include "solvers/nlp_objects.h"
#include "task_planning/bind_tasks.h"

using namespace kinegraph::python;
using namespace nanobind::literals;

namespace {

/// Keeps freed memory for the next solver. By default glibc returns it to the system, at the cost of one page fault per
/// 4 KB in the next solve: a sixth of the time of a path of 256 slices. Freeing a large block raises glibc's thresholds
/// (M_MMAP_THRESHOLD, M_TRIM_THRESHOLD), up to 32 MB; thresholds set by the environment stay.
void keepFreedMemory() {
#ifdef __GLIBC__
  void* volatile block = std::malloc((std::size_t(32) << 20) - (std::size_t(64) << 10));  // its pages are never touched
  std::free(block);
#endif
}

}  // namespace

NB_MODULE(_core, m) {
  keepFreedMemory();
  m.doc() = "The compiled part of kinegraph.";
  // A user's function called by a problem keeps its module alive, and the module the problem. Process exit resolves
  // such cycles; they are not leaks.
  nb::set_leak_warnings(false);
  m.attr("__version__") = KINEGRAPH_VERSION;
  bindErrors(m);
  bindLog();
  bindTrajectory(m);
  bindScene(m);
  bindRendering(m);
  bindPerception(m);
  bindNlp(m);
  bindSolvers(m);
  bindKomo(m);
  bindSkeleton(m);
  bindManipulation(m);
  bindLogic(m);
  bindSolveMany(m);
  bindIk(m);
  bindRetime(m);
  bindDiffIk(m);
  bindMpc(m);
  bindStreams(m);
  bindPathFinder(m);
  bindPlan(m);
  bindRoadmap(m);
  bindToolPaths(m);
  bindSpline(m);
  bindSplineMotion(m);
  bindTasks(m);
  bindSimulation(m);
  bindRobot(m);
  m.def(
      "parseText",
      [](const std::string& text, const std::string& name) { return Attributes(toDict(kinegraph::parse(text, name))); },
      "text"_a, "name"_a = "text", docs::module::parseText);
  explainWrongArguments(m);
}
