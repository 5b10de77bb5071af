#include "kinegraph/trajectory_optimization/spline_layout.h"

#include <algorithm>

#include "kinegraph/trajectory_optimization/motion_problems.h"

namespace kinegraph::inline trajectory_optimization_internal {

namespace {

/// Returns the entries of x of the initial configuration's dofs: slices x dofs.
Eigen::MatrixXi jointColumns(const Path& path) {
  Eigen::MatrixXi columns(path.grid().slices(), path.dofs());
  for (int slice = 0; slice < columns.rows(); ++slice) {
    const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, slice);
    for (int j = 0; j < columns.cols(); ++j) columns(slice, j) = columnOf(path, slice, dofs[std::size_t(j)]);
  }
  return columns;
}

/// Returns true if each slice has its own variable for the dof.
bool isOfEachSlice(const Eigen::MatrixXi& columns, int dof) {
  for (int slice = 0; slice < columns.rows(); ++slice)
    if (columns(slice, dof) < 0 || (slice > 0 && columns(slice, dof) == columns(slice - 1, dof))) return false;
  return true;
}

VectorXd timesTo(double end, int count) { return VectorXd::LinSpaced(count + 1, 0., end); }

BSpline knotsOf(const TimeGrid& grid, const SplineMotionOptions& options) {
  BSpline knots;
  knots.setKnots(options.degree, timesTo(grid.slices() * grid.tau(), options.points));
  return knots;
}

/// An entry of c: a coordinate of a control point, or a variable of x.
struct Variable {
  double slice;
  int point, dof, column;  ///< number of the control point, splined dof, entry of x with its limits
};

/// Returns the variables in order of time, so that related ones are close in c.
std::vector<Variable> variablesOf(const Path& path, const std::vector<int>& splined, const Eigen::MatrixXi& columns,
                                  int points) {
  const int slices = path.grid().slices();
  std::vector<char> is_listed(std::size_t(path.layout().dimension), 0);
  for (const int j : splined)
    for (int slice = 0; slice < slices; ++slice) is_listed[std::size_t(columns(slice, j))] = 1;
  std::vector<Variable> variables;
  for (int i = 0; i < points; ++i)
    for (std::size_t d = 0; d < splined.size(); ++d)
      variables.push_back({(i + 1.) * slices / points - .5, i, int(d), columns(0, splined[d])});
  for (int slice = 0; slice < slices; ++slice) {
    const int dofs = path.state(slice).dofs();
    for (int dof = 0; dof < dofs; ++dof) {
      const int column = columnOf(path, slice, dof);
      if (column < 0 || is_listed[std::size_t(column)]) continue;
      is_listed[std::size_t(column)] = 1;  // shared variables occur once
      variables.push_back({double(slice), -1, -1, column});
    }
  }
  std::ranges::stable_sort(variables, {}, &Variable::slice);
  return variables;
}

VectorXd startOf(const Path& path, const std::vector<int>& splined) {
  const std::vector<int> dofs = path.dofsOf(path.initial().joint_frames, -1);
  VectorXd start(Eigen::Index(splined.size()));
  for (std::size_t d = 0; d < splined.size(); ++d)
    start[Eigen::Index(d)] = path.state(-1).q()[dofs[std::size_t(splined[d])]];
  return start;
}

}  // namespace

int columnOf(const Path& path, int slice, int dof) {
  const PathLayout& layout = path.layout();
  if (layout.plain) return slice < 0 ? -1 : slice * path.state(0).dofs() + dof;
  return layout.column[std::size_t(slice + path.grid().order())][std::size_t(dof)];
}

MatrixXd splineBasis(const TimeGrid& grid, const SplineMotionOptions& options) {
  const int slices = grid.slices();
  return knotsOf(grid, options)
      .getBmatrix(timesTo(slices * grid.tau(), slices).tail(slices), true, options.ends_at_rest);
}

MatrixXd SplineLayout::pointsOf(const VectorXd& c) const {
  MatrixXd points(columns.rows() + 1, columns.cols());
  points.row(0) = start.transpose();
  for (Eigen::Index d = 0; d < columns.cols(); ++d)
    for (Eigen::Index i = 0; i < columns.rows(); ++i) points(i + 1, d) = c[columns(i, d)];
  return points;
}

BSpline SplineLayout::splineOf(const VectorXd& c) const {
  BSpline spline = knots;
  spline.setCtrlPoints(pointsOf(c), true, ends_at_rest);
  return spline;
}

VectorXd SplineLayout::weightsAt(double time) const {
  return knots.getBmatrix(VectorXd::Constant(1, time), true, ends_at_rest).row(0).transpose();
}

SplineLayout layOutSpline(const Path& path, const SplineMotionOptions& options) {
  const int slices = path.grid().slices();
  const MatrixXd B = splineBasis(path.grid(), options);
  const int points = int(B.cols()) - 1;  // the first one is the start
  const Eigen::MatrixXi columns = jointColumns(path);
  SplineLayout layout;
  layout.map = std::make_shared<LinearMap>();
  layout.knots = knotsOf(path.grid(), options);
  layout.ends_at_rest = options.ends_at_rest;
  for (int j = 0; j < columns.cols(); ++j)
    if (isOfEachSlice(columns, j)) layout.splined.push_back(j);
  layout.start = startOf(path, layout.splined);
  const std::vector<Variable> variables = variablesOf(path, layout.splined, columns, points);
  const auto count = Eigen::Index(variables.size());
  layout.lower.resize(count), layout.upper.resize(count);
  layout.columns.resize(points, Eigen::Index(layout.splined.size()));
  std::vector<Eigen::Triplet<double>> entries;
  for (int c = 0; c < int(count); ++c) {
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
  layout.map->M.resize(path.layout().dimension, count);
  layout.map->M.setFromTriplets(entries.begin(), entries.end());
  layout.map->offset.setZero(path.layout().dimension);
  for (std::size_t d = 0; d < layout.splined.size(); ++d)
    for (int slice = 0; slice < slices; ++slice)
      layout.map->offset[columns(slice, layout.splined[d])] = B(slice, 0) * layout.start[Eigen::Index(d)];
  return layout;
}

}  // namespace kinegraph::inline trajectory_optimization_internal
