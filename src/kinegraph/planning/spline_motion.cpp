#include "kinegraph/planning/spline_motion.h"

#include <Eigen/QR>
#include <algorithm>

#include "kinegraph/base/errors.h"
#include "kinegraph/base/text.h"

namespace kinegraph {

void SplineMotionOptions::validate(int slices) const {
  if (slices == 0) throw ValueError("SplineMotion: the KOMO has no slices yet; call setConfig and setTiming first");
  if (points < 1 || points > slices)
    throw ValueError(cat("SplineMotion: points is ", points, "; expected 1 to ", slices, ", one per slice"));
  if (degree < 1 || degree > 9) throw ValueError(cat("SplineMotion: degree is ", degree, "; expected 1 to 9"));
}

/// Where the variables are: x = M c + offset.
struct SplineMotion::Layout {
  std::shared_ptr<LinearMap> map;
  VectorXd lower, upper;     ///< of c
  std::vector<int> splined;  ///< of the given configuration's dofs: those that the spline takes
  Eigen::MatrixXi columns;   ///< of c: (control point, splined dof)
};

namespace {

constexpr double kLeastShare = 1e-6;  // of the best told combination of control points, that the worst told one has

/// Which entry of x a dof of a slice is; -1: none.
int columnOf(const Path& path, int slice, int dof) {
  const PathLayout& layout = path.layout();
  return layout.plain ? slice * path.state(0).dofs() + dof
                      : layout.column[std::size_t(slice + path.grid().order())][std::size_t(dof)];
}

/// The given configuration's dofs in x: slices x dofs.
Eigen::MatrixXi jointColumns(const Path& path) {
  Eigen::MatrixXi columns(path.grid().slices(), path.dofs());
  for (int slice = 0; slice < columns.rows(); ++slice) {
    const std::vector<int> dofs = path.dofsOf(path.given().joint_frames, slice);
    for (int j = 0; j < columns.cols(); ++j) columns(slice, j) = columnOf(path, slice, dofs[std::size_t(j)]);
  }
  return columns;
}

/// Has the dof a variable of its own in every slice?
bool isOfEachSlice(const Eigen::MatrixXi& columns, int dof) {
  for (int slice = 0; slice < columns.rows(); ++slice)
    if (columns(slice, dof) < 0 || (slice > 0 && columns(slice, dof) == columns(slice - 1, dof))) return false;
  return true;
}

VectorXd startOf(const Path& path) {
  const VectorXd& q = path.state(-1).q();
  const std::vector<int> dofs = path.dofsOf(path.given().joint_frames, -1);
  VectorXd start(path.dofs());
  for (std::size_t j = 0; j < dofs.size(); ++j) start[Eigen::Index(j)] = q[dofs[j]];
  return start;
}

VectorXd timesTo(double end, int count) { return VectorXd::LinSpaced(count + 1, 0., end); }

}  // namespace

SplineMotion::SplineMotion(std::shared_ptr<Komo> komo, const SplineMotionOptions& options)
    : komo_(std::move(komo)), options_(options) {
  options_.validate(komo_->slices());
  if (komo_->order() < 1) throw ValueError("SplineMotion: the KOMO has order 0, so that its motion has no beginning");
  const MatrixXd B = basis();
  Eigen::ColPivHouseholderQR<MatrixXd> decomposition(B.rightCols(B.cols() - 1));
  decomposition.setThreshold(kLeastShare);
  if (decomposition.rank() < B.cols() - 1)
    throw ValueError(cat("SplineMotion: ", komo_->slices(), " slices do not tell ", B.cols() - 1,
                         " control points apart; take fewer, or more slices"));
}

/// Where the slices are: slices x control points, the start first.
MatrixXd SplineMotion::basis() const {
  const int slices = komo_->slices();
  const double end = slices * komo_->tau();
  BSpline basis;
  basis.setKnots(options_.degree, timesTo(end, options_.points));
  return basis.getBmatrix(timesTo(end, slices).tail(slices), true, options_.ends_at_rest);
}

/// Variables follow one another in time, so that what depends on each other is near in c.
SplineMotion::Layout SplineMotion::layout() const {
  const Path& path = komo_->path();
  const int slices = komo_->slices();
  const MatrixXd B = basis();
  const int points = int(B.cols()) - 1;  // the first one is the start
  const Eigen::MatrixXi columns = jointColumns(path);
  Layout layout;
  std::vector<char> is_splined(std::size_t(path.layout().dimension), 0);
  for (int j = 0; j < columns.cols(); ++j) {
    if (!isOfEachSlice(columns, j)) continue;
    layout.splined.push_back(j);
    for (int slice = 0; slice < slices; ++slice) is_splined[std::size_t(columns(slice, j))] = 1;
  }
  struct Variable {
    double slice;
    int point, dof, column;  ///< of a control point: its number, the splined dof, and where its limits are
  };
  std::vector<Variable> variables;
  for (int i = 0; i < points; ++i)
    for (std::size_t d = 0; d < layout.splined.size(); ++d)
      variables.push_back({(i + 1.) * slices / points - .5, i, int(d), columns(0, layout.splined[d])});
  for (int slice = 0; slice < slices; ++slice) {
    const int dofs = path.state(slice).dofs();
    for (int dof = 0; dof < dofs; ++dof) {
      const int column = columnOf(path, slice, dof);
      if (column < 0 || is_splined[std::size_t(column)]) continue;
      is_splined[std::size_t(column)] = 1;  // what slices share, once
      variables.push_back({double(slice), -1, -1, column});
    }
  }
  std::ranges::stable_sort(variables, {}, &Variable::slice);
  layout.lower.resize(Eigen::Index(variables.size())), layout.upper = layout.lower;
  layout.columns.resize(points, Eigen::Index(layout.splined.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < int(variables.size()); ++c) {
    const Variable& variable = variables[std::size_t(c)];
    layout.lower[c] = path.layout().lower[variable.column], layout.upper[c] = path.layout().upper[variable.column];
    if (variable.point < 0) {
      entries.emplace_back(variable.column, c, 1.);
      continue;
    }
    layout.columns(variable.point, variable.dof) = c;
    const int dof = layout.splined[std::size_t(variable.dof)];
    for (int slice = 0; slice < slices; ++slice)
      if (const double weight = B(slice, variable.point + 1); weight != 0.)
        entries.emplace_back(columns(slice, dof), c, weight);
  }
  layout.map = std::make_shared<LinearMap>();
  layout.map->M.resize(path.layout().dimension, Eigen::Index(variables.size()));
  layout.map->M.setFromTriplets(entries.begin(), entries.end());
  layout.map->offset.setZero(path.layout().dimension);
  const VectorXd start = startOf(path);
  for (const int dof : layout.splined)
    for (int slice = 0; slice < slices; ++slice) layout.map->offset[columns(slice, dof)] = B(slice, 0) * start[dof];
  return layout;
}

std::shared_ptr<Nlp> SplineMotion::nlp() const {
  const Layout layout = this->layout();
  return std::make_shared<MappedNlp>(makeNlp(komo_), layout.map, layout.lower, layout.upper);
}

BSpline SplineMotion::spline() const {
  const Layout layout = this->layout();
  if (int(layout.splined.size()) != komo_->dofs())
    throw Error("SplineMotion: some joints are no part of the spline, as all slices share them");
  const VectorXd c = layout.map->fit(komo_->path().variables());
  MatrixXd points(layout.columns.rows() + 1, layout.columns.cols());
  points.row(0) = startOf(komo_->path()).transpose();
  for (Eigen::Index i = 0; i < layout.columns.rows(); ++i)
    for (Eigen::Index d = 0; d < layout.columns.cols(); ++d) points(i + 1, d) = c[layout.columns(i, d)];
  BSpline spline;
  spline.setKnots(options_.degree, timesTo(komo_->slices() * komo_->tau(), options_.points));
  spline.setCtrlPoints(points, true, options_.ends_at_rest);
  return spline;
}

}  // namespace kinegraph
