#include <nanobind/stl/shared_ptr.h>
#include <nanobind/stl/string.h>

#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectory_optimization/motion_problems.h"
#include "komo/py_komo.h"
#include "trajectory_optimization/spline_motion_docs.h"

namespace kinegraph::python {

void bindSplineMotion(nb::module_& m) {
  nb::class_<SplineMotion>(m, "SplineMotion", docs::splineMotion::type)
      .def(
          "__init__",
          [](SplineMotion* motion, std::shared_ptr<PyKomo> komo, int points, int degree, bool ends_at_rest) {
            new (motion) SplineMotion(std::move(komo), {points, degree, ends_at_rest});
          },
          "komo"_a, "points"_a = 8, "degree"_a = 3, nb::kw_only(), "ends_at_rest"_a = true, docs::splineMotion::make)
      .def("nlp", &SplineMotion::nlp, docs::splineMotion::nlp)
      .def("spline", &SplineMotion::spline, docs::splineMotion::spline)
      .def("isFree", &SplineMotion::isFree, "margin"_a = 0., docs::splineMotion::isFree)
      .def("__repr__", [](const SplineMotion& s) {
        return cat("<SplineMotion ", s.options().points, " control points of degree ", s.options().degree, ", ",
                   s.komo()->slices(), " slices>");
      });
}

}  // namespace kinegraph::python
