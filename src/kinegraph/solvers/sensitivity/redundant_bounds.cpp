#include "kinegraph/solvers/sensitivity/redundant_bounds.h"

#include <algorithm>
#include <cmath>

namespace kinegraph::inline solvers_internal {

namespace {

constexpr double kApart = 1e-9;  // relative difference of motions that count as equal

bool has(const std::vector<int>& sorted, int number) { return std::ranges::binary_search(sorted, number); }

/// Calls `visit(column, value)` for the nonzeros of a row.
template <class Visit>
void visitRow(const Jacobian& J, int row, const Visit& visit) {
  if (J.zero_row[std::size_t(row)]) return;
  for (const Jacobian::Segment& segment : J.row_segments(row)) {
    for (int i = 0; i < segment.width; ++i) {
      const double value = J.values[std::size_t(segment.offset + i)];
      if (value != 0.) visit(segment.column + i, value);
    }
  }
}

void insert(std::vector<int>& sorted, int number) { sorted.insert(std::ranges::lower_bound(sorted, number), number); }

/// Moves the numbers that `leaves` selects from one list to another.
template <class Leaves>
void moveSome(std::vector<int>& from, std::vector<int>& to, const Leaves& leaves) {
  for (const int number : from) {
    if (leaves(number)) insert(to, number);
  }
  std::erase_if(from, leaves);
}

}  // namespace

RedundantBounds::RedundantBounds(PolishedSolution& at) : is_held_(at.fixed), pin_(at.fixed.size(), -1) {
  for (const int i : at.weak_lower) is_held_[std::size_t(i)] = false;
  for (const int i : at.weak_upper) is_held_[std::size_t(i)] = false;
  for (const int row : at.active) {
    if (has(at.weak_rows, row)) continue;
    int free = 0, last = -1;
    visitRow(at.J, row, [&](int column, double) {
      if (is_held_[std::size_t(column)]) return;
      ++free;
      last = column;
    });
    if (free == 1) pin_[std::size_t(last)] = row;
  }
  const auto isPinned = [&](int i) { return pin_[std::size_t(i)] >= 0; };
  moveSome(at.weak_rows, rows_, [&](int row) {
    bool is_free = false;
    visitRow(at.J, row,
             [&](int column, double) { is_free = is_free || (!is_held_[std::size_t(column)] && !isPinned(column)); });
    return !is_free;
  });
  moveSome(at.weak_lower, lower_, isPinned);
  moveSome(at.weak_upper, upper_, isPinned);
}

double RedundantBounds::motionOf(const PolishedSolution& at, int variable, const VectorXd& dphi) const {
  if (is_held_[std::size_t(variable)]) return variable == moved_ ? 1. : 0.;
  const int row = pin_[std::size_t(variable)];
  double others = dphi[row], own = 1.;
  visitRow(at.J, row, [&](int column, double value) {
    if (column == variable) {
      own = value;
    } else {
      others += value * motionOf(at, column, dphi);
    }
  });
  return -others / own;
}

void RedundantBounds::move(PolishedSolution& at, const Nlp& nlp, const VectorXd& dphi,
                           const std::optional<NlpParameter::Bound>& bound) {
  moved_ = -1;
  if (bound && at.x[bound->variable] == (bound->is_upper ? nlp.upper() : nlp.lower())[bound->variable])
    moved_ = bound->variable;
  moveSome(rows_, at.weak_rows, [&](int row) {
    double change = dphi[row], size = 0.;
    visitRow(at.J, row, [&](int column, double value) {
      change += value * motionOf(at, column, dphi);
      size = std::max(size, std::abs(value));
    });
    return std::abs(change) > kApart * std::max(size, std::abs(dphi[row]));
  });
  for (const bool is_upper : {false, true}) {
    moveSome(is_upper ? upper_ : lower_, is_upper ? at.weak_upper : at.weak_lower, [&](int i) {
      const double own = bound && bound->variable == i && bound->is_upper == is_upper ? 1. : 0.;
      return std::abs(motionOf(at, i, dphi) - own) > kApart;
    });
  }
}

}  // namespace kinegraph::inline solvers_internal
