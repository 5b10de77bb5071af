#include "kinegraph/trajectories/spline_part.h"

#include <vector>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph {

namespace {

/// The times at which one polynomial follows another, with both ends.
std::vector<double> breaks(const BSpline& motion, double from, double until) {
  std::vector<double> times = {from};
  for (const double knot : motion.getKnots())
    if (knot > times.back() && knot < until) times.push_back(knot);
  times.push_back(until);
  return times;
}

}  // namespace

/// A chain of Bernstein polynomials, each from the derivatives where it begins; three knots join two of them.
BSpline cubicPart(const BSpline& motion, double from, double until) {
  if (motion.degree() > 3) throw ValueError(cat("cubicPart: the degree is ", motion.degree(), "; expected 3 at most"));
  if (!(until > from)) throw ValueError(cat("cubicPart: from ", from, " until ", until, "; expected a later time"));
  const std::vector<double> times = breaks(motion, from, until);
  const auto pieces = Eigen::Index(times.size()) - 1;
  MatrixXd points(3 * pieces + 1, motion.dimension());
  VectorXd knots(3 * pieces + 5);
  knots[0] = from;
  for (Eigen::Index i = 0; i < pieces; ++i) {
    const double begin = times[std::size_t(i)], h = times[std::size_t(i) + 1] - begin;
    const VectorXd p = motion.eval(begin), v = h / 3. * motion.eval(begin, 1), a = h * h / 6. * motion.eval(begin, 2);
    points.row(3 * i) = p.transpose();
    points.row(3 * i + 1) = (p + v).transpose();
    points.row(3 * i + 2) = (p + 2. * v + a).transpose();
    points.row(3 * i + 3) = (p + 3. * v + 3. * a + h * h * h / 6. * motion.eval(begin, 3)).transpose();
    knots.segment(3 * i + 1, 3).setConstant(begin);
  }
  knots.tail(4).setConstant(until);
  return BSpline::fromParts(3, knots, points);
}

}  // namespace kinegraph
