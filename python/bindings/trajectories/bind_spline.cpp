#include <nanobind/stl/string.h>

#include "arguments.h"
#include "bindings.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectories/trajectory.h"
#include "trajectories/spline_docs.h"
#include "trajectories/trajectory_docs.h"

namespace kinegraph::python {

namespace {

using Parts = nb::typed<nb::tuple, int, Array, Array>;

/// Points as rows. Each number of a flat list is a point, unless there is only one time.
MatrixXd points(const Numbers& numbers, std::size_t count) {
  if (numbers.rank == 2 || (numbers.rank == 1 && count == 1)) return numbers.matrix();
  return numbers.values;
}

}  // namespace

void bindSpline(nb::module_& m) {
  nb::class_<BSpline>(m, "BSpline", docs::spline::type)
      .def(nb::init<>(), docs::spline::make)
      .def(
          "setKnots",
          [](BSpline& s, int degree, const Numbers& times) -> BSpline& { return s.setKnots(degree, times.values); },
          "degree"_a, "times"_a, kChain, docs::spline::setKnots)
      .def(
          "setCtrlPoints",
          [](BSpline& s, const Numbers& points_argument, bool start, bool end, const Numbers& v0, const Numbers& v1)
              -> BSpline& { return s.setCtrlPoints(points(points_argument, 0), start, end, v0.values, v1.values); },
          "points"_a, "addStartDuplicates"_a = true, "addEndDuplicates"_a = true, "setStartVel"_a = nb::list(),
          "setEndVel"_a = nb::list(), kChain, docs::spline::setCtrlPoints)
      .def(
          "set",
          [](BSpline& s, int degree, const Numbers& points_argument, const Numbers& times, const Numbers& v0,
             const Numbers& v1) -> BSpline& {
            return s.set(degree, points(points_argument, 0), times.values, v0.values, v1.values);
          },
          "degree"_a, "points"_a, "times"_a, "setStartVel"_a = nb::list(), "setEndVel"_a = nb::list(), kChain,
          docs::spline::set)
      .def(
          "append",
          [](BSpline& s, const Numbers& points_argument, const Numbers& times, bool inside) -> BSpline& {
            return s.append(points(points_argument, std::size_t(times.values.size())), times.values, inside);
          },
          "points"_a, "times_rel"_a, "inside"_a = false, kChain, docs::spline::append)
      .def(
          "overwriteSmooth",
          [](BSpline& s, const Numbers& points_argument, const Numbers& times, double cut) -> BSpline& {
            return s.overwriteSmooth(points(points_argument, std::size_t(times.values.size())), times.values, cut);
          },
          "points"_a, "times_rel"_a, "time_cut"_a, kChain, docs::spline::overwriteSmooth)
      .def(
          "eval", [](const BSpline& s, const Numbers& times, int k) { return toNumpy(s.eval(times.values, k)); },
          "sampleTimes"_a, "derivative"_a = 0, docs::spline::eval)
      .def(
          "eval3", [](const BSpline& s, double t) { return toNumpy(s.eval3(t)); }, "time"_a, docs::spline::eval3)
      .def(
          "getBmatrix",
          [](const BSpline& s, const Numbers& times, bool start, bool end) {
            return toNumpy(s.getBmatrix(times.values, start, end));
          },
          "sampleTimes"_a, "startDuplicates"_a = false, "endDuplicates"_a = false, docs::spline::getBmatrix)
      .def(
          "getKnots", [](const BSpline& s) { return toNumpy(s.getKnots()); }, docs::spline::getKnots)
      .def(
          "getCtrlPoints", [](const BSpline& s) { return toNumpy(s.getCtrlPoints()); }, docs::spline::getCtrlPoints)
      .def_prop_ro("degree", &BSpline::degree, "Degree of its polynomials, 0 to 9.")
      .def("__repr__",
           [](const BSpline& s) {
             if (s.isEmpty()) return std::string("<BSpline without points>");
             return cat("<BSpline of degree ", s.degree(), ": ", s.getCtrlPoints().rows(), " control points of ",
                        s.dimension(), " numbers, ", s.start(), " to ", s.end(), " s>");
           })
      .def("__getstate__",
           [](const BSpline& s) {
             return Parts(nb::make_tuple(s.degree(), toNumpy(s.getKnots()), toNumpy(s.getCtrlPoints())));
           })
      .def("__setstate__", [](BSpline& s, const Parts& parts) {
        const auto ctrl_points = nb::cast<Numbers>(parts[2]);
        new (&s) BSpline(BSpline::fromParts(nb::cast<int>(parts[0]), nb::cast<Numbers>(parts[1]).values,
                                            ctrl_points.values.size() ? ctrl_points.matrix() : MatrixXd()));
      });
  nb::class_<SplineTrajectory, Trajectory>(m, "SplineTrajectory", docs::trajectory::SplineTrajectory)
      .def(nb::init<BSpline>(), "spline"_a, docs::trajectory::SplineTrajectory_make)
      .def_prop_ro(
          "spline", [](const SplineTrajectory& t) { return BSpline(t.spline()); }, "A copy of the spline.")
      .def("__getstate__", [](const SplineTrajectory& t) { return nb::make_tuple(BSpline(t.spline())); })
      .def("__setstate__",
           [](SplineTrajectory& t, const nb::tuple& parts) { new (&t) SplineTrajectory(nb::cast<BSpline>(parts[0])); });
}

}  // namespace kinegraph::python
