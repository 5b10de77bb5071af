#pragma once

#include <memory>

#include "bindings.h"
#include "kinegraph/komo/komo.h"

namespace kinegraph::python {

/// The KOMO class of Python: the problem, and the viewer that `view()` opens on first use.
struct PyKomo : Komo {
  std::shared_ptr<PyViewer> viewer;
};

/// Methods for the slices: values and initialization.
void bindKomoPath(nb::module_& m, nb::class_<PyKomo>& komo);

/// Methods for reports, viewing and pictures.
void bindKomoReports(nb::class_<PyKomo>& komo);

/// Methods for copy.copy and pickle.
void bindKomoCopies(nb::class_<PyKomo>& komo);

}  // namespace kinegraph::python
