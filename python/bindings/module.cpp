#include <nanobind/stl/string.h>

#include "bindings.h"
#include "nlp_objects.h"
#include "kinegraph/gfile/parser.h"
#include "scene_values.h"

using namespace kinegraph::python;
using namespace nanobind::literals;

NB_MODULE(_core, m) {
  m.doc() = "The compiled part of kinegraph.";
  // A function of the user's that a problem calls keeps its module alive, and that the problem: the end of the process, not a
  // leak, resolves such circles.
  nb::set_leak_warnings(false);
  m.attr("__version__") = KINEGRAPH_VERSION;
  bindErrors(m);
  bindScene(m);
  bindRendering(m);
  bindNlp(m);
  bindSolvers(m);
  bindKomo(m);
  bindSkeleton(m);
  bindSolveMany(m);
  bindPlanning(m);
  m.def("parseText", [](const std::string& text, const std::string& name) { return toDict(kinegraph::parse(text, name)); },
        "text"_a, "name"_a = "text", "Text in .g syntax as a dict.");
}
