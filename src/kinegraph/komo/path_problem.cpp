#include "kinegraph/komo/path_problem.h"

#include <algorithm>
#include <map>

namespace kinegraph {

namespace {

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// May the feature depend on which dofs there are, and so on the slice?
bool dependsOnDofs(const FeatureSource& feature) {
  return !feature.symbol() || feature == FeatureSymbol::jointLimits || feature == FeatureSymbol::qQuaternionNorms ||
         feature == FeatureSymbol::accumulatedCollisions || feature == FeatureSymbol::pairCollisions ||
         feature == FeatureSymbol::qItself;
}

}  // namespace

PathProblem::PathProblem(const Komo& komo, std::vector<Komo::Objective> objectives)
    : objectives_(std::move(objectives)), dimension_(komo.layout().dimension) {
  const PathLayout& layout = komo.layout();
  for (int t = -komo.order(); t < komo.slices(); ++t) widest_state_ = std::max(widest_state_, komo.state(t).dofs());
  std::size_t workspace = 0;
  for (std::size_t o = 0; o < objectives_.size(); ++o) {
    const Komo::Objective& objective = objectives_[o];
    const bool varies = !layout.plain && dependsOnDofs(objective.feature);
    std::map<const Program*, int> by_program;  // where nothing but the program matters
    for (int t = objective.from; t <= objective.to; ++t) {
      const bool owns = varies && objective.feature == FeatureSymbol::jointLimits;
      const Program* key = varies ? &komo.state(t).program() : nullptr;
      auto place = by_program.find(key);
      if (place == by_program.end() || owns) {
        residuals_.push_back(komo.residualIn(objective, t));
        place = by_program.insert_or_assign(key, int(residuals_.size()) - 1).first;
      }
      const int rows = residuals_[place->second].rows();
      terms_.push_back({int(o), t, place->second, int(types_.size()), rows, int(runs_.size()), 0});
      segments_.emplace_back();
      layOut(komo, terms_.back(), segments_.back());
      types_.insert(types_.end(), rows, objective.type);
      workspace = std::max(workspace, std::size_t(rows) * (objective.order + 1) * widest_state_);
    }
  }
  window_jacobian_.resize(workspace);
  window_.resize(std::size_t(komo.order()) + 1);
}

/// Finds which columns of x the window of slices touches, and where each of its own columns goes among them.
void PathProblem::layOut(const Komo& komo, Term& term, std::vector<std::pair<int, int>>& segments) {
  const int order = objectives_[term.objective].order, n = widest_state_;
  const PathLayout& layout = komo.layout();
  if (layout.plain) {
    const int first = std::max(term.slice - order, 0), width = (term.slice - first + 1) * n;
    if (width > 0) segments.push_back({first * n, width});
    runs_.push_back({(order + 1) * n - width, 0, width});
    term.runs = 1;
    return;
  }
  std::vector<std::pair<int, int>> places;  // column of x, column of the window
  for (int i = 0; i <= order; ++i) {
    const std::vector<int>& column = layout.column[term.slice - order + i + komo.order()];
    for (std::size_t d = 0; d < column.size(); ++d) {
      if (column[d] >= 0) places.push_back({column[d], i * n + int(d)});
    }
  }
  std::sort(places.begin(), places.end());
  std::map<int, int> offset;  // column of x -> place in the row
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
  auto place = std::upper_bound(terms_.begin(), terms_.end(), row, [](int r, const Term& term) { return r < term.first_row + term.rows; });
  return *place;
}

Jacobian PathProblem::makeJacobian() const {
  Jacobian J;
  J.columns = dimension_;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    for (int row = 0; row < terms_[i].rows; ++row) {
      for (const auto& [column, width] : segments_[i]) {
        J.segments.push_back({column, width, int(J.values.size())});
        J.values.resize(J.values.size() + width, 0.);
      }
      J.row_start.push_back(int(J.segments.size()));
    }
  }
  return J;
}

void PathProblem::evaluate(const Komo& komo, VectorXd& phi, Jacobian* J) {
  if (J) std::fill(J->values.begin(), J->values.end(), 0.);
  double* values = J ? J->values.data() : nullptr;
  for (std::size_t i = 0; i < terms_.size(); ++i) {
    const Term& term = terms_[i];
    if (term.rows == 0) continue;
    Residual& residual = residuals_[term.residual];
    const int order = residual.order(), window = (order + 1) * widest_state_;
    for (int s = 0; s <= order; ++s) window_[s] = &komo.state(term.slice - order + s);
    const std::span<const State* const> states{window_.data(), std::size_t(order) + 1};
    if (!J) {
      residual.eval(states, komo.tau(), phi.segment(term.first_row, term.rows), nullptr);
      continue;
    }
    int width = 0;
    for (const auto& segment : segments_[i]) width += segment.second;
    const Run& only = runs_[term.first_run];
    if (term.runs == 1 && only.width == window && width == window) {  // straight into the Jacobian
      JacobianRows block = Eigen::Map<RowMajor>(values, term.rows, window);
      residual.eval(states, komo.tau(), phi.segment(term.first_row, term.rows), &block);
    } else {
      Eigen::Map<RowMajor> whole(window_jacobian_.data(), term.rows, window);
      whole.setZero();
      JacobianRows block = whole;
      residual.eval(states, komo.tau(), phi.segment(term.first_row, term.rows), &block);
      Eigen::Map<RowMajor> target(values, term.rows, width);
      for (int r = term.first_run; r < term.first_run + term.runs; ++r) {
        target.middleCols(runs_[r].to, runs_[r].width) += whole.middleCols(runs_[r].from, runs_[r].width);
      }
    }
    values += std::ptrdiff_t(term.rows) * width;
  }
}

}  // namespace kinegraph
