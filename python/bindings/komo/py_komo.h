#pragma once

#include <memory>

#include "bindings.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph::python {

/// What Python calls a KOMO: the motion problem, and the viewer that `view()` opens at first use.
struct PyKomo : Komo {
  std::shared_ptr<PyViewer> viewer;
};

/// Its slices: what is in them, and where they start.
void bindKomoPath(nb::module_& m, nb::class_<PyKomo>& komo);

/// What a KOMO says about itself, in words, numbers and pictures.
void bindKomoReports(nb::class_<PyKomo>& komo);

/// copy.copy and pickle.
void bindKomoCopies(nb::class_<PyKomo>& komo);

}  // namespace kinegraph::python
