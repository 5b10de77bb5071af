#include "kinegraph/planning/path_finder.h"

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/planning/endpoints.h"
#include "kinegraph/planning/plan_timing.h"
#include "kinegraph/planning/search/path_search.h"
#include "kinegraph/planning/smoothing/shortcut.h"
#include "kinegraph/trajectories/path_curve.h"

namespace kinegraph {

namespace {

constexpr int kPointsPerBlend = 9;

void requireFreePath(const Config& config, Steering& steering, const MatrixXd& path, const char* who) {
  if (path.rows() == 0 || path.cols() != config.getJointDimension() || !path.allFinite())
    throw ValueError(cat(who, ": the path has shape (", path.rows(), ", ", path.cols(), "); expected (K, ",
                         config.getJointDimension(), "), finite numbers"));
  for (Eigen::Index k = 1; k < path.rows(); ++k) {
    const auto contact = steering.check().contact(path.row(k - 1).transpose(), path.row(k).transpose());
    if (!contact) continue;
    throw ValueError(cat(who, ": the path is in collision between rows ", k - 1, " and ", k, ": ",
                         describePairs(*config.model(), {{steering.check().lastDistance(), contact->a, contact->b}})));
  }
}

}  // namespace

MatrixXd shortcut(const Config& config, const MatrixXd& path, const RefineOptions& options) {
  const State scene = config.state();
  const JointSpace space(scene.model());
  Steering steering({.scene = &scene, .space = &space, .clearance = {.margin = options.margin}});
  requireFreePath(config, steering, path, "shortcut");
  std::vector<VectorXd> points;
  for (Eigen::Index k = 0; k < path.rows(); ++k) points.push_back(path.row(k).transpose());
  return space.unroll(
      shortcutPath(steering, std::move(points), {.seed = options.seed, .cancellation = options.cancellation}));
}

MatrixXd smooth(const Config& config, const MatrixXd& path, const RefineOptions& options) {
  if (!(options.blend >= 0.)) throw ValueError(cat("smooth: blend is ", options.blend, "; expected a number >= 0"));
  const State scene = config.state();
  const JointSpace space(scene.model());
  Steering steering({.scene = &scene, .space = &space, .clearance = {.margin = options.margin}});
  requireFreePath(config, steering, path, "smooth");
  const PathCurve curve = blendedPolyline(path, {.tolerance = options.blend, .is_free = collisionFreeBlends(steering)});
  std::vector<VectorXd> points = {path.row(0).transpose()};
  for (int piece = 0; piece < curve.pieces(); ++piece) {
    const int count = curve.isLine(piece) ? 1 : kPointsPerBlend - 1;
    for (int i = 1; i <= count; ++i) {
      VectorXd q(curve.dofs());
      const double begin = curve.begin(piece), end = curve.end(piece);
      curve.eval(piece, begin + double(i) / count * (end - begin), 0, q.data());
      points.push_back(q);
    }
  }
  return space.unroll(points);
}

}  // namespace kinegraph
