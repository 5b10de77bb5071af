#include "kinegraph/trajectory_optimization/motion_problems.h"

#include <Eigen/QR>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/trajectory_optimization/spline_motions.h"
#include "kinegraph/trajectory_optimization/spline_nlp.h"

namespace kinegraph {

namespace {

constexpr double kSingularThreshold = 1e-6;  // smallest singular value that is accepted, relative to the largest

}  // namespace

void SplineMotionOptions::validate(int slices) const {
  if (slices == 0) throw ValueError("SplineMotion: the KOMO has no slices yet; call setConfig and setTiming first");
  if (points < 1 || points > slices)
    throw ValueError(cat("SplineMotion: points is ", points, "; expected 1 to ", slices, ", one per slice"));
  if (degree < 1 || degree > 9) throw ValueError(cat("SplineMotion: degree is ", degree, "; expected 1 to 9"));
}

SplineMotion::SplineMotion(std::shared_ptr<Komo> komo, const SplineMotionOptions& options)
    : komo_(std::move(komo)), options_(options) {
  options_.validate(komo_->slices());
  if (komo_->order() < 1)
    throw ValueError(
        "SplineMotion: the KOMO has order 0; expected 1 or more, since the spline starts in the slice before the "
        "first");
  const MatrixXd B = splineBasis(komo_->path().grid(), options_);
  Eigen::ColPivHouseholderQR<MatrixXd> decomposition(B.rightCols(B.cols() - 1));
  decomposition.setThreshold(kSingularThreshold);
  if (decomposition.rank() < B.cols() - 1)
    throw ValueError(cat("SplineMotion: ", komo_->slices(), " slices do not determine ", B.cols() - 1,
                         " control points; use fewer points or more slices"));
}

std::shared_ptr<Nlp> SplineMotion::nlp() const {
  return std::make_shared<SplineNlp>(komo_,
                                     std::make_shared<const SplineLayout>(layOutSpline(komo_->path(), options_)));
}

BSpline SplineMotion::spline() const {
  const SplineLayout layout = layOutSpline(komo_->path(), options_);
  if (int(layout.splined.size()) != komo_->dofs())
    throw Error("SplineMotion: some joints are not part of the spline, because all slices share them");
  return layout.splineOf(layout.map->fit(komo_->path().variables()));
}

bool SplineMotion::isFree(double margin) const {
  if (!std::isfinite(margin)) throw ValueError(cat("SplineMotion: margin is ", margin, "; expected a distance in m"));
  const Path& path = komo_->path();
  const auto layout = std::make_shared<const SplineLayout>(layOutSpline(path, options_));
  SplineCurve curve(path, layout);
  curve.moveTo(path, layout->map->fit(path.variables()));
  MotionProbe probe(kFreeTolerance);
  SplineMotions motions(curve, probe);
  for (int slice = 0; slice < komo_->slices(); ++slice)
    if (motions.tooNear(slice, margin)) return false;
  return true;
}

}  // namespace kinegraph
