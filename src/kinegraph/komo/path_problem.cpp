#include "kinegraph/komo/path_problem.h"

#include <algorithm>
#include <cstring>
#include <map>
#include <optional>

#include "kinegraph/features/residual.h"

namespace kinegraph::inline komo_internal {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

constexpr int kEight = 8;

bool areAllZeroRows(const char* eight) {
  static constexpr char all[kEight] = {1, 1, 1, 1, 1, 1, 1, 1};
  return std::memcmp(eight, all, kEight) == 0;
}

/// Returns true if the feature may depend on the dofs of the model, and so on the slice.
bool dependsOnDofs(const FeatureSource& feature) {
  return !feature.symbol() || featureInfo(*feature.symbol()).dofs != FeatureDofs::of_frames;
}

}  // namespace

PathProblem::PathProblem(const Path& path, const Contacts& contacts, std::vector<Objective> objectives)
    : objectives_(std::move(objectives)), dimension_(path.layout().dimension) {
  const PathLayout& layout = path.layout();
  for (int t = -path.grid().order(); t < path.grid().slices(); ++t)
    widest_state_ = std::max(widest_state_, path.state(t).dofs());
  std::size_t terms = 0;
  for (const Objective& objective : objectives_) terms += std::size_t(std::max(objective.to - objective.from + 1, 0));
  terms_.reserve(terms);
  segments_.reserve(terms);
  width_.reserve(terms);
  runs_.reserve(terms);
  residuals_.reserve(objectives_.size());
  for (std::size_t o = 0; o < objectives_.size(); ++o) {
    const Objective& objective = objectives_[o];
    const bool varies = !layout.plain && dependsOnDofs(objective.feature);
    std::map<const KinematicModel*, int> by_model;  // shares residuals that depend on the model only
    for (int t = objective.from; t <= objective.to; ++t) {
      const bool owns = objective.between_slices || (varies && objective.feature == FeatureSymbol::jointLimits);
      const KinematicModel* key = varies ? &path.state(t).model() : nullptr;
      auto place = by_model.find(key);
      if (place == by_model.end() || owns) {
        residuals_.push_back(residualIn(objective, path, contacts.forces(), t));
        place = by_model.insert_or_assign(key, int(residuals_.size()) - 1).first;
      }
      const int rows = residuals_[place->second].rows();
      terms_.push_back({int(o), t, place->second, int(types_.size()), rows, int(runs_.size()), 0, 0});
      segments_.emplace_back();
      layOut(path, terms_.back(), segments_.back());
      width_.push_back(0);
      for (const auto& segment : segments_.back()) width_.back() += segment.second;
      types_.insert(types_.end(), rows, objective.type);
    }
  }
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    if (!storesAllRows(terms_[i])) stored_ = std::max(stored_, width_[i]);
  }
  for (const bool linear : {true, false}) {
    for (std::size_t i = 0; i < terms_.size(); ++i) {
      Term& term = terms_[i];
      const Residual& residual = residuals_[std::size_t(term.residual)];
      if (residual.isLinear() != linear) continue;
      term.first_value = stored_;
      if (storesAllRows(term)) stored_ += term.rows * width_[i];
    }
    if (linear) constant_ = stored_;
  }
  findCurvedRows(path);
  workspace_ = makeWorkspace();
}

/// Finds the terms of a single slice whose variables are the joints in their order.
void PathProblem::findCurvedRows(const Path& path) {
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    const State& state = path.state(term.slice);
    if (term.rows == 0 || term.slice < 0 || !residuals_[std::size_t(term.residual)].hasCurvature(state)) continue;
    const Run* const run = term.runs == 1 ? &runs_[std::size_t(term.first_run)] : nullptr;
    if (!run || segments_[i].size() != 1 || run->from != 0 || run->to != 0 || run->width != state.dofs() ||
        width_[i] != state.dofs())
      continue;
    curved_rows_.push_back({term.first_row, term.rows, segments_[i][0].first, width_[i]});
    curved_terms_.push_back(int(i));
  }
}

PathProblem::Workspace PathProblem::makeWorkspace() const {
  std::size_t entries = 0, zeros = 0, rows = 0, slices = 1;
  for (const Term& term : terms_) {
    const auto window = std::size_t(objectives_[std::size_t(term.objective)].order) + 1;
    const std::size_t size = std::size_t(term.rows) * window * std::size_t(widest_state_);
    slices = std::max(slices, window);
    entries = std::max(entries, size);
    if (storesAllRows(term)) continue;
    zeros = std::max(zeros, size);
    rows = std::max(rows, std::size_t(term.rows));
  }
  return {std::vector<double>(entries), std::vector<double>(zeros), std::vector<char>(rows),
          std::vector<const State*>(slices)};
}

/// Finds the columns of x that the window of slices uses, and the position of each window column among them.
void PathProblem::layOut(const Path& path, Term& term, std::vector<std::pair<int, int>>& segments) {
  const int order = objectives_[term.objective].order, n = widest_state_;
  const PathLayout& layout = path.layout();
  if (layout.plain) {
    const int first = std::max(term.slice - order, 0), width = (term.slice - first + 1) * n;
    if (width > 0) segments.push_back({first * n, width});
    runs_.push_back({(order + 1) * n - width, 0, width});
    term.runs = 1;
    return;
  }
  std::vector<std::pair<int, int>> places;  // column of x, column of the window
  for (int i = 0; i <= order; ++i) {
    const std::vector<int>& column = layout.column[term.slice - order + i + path.grid().order()];
    for (std::size_t d = 0; d < column.size(); ++d) {
      if (column[d] >= 0) places.push_back({column[d], i * n + int(d)});
    }
  }
  std::sort(places.begin(), places.end());
  std::map<int, int> offset;  // column of x -> position in the row
  for (const auto& [column, from] : places) {
    if (offset.contains(column)) continue;
    offset[column] = int(offset.size());
    if (!segments.empty() && segments.back().first + segments.back().second == column) {
      ++segments.back().second;
    } else {
      segments.push_back({column, 1});
    }
  }
  std::sort(places.begin(), places.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  for (const auto& [column, from] : places) {
    const int to = offset[column];
    if (term.runs > 0 && runs_.back().from + runs_.back().width == from && runs_.back().to + runs_.back().width == to) {
      ++runs_.back().width;
    } else {
      runs_.push_back({from, to, 1});
      ++term.runs;
    }
  }
}

const PathProblem::Term& PathProblem::termOf(int row) const {
  auto place = std::upper_bound(terms_.begin(), terms_.end(), row,
                                [](int r, const Term& term) { return r < term.first_row + term.rows; });
  return *place;
}

bool PathProblem::isLinear() const {
  return std::all_of(residuals_.begin(), residuals_.end(),
                     [](const Residual& residual) { return residual.isLinear(); });
}

std::vector<char> PathProblem::linearRows() const {
  std::vector<char> linear;
  linear.reserve(types_.size());
  for (const Term& term : terms_)
    linear.insert(linear.end(), std::size_t(term.rows), residuals_[std::size_t(term.residual)].isLinear());
  return linear;
}

/// The order of values: zeros shared by all zero rows, linear rows, other rows that are always stored, and finally
/// sparse rows (evaluateSparse).
Jacobian PathProblem::makeJacobian(const Path& path) const {
  std::size_t segments = 0, values = std::size_t(stored_);
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    segments += std::size_t(terms_[i].rows) * segments_[i].size();
    if (!storesAllRows(terms_[i])) values += std::size_t(terms_[i].rows * width_[i]);
  }
  Jacobian J;
  J.columns = dimension_;
  J.row_start.reserve(std::size_t(rows()) + 1);
  J.zero_row.reserve(std::size_t(rows()));
  J.segments.reserve(segments);
  J.values.reserve(values);
  J.values.resize(std::size_t(stored_));
  J.constant = constant_;
  Workspace workspace = makeWorkspace();
  VectorXd phi(rows());
  int copied = -1;
  std::optional<Residual> residual;  // a copy with its own workspace
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    const bool is_stored = storesAllRows(term);
    for (int row = 0; row < term.rows; ++row) {
      int offset = is_stored ? term.first_value + row * width_[i] : 0;
      for (const auto& [column, width] : segments_[i]) {
        J.segments.push_back({column, width, offset});
        offset += width;
      }
      J.row_start.push_back(int(J.segments.size()));
      J.zero_row.push_back(!is_stored);
    }
    if (!residuals_[std::size_t(term.residual)].isLinear() || term.rows == 0) continue;
    if (copied != term.residual) residual.emplace(residuals_[std::size_t(copied = term.residual)]);
    evaluateTerm(path, i, *residual, phi.segment(term.first_row, term.rows), J.values.data() + term.first_value,
                 workspace);
  }
  return J;
}

std::span<const State* const> PathProblem::statesOf(const Path& path, const Term& term, Workspace& workspace) const {
  const int order = objectives_[std::size_t(term.objective)].order;
  for (int s = 0; s <= order; ++s) workspace.window[std::size_t(s)] = &path.state(term.slice - order + s);
  return {workspace.window.data(), std::size_t(order) + 1};
}

/// `jacobian` may be null; otherwise it points to the rows of this term, filled with zeros.
void PathProblem::evaluateTerm(const Path& path, std::size_t index, Residual& residual, Eigen::Ref<VectorXd> phi,
                               double* jacobian, Workspace& workspace) const {
  const Term& term = terms_[index];
  const std::span<const State* const> states = statesOf(path, term, workspace);
  const int columns = int(states.size()) * widest_state_, width = width_[index];
  if (!jacobian) return residual.eval(states, path.grid().tau(), phi, nullptr);
  const Run& only = runs_[std::size_t(term.first_run)];
  if (term.runs == 1 && only.width == columns && width == columns) {  // writes directly into the Jacobian
    JacobianRows block = Eigen::Map<RowMajor>(jacobian, term.rows, columns);
    return residual.eval(states, path.grid().tau(), phi, &block);
  }
  Eigen::Map<RowMajor> whole(workspace.jacobian.data(), term.rows, columns);
  whole.setZero();
  JacobianRows block = whole;
  residual.eval(states, path.grid().tau(), phi, &block);
  Eigen::Map<RowMajor> target(jacobian, term.rows, width);
  for (int r = term.first_run; r < term.first_run + term.runs; ++r) {
    const Run& run = runs_[std::size_t(r)];
    target.middleCols(run.to, run.width) += whole.middleCols(run.from, run.width);
  }
}

/// Appends the nonzero rows of this term to the values.
void PathProblem::evaluateSparse(const Path& path, std::size_t index, VectorXd& phi, Jacobian& J) {
  const Term& term = terms_[index];
  const std::span<const State* const> states = statesOf(path, term, workspace_);
  Eigen::Map<RowMajor> whole(workspace_.zeros.data(), term.rows, Eigen::Index(states.size()) * widest_state_);
  JacobianRows block = whole;
  residuals_[std::size_t(term.residual)].eval(states, path.grid().tau(), phi.segment(term.first_row, term.rows), &block,
                                              workspace_.zero_row.data());
  const char *now = workspace_.zero_row.data(), *before = J.zero_row.data() + term.first_row;
  for (int i = 0; i < term.rows; ++i) {
    while (i + kEight <= term.rows && areAllZeroRows(now + i) && areAllZeroRows(before + i)) i += kEight;
    if (i == term.rows) break;
    const int row = term.first_row + i;
    const bool is_zero = now[i];
    if (is_zero && before[i]) continue;
    J.zero_row[std::size_t(row)] = is_zero;
    int offset = is_zero ? 0 : int(J.values.size());
    for (int s = J.row_start[std::size_t(row)]; s < J.row_start[std::size_t(row) + 1]; ++s) {
      J.segments[std::size_t(s)].offset = offset;
      offset += J.segments[std::size_t(s)].width;
    }
    if (is_zero) continue;
    J.values.resize(std::size_t(offset));
    double* values = J.values.data() + offset - width_[index];
    for (int r = term.first_run; r < term.first_run + term.runs; ++r) {
      const Run& run = runs_[std::size_t(r)];
      Eigen::Map<Eigen::RowVectorXd>(values + run.to, run.width) += whole.row(i).segment(run.from, run.width);
    }
    whole.row(i).setZero();
  }
}

void PathProblem::evaluate(const Path& path, std::size_t index, VectorXd& phi, Jacobian* J) {
  const Term& term = terms_[index];
  if (term.rows == 0) return;
  Residual& residual = residuals_[std::size_t(term.residual)];
  if (J && !storesAllRows(term)) return evaluateSparse(path, index, phi, *J);
  double* values = J && !residual.isLinear() ? J->values.data() + term.first_value : nullptr;
  if (values) std::fill_n(values, std::ptrdiff_t(term.rows) * width_[index], 0.);
  evaluateTerm(path, index, residual, phi.segment(term.first_row, term.rows), values, workspace_);
}

void PathProblem::evaluate(const Path& path, VectorXd& phi, Jacobian* J) {
  if (J) J->values.resize(std::size_t(stored_));
  for (std::size_t i = 0; i < terms_.size(); ++i) evaluate(path, i, phi, J);
}

void PathProblem::evaluateTerms(const Path& path, std::span<const int> terms, VectorXd& phi, Jacobian* J) {
  const auto is_sparse = [&](int term) { return !storesAllRows(terms_[std::size_t(term)]); };
  if (J && std::ranges::any_of(terms, is_sparse)) J->values.resize(std::size_t(stored_));
  for (const int term : terms) evaluate(path, std::size_t(term), phi, J);
}

void PathProblem::setSamples(const Path& path, const Contacts& contacts, const Term& term,
                             std::vector<CollisionSample> samples) {
  Objective& objective = objectives_[std::size_t(term.objective)];
  objective.samples[std::size_t(term.slice - objective.from)] = std::move(samples);
  residuals_[std::size_t(term.residual)] = residualIn(objective, path, contacts.forces(), term.slice);
}

void PathProblem::addCurvature(const Path& path, int k, std::span<const double> weights, Eigen::Ref<MatrixXd> H) {
  const Term& term = terms_[std::size_t(curved_terms_[std::size_t(k)])];
  residuals_[std::size_t(term.residual)].addCurvature(path.state(term.slice), weights, H);
}

}  // namespace kinegraph::inline komo_internal
