#include "kinegraph/math/lane_math.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/random.h"
#include "kinegraph/math/pose.h"

namespace kinegraph::lanes {
namespace {

using Two = Pack<2>;  // what every machine has

Two draw(Rng& rng, double spread) {
  Two pack;
  for (int i = 0; i < 2; ++i) pack[i] = spread * rng.normal();
  return pack;
}

Vec3<Two> sampleVector(Rng& rng) { return {draw(rng, 1.), draw(rng, 1.), draw(rng, 1.)}; }

template <class V>
Vector3d lane(const V& a, int i) {
  return {a.x[i], a.y[i], a.z[i]};
}

TEST(LaneMath, SinesAndCosinesAreThoseOfTheLibraryToRounding) {
  Rng rng(1);
  for (const double spread : {.1, 3., 100., 3e4}) {
    for (int sample = 0; sample < 500; ++sample) {
      const Two angle = draw(rng, spread);
      Two sine, cosine;
      sineAndCosineOfAny(angle, sine, cosine);
      for (int i = 0; i < 2; ++i) {
        const double rounding = 3e-16 + 2e-16 * 1e-5 * std::abs(angle[i]);
        EXPECT_NEAR(sine[i], std::sin(angle[i]), rounding) << angle[i];
        EXPECT_NEAR(cosine[i], std::cos(angle[i]), rounding) << angle[i];
      }
    }
  }
}

TEST(LaneMath, AnglesTooLargeForTheSeriesAreLeftToTheLibrary) {
  for (const double large : {1e5 + 1., -1e9, 1e15}) {
    Two sine, cosine;
    sineAndCosineOfAny(Two{large, .5}, sine, cosine);
    EXPECT_EQ(sine[0], std::sin(large));
    EXPECT_EQ(cosine[0], std::cos(large));
    EXPECT_NEAR(sine[1], std::sin(.5), 3e-16);
  }
}

TEST(LaneMath, EveryLaneGetsTheBitsThatItGetsAlone) {
  Rng rng(2);
  for (int sample = 0; sample < 200; ++sample) {
    const Two many = draw(rng, 5.);
    Two sines, cosines;
    sineAndCosine(many, sines, cosines);
    for (int i = 0; i < 2; ++i) {
      Two sine, cosine;
      sineAndCosine(Two{1., many[i]}, sine, cosine);
      EXPECT_EQ(sine[1], sines[i]);
      EXPECT_EQ(cosine[1], cosines[i]);
      EXPECT_EQ(root(magnitude(many))[i], root(magnitude(many[i])));
    }
  }
}

TEST(LaneMath, ProductsOfVectorsAreThoseOfEigenInEveryLane) {
  Rng rng(3);
  const double weights[3] = {.5, 0., -2.};
  for (int sample = 0; sample < 100; ++sample) {
    const Vec3<Two> a = sampleVector(rng), b = sampleVector(rng), columns[3] = {a, b, sampleVector(rng)};
    const Vec3<Two> across = cross(a, b), sum = combine(columns, weights);
    const Two inner = dot(a, b);
    for (int i = 0; i < 2; ++i) {
      const Vector3d x = lane(a, i), y = lane(b, i);
      EXPECT_LT((lane(across, i) - x.cross(y)).norm(), 1e-14);
      EXPECT_NEAR(inner[i], x.dot(y), 1e-14);
      EXPECT_LT((lane(sum, i) - (.5 * x - 2. * lane(columns[2], i))).norm(), 1e-14);
    }
  }
}

TEST(LaneMath, ThePackedVectorOfOneProblemHasTheBitsOfThreeNumbers) {
  Rng rng(4);
  for (int sample = 0; sample < 100; ++sample) {
    double numbers[6], packed[3], plain[3];
    for (double& x : numbers) x = rng.normal();
    Packed3 a, b;
    load(numbers, a), load(numbers + 3, b);
    const Vec3<double> x = load(numbers), y = load(numbers + 3);
    store(cross(a, b) + .3 * (a - b), packed);
    store(cross(x, y) + .3 * (x - y), plain);
    for (int k = 0; k < 3; ++k) EXPECT_EQ(packed[k], plain[k]);
  }
}

TEST(LaneMath, AMaskWithALaneSetIsToldFromOneWithout) {
  const Two zero{};
  EXPECT_FALSE(any(zero < zero));
  for (int i = 0; i < 2; ++i) {
    Two one{};
    one[i] = -1.;
    EXPECT_TRUE(any(one < zero)) << i;
    EXPECT_EQ(magnitude(one)[i], 1.);
    EXPECT_EQ(larger(one, zero)[i], 0.);
    EXPECT_EQ(smaller(one, zero)[i], -1.);
  }
  EXPECT_TRUE(any(1. < 2.));
  EXPECT_FALSE(any(2. < 1.));
}

}  // namespace
}  // namespace kinegraph::lanes
