#include "kinegraph/ik/damped_rows.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinegraph/common/random.h"
#include "kinegraph/ik/damped_step.h"

namespace kinegraph::lanes {
namespace {

/// Two problems of one size, with limits, some of them active, and longest steps.
struct Problems {
  int rows, variables;
  std::vector<double> J[2], e[2], x[2];
  std::vector<double> lower, upper, longest;
};

Problems draw(Rng& rng, int rows, int variables) {
  Problems p{rows, variables, {}, {}, {}, {}, {}, {}};
  for (int v = 0; v < variables; ++v) {
    p.lower.push_back(-1. - rng.uniform());
    p.upper.push_back(1. + rng.uniform());
    p.longest.push_back(v % 3 == 2 ? std::numeric_limits<double>::infinity() : .2 + rng.uniform());
  }
  for (int lane = 0; lane < 2; ++lane) {
    for (int i = 0; i < rows * variables; ++i) p.J[lane].push_back(rng.normal());
    for (int r = 0; r < rows; ++r) p.e[lane].push_back(rng.normal());
    for (int v = 0; v < variables; ++v)
      p.x[lane].push_back(v % 2 == 0  ? rng.uniform(-1., 1.)
                          : lane == 0 ? p.lower[std::size_t(v)]
                                      : p.upper[std::size_t(v)]);
  }
  return p;
}

/// Returns the ends of the steps; `lanes` assigns problems to lanes.
std::vector<Pack<2>> nextInLanes(const Problems& p, const int (&lanes)[2], double damping) {
  const auto pack = [&](const std::vector<double>(&numbers)[2]) {
    std::vector<Pack<2>> packs;
    for (std::size_t i = 0; i < numbers[0].size(); ++i)
      packs.push_back(Pack<2>{numbers[lanes[0]][i], numbers[lanes[1]][i]});
    return packs;
  };
  const auto J = pack(p.J), e = pack(p.e), x = pack(p.x);
  std::vector<Pack<2>> keep(x.size()), next(x.size()), A(e.size() * e.size()), y(e.size()), pivots(e.size());
  const DampedRows<Pack<2>> rows{p.rows,      p.variables,    J.data(),       e.data(),         nullptr,
                                 x.data(),    p.lower.data(), p.upper.data(), p.longest.data(), keep.data(),
                                 next.data(), A.data(),       y.data(),       pivots.data()};
  dampedStep(rows, all<Pack<2>>(damping));
  return next;
}

TEST(DampedRows, ALaneDoesNotDependOnItsNeighborNorOnItsPlace) {
  Rng rng(1);
  for (const auto& [rows, variables] : {std::pair(3, 7), {6, 7}, {6, 3}, {5, 9}, {9, 12}}) {
    const Problems p = draw(rng, rows, variables);
    const auto both = nextInLanes(p, {0, 1}, .1), first = nextInLanes(p, {0, 0}, .1),
               swapped = nextInLanes(p, {1, 0}, .1);
    for (std::size_t v = 0; v < both.size(); ++v) {
      EXPECT_EQ(both[v][0], first[v][1]);
      EXPECT_EQ(both[v][0], swapped[v][1]);
      EXPECT_EQ(both[v][1], swapped[v][0]);
    }
  }
}

TEST(DampedRows, LanesAndSingleNumbersAgreeToRounding) {
  Rng rng(2);
  for (const auto& [rows, variables] : {std::pair(3, 7), {6, 7}, {6, 3}, {5, 9}, {9, 12}}) {
    const Problems p = draw(rng, rows, variables);
    const auto packs = nextInLanes(p, {0, 1}, .1);
    for (int lane = 0; lane < 2; ++lane) {
      DampedStep step;
      step.resize(rows, variables);
      for (int i = 0; i < rows * variables; ++i) step.column(0)[i] = p.J[lane][std::size_t(i)];
      for (int r = 0; r < rows; ++r) step.error(r) = p.e[lane][std::size_t(r)];
      step.solve(p.x[lane].data(), p.lower.data(), p.upper.data(), p.longest.data(), .1, nullptr);
      for (int v = 0; v < variables; ++v)
        EXPECT_NEAR(p.x[lane][std::size_t(v)] + step.step()[v], packs[std::size_t(v)][lane], 1e-12);
    }
  }
}

TEST(DampedRows, DampingGrowsWithWhatIsMissedUpToALimit) {
  EXPECT_EQ(dampingOf(0.), DampedStep::damping(0.));
  EXPECT_LT(dampingOf(0.), 1e-8);
  double before = 0.;
  for (const double square : {0., 1e-6, 1e-3, 1., 9.}) {
    EXPECT_GT(dampingOf(square), before);
    before = dampingOf(square);
    EXPECT_EQ(dampingOf(all<Pack<2>>(square))[1], before);
  }
  EXPECT_EQ(dampingOf(11.), dampingOf(1e300));
}

}  // namespace
}  // namespace kinegraph::lanes
