// The kernel of jerk_limited_kernel.h for registers of `kLanes` doubles. Each including source file is compiled for its
// own instruction set; all names are local to it.

#include "kinegraph/math/lane_math.h"
#include "kinegraph/trajectories/jerk_limited_kernel.h"

namespace kinegraph::lanes {

namespace {

using Lane = Pack<kLanes>;
using Rows = JerkLimitedKernel::Rows;
using Block = JerkLimitedKernel::Block;
using Coefficients = JerkLimitedKernel::Coefficients;

enum class Root { none, at_begin, at_end };

Lane from(const double* numbers) {
  Lane pack;
  __builtin_memcpy(&pack, numbers, sizeof(Lane));
  return pack;
}
void to(double* numbers, Lane pack) { __builtin_memcpy(numbers, &pack, sizeof(Lane)); }

/// b and, at both ends, 1 / sqrt(b) of kLanes intervals.
struct Place {
  Lane b[3], roots[2];

  Place(const Coefficients& of, const double* of_roots, int k)
      : b{from(of.knots + k), from(of.middle + k), from(of.knots + k + 1)},
        roots{from(of_roots + k), from(of_roots + k + 1)} {}
};

/// r b + offset, its limit, and the negative derivative of the limit by the coefficient under the root.
struct Value {
  Lane value, size, falls;
};

template <Root kRoot>
[[gnu::always_inline]] inline Value valueOf(const Rows& rows, int i, const Place& at) {
  Value row{from(rows.r[0] + i) * at.b[0] + from(rows.r[1] + i) * at.b[1] + from(rows.r[2] + i) * at.b[2] +
                from(rows.offset + i),
            from(rows.size + i), Lane{}};
  if constexpr (kRoot != Root::none) {
    const Lane root = at.roots[kRoot == Root::at_begin ? 0 : 1];
    row.size = row.size * root;
    row.falls = .5 * row.size * root * root;
  }
  return row;
}

template <Root kRoot>
[[gnu::always_inline]] inline void beginRows(Rows& rows, int i, const Place& at, double barrier, double least) {
  const Value row = valueOf<kRoot>(rows, i, at);
  for (int side = 0; side < 2; ++side) {
    const Lane slack = larger(row.size + (side == 0 ? -row.value : row.value), all<Lane>(least));
    to(rows.slack[side] + i, slack);
    to(rows.dual[side] + i, barrier / slack);
  }
}

/// Sums over the rows of kLanes intervals.
struct RowTotals {
  Lane slope[3]{}, by_barrier[3]{}, matrix[6]{}, gap{}, violation{};
};

/// Adds slope a and weight a a^T for both sides (a, weight, slope) of each row, with a = +-r + falls e.
template <Root kRoot>
[[gnu::always_inline]] inline void takeRows(Rows& rows, int i, const Place& at, double slack_share, double dual_share,
                                            RowTotals& sum) {
  const Value row = valueOf<kRoot>(rows, i, at);
  Lane weight[2], slope[2], inverse[2];
  for (int side = 0; side < 2; ++side) {
    const Lane h = (side == 0 ? row.value : -row.value) - row.size;
    // the tangent lies below the limit, so the slack of the limit is at least as large
    const Lane slack = larger(from(rows.slack[side] + i) + slack_share * from(rows.slack_step[side] + i), -h);
    const Lane dual = from(rows.dual[side] + i) + dual_share * from(rows.dual_step[side] + i);
    to(rows.slack[side] + i, slack);
    to(rows.dual[side] + i, dual);
    sum.gap += slack * dual;
    sum.violation = larger(sum.violation, h);
    inverse[side] = 1. / slack;
    weight[side] = dual * inverse[side];
    slope[side] = weight[side] * (h + slack);
  }
  const Lane r[3] = {from(rows.r[0] + i), from(rows.r[1] + i), from(rows.r[2] + i)};
  const Lane both = weight[0] + weight[1], difference = slope[0] - slope[1],
             barrier_difference = inverse[0] - inverse[1];
  for (int x = 0, place = 0; x < 3; ++x) {
    sum.slope[x] += difference * r[x];
    sum.by_barrier[x] += barrier_difference * r[x];
    const Lane weighted = both * r[x];
    for (int y = 0; y <= x; ++y) sum.matrix[place++] += weighted * r[y];
  }
  if constexpr (kRoot != Root::none) {
    constexpr int kEnd = kRoot == Root::at_begin ? 0 : 2;
    sum.slope[kEnd] += (slope[0] + slope[1]) * row.falls;
    sum.by_barrier[kEnd] += (inverse[0] + inverse[1]) * row.falls;
    const Lane mixed = (weight[0] - weight[1]) * row.falls;
    sum.matrix[kEnd == 0 ? 0 : 5] += 2. * mixed * r[kEnd] + both * row.falls * row.falls;
    sum.matrix[kEnd == 0 ? 1 : 4] += mixed * r[1];
    sum.matrix[3] += mixed * r[2 - kEnd];
  }
}

template <Root kRoot>
[[gnu::always_inline]] inline void findRowSteps(Rows& rows, int i, const Place& at, const Lane* step, double barrier,
                                                Lane& slack_falls, Lane& dual_falls) {
  const Value row = valueOf<kRoot>(rows, i, at);
  const Lane change = from(rows.r[0] + i) * step[0] + from(rows.r[1] + i) * step[1] + from(rows.r[2] + i) * step[2];
  Lane of_size{};
  if constexpr (kRoot != Root::none) of_size = row.falls * step[kRoot == Root::at_begin ? 0 : 2];
  for (int side = 0; side < 2; ++side) {
    const Lane slack = from(rows.slack[side] + i), dual = from(rows.dual[side] + i);
    const Lane both = 1. / (slack * dual), of_slack = dual * both, of_dual = slack * both;
    const Lane h = (side == 0 ? row.value : -row.value) - row.size;
    const Lane by = -(h + slack) - (side == 0 ? change : -change) - of_size;
    const Lane dual_by = barrier * of_slack - dual - dual * of_slack * by;
    to(rows.slack_step[side] + i, by);
    to(rows.dual_step[side] + i, dual_by);
    slack_falls = larger(slack_falls, -by * of_slack);
    dual_falls = larger(dual_falls, -dual_by * of_dual);
  }
}

/// Calls visit.operator()<root>(rows) for all rows of a block.
template <class Visit>
[[gnu::always_inline]] inline void forRows(const Block& block, const Visit& visit) {
  Rows* rows = block.rows;
  for (int r = 0; r < block.plain; ++r) visit.template operator()<Root::none>(*rows++);
  for (int r = 0; r < block.at_begin; ++r) visit.template operator()<Root::at_begin>(*rows++);
  for (int r = 0; r < block.at_end; ++r) visit.template operator()<Root::at_end>(*rows++);
}

void beginAll(const Coefficients& b, const double* roots, const Block* blocks, int count, double barrier,
              double least) {
  for (int n = 0; n < count; ++n) {
    for (int i = 0; i < JerkLimitedKernel::kLanes; i += kLanes) {
      const Place at(b, roots, blocks[n].first + i);
      forRows(blocks[n], [&]<Root kRoot>(Rows& rows) { beginRows<kRoot>(rows, i, at, barrier, least); });
    }
  }
}

void takeAll(const Coefficients& b, const double* roots, const Block* blocks, int count, double slack_share,
             double dual_share, JerkLimitedKernel::Sums& sums) {
  for (int n = 0; n < count; ++n) {
    for (int i = 0; i < JerkLimitedKernel::kLanes; i += kLanes) {
      const int k = blocks[n].first + i;
      const Place at(b, roots, k);
      RowTotals sum;
      sum.gap = from(sums.gap + i), sum.violation = from(sums.violation + i);
      forRows(blocks[n], [&]<Root kRoot>(Rows& rows) { takeRows<kRoot>(rows, i, at, slack_share, dual_share, sum); });
      to(sums.gap + i, sum.gap), to(sums.violation + i, sum.violation);
      for (int x = 0; x < 3; ++x) {
        to(sums.slope[x] + k, from(sums.slope[x] + k) + sum.slope[x]);
        to(sums.slope_by_barrier[x] + k, from(sums.slope_by_barrier[x] + k) + sum.by_barrier[x]);
      }
      for (int m = 0; m < 6; ++m) to(sums.matrix[m] + k, from(sums.matrix[m] + k) + sum.matrix[m]);
    }
  }
}

void findAllSteps(const Coefficients& b, const double* roots, const Coefficients& step, const Block* blocks, int count,
                  double barrier, JerkLimitedKernel::Falls& falls) {
  for (int n = 0; n < count; ++n) {
    for (int i = 0; i < JerkLimitedKernel::kLanes; i += kLanes) {
      const int k = blocks[n].first + i;
      const Place at(b, roots, k);
      const Lane by[3] = {from(step.knots + k), from(step.middle + k), from(step.knots + k + 1)};
      Lane slack = from(falls.slack + i), dual = from(falls.dual + i);
      forRows(blocks[n], [&]<Root kRoot>(Rows& rows) { findRowSteps<kRoot>(rows, i, at, by, barrier, slack, dual); });
      to(falls.slack + i, slack), to(falls.dual + i, dual);
    }
  }
}

constexpr JerkLimitedKernel kKernel = {beginAll, takeAll, findAllSteps};

}  // namespace

}  // namespace kinegraph::lanes
