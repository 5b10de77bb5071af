#include "kinegraph/trajectory_optimization/spline_curve.h"

#include <algorithm>

namespace kinegraph::inline trajectory_optimization_internal {

namespace {

constexpr double kSameTime = 1e-9;  // fraction of a motion

/// Returns the control points of the k-th derivative of a spline from those of the previous one. Source: de Boor, ch.
/// X.
MatrixXd derivedPoints(const BSpline& spline, const MatrixXd& points, int k) {
  const VectorXd& knots = spline.getKnots();
  const int degree = spline.degree();
  MatrixXd derived = MatrixXd::Zero(points.rows() - 1, points.cols());
  for (Eigen::Index i = 0; i < derived.rows(); ++i) {
    const double width = knots[i + degree + 1] - knots[i + k];
    if (width > 0.) derived.row(i) = (degree - k + 1) / width * (points.row(i + 1) - points.row(i));
  }
  return derived;
}

}  // namespace

SplineCurve::SplineCurve(const Path& path, std::shared_ptr<const SplineLayout> layout)
    : layout_(std::move(layout)), tau_(path.grid().tau()) {
  for (const double knot : layout_->knots.getKnots())
    if (knots_.empty() || knot > knots_.back()) knots_.push_back(knot);
  for (int slice = 0; slice < path.grid().slices(); ++slice) {
    std::vector<double>& on = knots_on_.emplace_back(1, 0.);
    for (const double knot : knots_) {
      const double time = knot / tau_ - slice;
      if (time > kSameTime && time < 1. - kSameTime) on.push_back(time);
    }
    on.push_back(1.);
    const std::vector<int> all = path.dofsOf(path.initial().joint_frames, slice - 1);
    std::vector<int>& dofs = dofs_.emplace_back();
    for (const int j : layout_->splined) dofs.push_back(all[std::size_t(j)]);
    const State &state = path.state(slice - 1), &before = path.state(std::max(slice - 2, -1));
    const bool is_same =
        slice > 0 && &state.model() == &before.model() && state.sharedParameters() == before.sharedParameters();
    if (!is_same) bounds_.emplace_back(state);
    bound_of_.push_back(int(bounds_.size()) - 1);
  }
}

void SplineCurve::moveTo(const Path& path, const VectorXd& c) {
  spline_ = layout_->splineOf(c);
  motions_.clear();
  for (int slice = 0; slice < path.grid().slices(); ++slice) motions_.push_back(kinegraph::motionInto(path, slice));
  boundSecondDerivatives();
  const VectorXd reach = spline_.getCtrlPoints().cwiseAbs().colwise().maxCoeff();
  for (std::size_t slice = 0; slice < motions_.size();) {
    const std::size_t first = slice;
    VectorXd largest = VectorXd::Zero(motions_[slice].from.size());
    for (; slice < motions_.size() && bound_of_[slice] == bound_of_[first]; ++slice)
      largest = largest.cwiseMax(motions_[slice].from.cwiseAbs()).cwiseMax(motions_[slice].to.cwiseAbs());
    largest(dofs_[first]) = reach;
    bounds_[std::size_t(bound_of_[first])].setLargest(largest);
  }
}

void SplineCurve::boundSecondDerivatives() {
  const int degree = spline_.degree();
  second_derivatives_.setZero(Eigen::Index(knots_.size()) - 1, spline_.dimension());
  if (degree < 2) return;
  const MatrixXd second_derivatives =
      derivedPoints(spline_, derivedPoints(spline_, spline_.getCtrlPoints(), 1), 2).cwiseAbs();
  for (Eigen::Index piece = 0; piece < second_derivatives_.rows(); ++piece)  // inner knots are simple
    second_derivatives_.row(piece) = second_derivatives.middleRows(piece, degree - 1).colwise().maxCoeff();
}

int SplineCurve::pieceAt(double time) const {
  const auto next = std::ranges::upper_bound(knots_, time);
  return std::clamp(int(next - knots_.begin()) - 1, 0, int(knots_.size()) - 2);
}

VectorXd SplineCurve::at(int slice, double time) const {
  const SliceMotion& motion = motionInto(slice);
  VectorXd q = (1. - time) * motion.from + time * motion.to;
  q(dofs_[std::size_t(slice)]) = spline_.eval((slice + time) * tau_);
  return q;
}

SliceMotion SplineCurve::line(int slice, double begin, double end) const {
  const SliceMotion& whole = motionInto(slice);
  const double width = whole.end - whole.begin;
  return {slice,
          whole.begin + begin * width,
          whole.begin + end * width,
          whole.model,
          whole.parameters,
          begin == 0. ? whole.from : at(slice, begin),
          end == 1. ? whole.to : at(slice, end)};
}

double SplineCurve::deviation(const SliceMotion& line, double begin, double end) {
  const double width = (end - begin) * tau_;
  const int piece = pieceAt((line.slice + .5 * (begin + end)) * tau_);
  VectorXd deviation = VectorXd::Zero(line.from.size());
  deviation(dofs_[std::size_t(line.slice)]) = .125 * width * width * second_derivatives_.row(piece);
  return bounds_[std::size_t(bound_of_[std::size_t(line.slice)])].of(line.from, line.to, deviation);
}

}  // namespace kinegraph::inline trajectory_optimization_internal
