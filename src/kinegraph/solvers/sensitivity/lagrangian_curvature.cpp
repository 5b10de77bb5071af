#include "kinegraph/solvers/sensitivity/lagrangian_curvature.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kStep = 3e-5;         // of central differences, whose error is its square
constexpr double kNegligible = 1e-14;  // smallest relevant weight, relative to the largest one

}  // namespace

LagrangianCurvature::LagrangianCurvature(Nlp& nlp) : nlp_(nlp), is_known_(nlp.types().size(), false) {
  for (const Nlp::CurvedRows& known : nlp.curvedRows())
    std::fill_n(is_known_.begin() + known.first, std::size_t(known.rows), true);
}

void LagrangianCurvature::addTo(BandAlgebra& H, const VectorXd& x, const VectorXd& weights, const Jacobian& J,
                                bool knows_costs) {
  addKnown(H, weights);
  const double least = kNegligible * weights.lpNorm<Eigen::Infinity>();
  unknown_.clear();
  for (int row = 0; row < int(weights.size()); ++row) {
    const bool is_known =
        is_known_[std::size_t(row)] || (knows_costs && nlp_.types()[std::size_t(row)] == ObjectiveType::f);
    if (is_known || nlp_.isLinear(row) || J.zero_row[std::size_t(row)] || std::abs(weights[row]) <= least) continue;
    unknown_.push_back(row);
  }
  if (!unknown_.empty()) addDifferences(H, x, weights, J);
}

void LagrangianCurvature::addKnown(BandAlgebra& H, const VectorXd& weights) {
  const auto known = nlp_.curvedRows();
  for (std::size_t k = 0; k < known.size(); ++k) {
    const auto own = weights.segment(known[k].first, known[k].rows);
    if (own.isZero(0.)) continue;
    block_.setZero(known[k].width, known[k].width);
    nlp_.addCurvature(int(k), {own.data(), std::size_t(own.size())}, block_);
    for (int j = 0; j < known[k].width; ++j) {
      for (int i = j; i < known[k].width; ++i) H.addEntry(known[k].column + i, known[k].column + j, block_(i, j));
    }
  }
}

/// Colors the variables greedily, so that variables with a common residual have different colors.
void LagrangianCurvature::color(const Jacobian& J) {
  std::vector<std::vector<int>> rows_of(std::size_t(J.columns));
  for (const int row : unknown_) {
    for (const Jacobian::Segment& segment : J.row_segments(row)) {
      for (int i = 0; i < segment.width; ++i) rows_of[std::size_t(segment.column + i)].push_back(row);
    }
  }
  std::vector<std::vector<char>> taken;  // per color and row
  color_.assign(std::size_t(J.columns), -1);
  for (std::size_t variable = 0; variable < rows_of.size(); ++variable) {
    if (rows_of[variable].empty()) continue;
    const auto isFree = [&](const std::vector<char>& rows) {
      return std::ranges::none_of(rows_of[variable], [&](int row) { return rows[std::size_t(row)]; });
    };
    auto place = std::ranges::find_if(taken, isFree);
    if (place == taken.end()) place = taken.insert(taken.end(), std::vector<char>(std::size_t(J.rows()), false));
    for (const int row : rows_of[variable]) (*place)[std::size_t(row)] = true;
    color_[variable] = int(place - taken.begin());
  }
  colors_ = int(taken.size());
}

void LagrangianCurvature::addDifferences(BandAlgebra& H, const VectorXd& x, const VectorXd& weights,
                                         const Jacobian& J) {
  color(J);
  if (moved_J_.rows() != J.rows()) moved_J_ = nlp_.makeJacobian();
  moved_phi_.resize(weights.size());
  for (int color = 0; color < colors_; ++color) {
    for (const double sign : {1., -1.}) {
      moved_x_ = x;
      for (int i = 0; i < J.columns; ++i) {
        if (color_[std::size_t(i)] == color) moved_x_[i] += sign * kStep;
      }
      nlp_.evaluate(moved_x_, moved_phi_, &moved_J_);
      for (const int row : unknown_) {
        const auto segments = moved_J_.row_segments(row);
        int moved = -1;
        for (const Jacobian::Segment& segment : segments) {
          for (int i = segment.column; i < segment.column + segment.width; ++i)
            moved = color_[std::size_t(i)] == color ? i : moved;
        }
        if (moved < 0) continue;
        const double factor = sign * weights[row] / (2. * kStep);
        for (const Jacobian::Segment& segment : segments) {
          for (int i = 0; i < segment.width; ++i) {
            const int other = segment.column + i;  // mean of both mixed derivatives
            const double value = factor * moved_J_.values[std::size_t(segment.offset + i)];
            H.addEntry(std::max(moved, other), std::min(moved, other), moved == other ? value : .5 * value);
          }
        }
      }
    }
  }
}

}  // namespace kinegraph::inline solvers_internal
