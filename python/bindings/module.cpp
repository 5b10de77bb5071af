#include "bindings.h"

using namespace kinegraph::python;

NB_MODULE(_core, m) {
  m.doc() = "The compiled part of kinegraph.";
  m.attr("__version__") = KINEGRAPH_VERSION;
  bindErrors(m);
  bindScene(m);
  bindNlp(m);
  bindSolvers(m);
  bindKomo(m);
}
