#include "kinegraph/solvers/methods/penalty.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(Penalty, GrowsByItsFactorUpToItsLargestValue) {
  SolverOptions options;
  options.muInit = 2.;
  options.muInc = 10.;
  options.muMax = 500.;
  for (const double weight : {1., 8.}) {
    Penalty penalty(options, weight);
    for (const double expected : {2., 20., 200., 500., 500.}) {
      EXPECT_EQ(penalty.value(), weight * expected);
      penalty.grow();
    }
  }
}

TEST(Penalty, IsMuchAThousandTimesItsFirstValue) {
  const SolverOptions options;
  Penalty penalty(options, 3.);
  while (!penalty.isLarge()) penalty.grow();
  EXPECT_DOUBLE_EQ(penalty.value(), Penalty::kLarge * 3. * options.muInit);
}

TEST(Penalty, RestartsHigherAfterEachRestoration) {
  SolverOptions options;
  options.muMax = 50.;
  Penalty penalty(options, 1.);
  penalty.restart(1);
  EXPECT_EQ(penalty.value(), 10. * options.muInit);
  penalty.restart(2);
  EXPECT_EQ(penalty.value(), options.muMax);
}

TEST(Penalty, IsInUnitsOfSteepCostsOnly) {
  EXPECT_EQ(Penalty::costWeight(0.), 1.);
  EXPECT_EQ(Penalty::costWeight(100.), 1.);
  EXPECT_EQ(Penalty::costWeight(1e6), 1e4);
}
