#include "kinegraph/collision/near_pair_search.h"

#include <gtest/gtest.h>

#include "kinegraph/collision/near_pairs.h"
#include "tests/support/crowd.h"

using namespace kinegraph;
using namespace kinegraph::testing;

namespace {

void expectAll(NearPairSearch& search, const Config& config, double margin, const std::string& what) {
  const auto expected = measuredCollisions(config, margin);
  const auto& found = search.near(margin);
  ASSERT_EQ(found.size(), expected.size()) << what;
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(search.frame(found[i].a), expected[i].a) << what;
    EXPECT_EQ(search.frame(found[i].b), expected[i].b) << what;
    EXPECT_EQ(found[i].distance, expected[i].distance) << what;
  }
}

}  // namespace

TEST(NearPairSearch, FindsWhatMeasuringAllPairsFindsOnARandomWalk) {
  Config config = crowd(90, .7, 1);
  NearPairSearch search(config.model());
  Rng rng(2);
  VectorXd q = config.getJointState();
  std::size_t near = 0;
  long measured = 0, fresh = 0;
  for (int step = 0; step < 66; ++step) {
    const int kind = step % 6;
    if (kind == 5)
      config.getFrame(cat("body", 4 * (step % 20) + 1)).setPosition({rng.uniform(-.8, .8), rng.uniform(-.8, .8), 0.});
    for (double& x : q) {
      if (kind < 3 && rng.uniform() < .1) x += .02 * rng.normal();  // some move a little
      if (kind == 3) x += .01 * rng.normal();                       // all move a little
      if (kind == 4 && rng.uniform() < .05) x += rng.normal();      // some jump
    }
    config.setJointState(q);
    search.place(config.state());
    for (const double margin : {0., step % 7 == 0 ? .1 : 0., step % 11 == 0 ? -.02 : 0.}) {
      expectAll(search, config, margin, cat("step ", step, ", margin ", margin));
      near += search.near(margin).size();
    }
    NearPairSearch again(config.model());
    again.place(config.state());
    again.near(0.);
    fresh += again.measured();
    measured = search.measured();
  }
  EXPECT_GT(near, 500u);
  EXPECT_LT(2 * measured, fresh) << "what was measured is remembered";
}

TEST(NearPairSearch, MeasuresNothingAgainWhereNothingMoved) {
  Config config = crowd(100, .5, 3);
  NearPairSearch search(config.model());
  search.place(config.state());
  const std::size_t near = search.near(.05).size();
  const long measured = search.measured();
  EXPECT_GT(near, 50u);
  config.setJointState(config.getJointState());
  search.place(config.state());
  EXPECT_EQ(search.near(.05).size(), near);
  EXPECT_EQ(search.measured(), measured);
}

TEST(NearPairSearch, OfSomeFramesFindsTheirPairsOnly) {
  const Config config = crowd(100, .5, 4);
  const int one = config.getFrame("body3").id(), two = config.getFrame("link4").id();
  NearPairSearch all(config.model()), some(config.model(), {one, two});
  all.place(config.state());
  some.place(config.state());
  std::vector<std::pair<int, int>> expected, found;
  for (const auto& pair : all.near(.2)) {
    const int a = all.frame(pair.a), b = all.frame(pair.b);
    if (a == one || b == one || a == two || b == two) expected.emplace_back(a, b);
  }
  for (const auto& pair : some.near(.2)) found.emplace_back(some.frame(pair.a), some.frame(pair.b));
  EXPECT_EQ(found, expected);
  EXPECT_GT(found.size(), 3u);
}

TEST(NearPairSearch, ABodyThatTurnsOnTheSpotIsSeenToMove) {
  Config config = crowd(80, 3., 5);
  config.addFrame("pivot", "world", "pre: [9 0 0], joint: hingeZ, shape: box, size: [1 .02 .02], contact: 1");
  config.addFrame("post", "", "X: [9 .3 0], shape: sphere, size: [.02], contact: 1");
  NearPairSearch search(config.model());
  VectorXd q = config.getJointState();
  bool met = false;
  for (double angle = 0.; angle < 1.7; angle += .01) {
    q[q.size() - 1] = angle;
    config.setJointState(q);
    search.place(config.state());
    expectAll(search, config, 0., cat("angle ", angle));
    for (const auto& pair : search.near(0.)) met |= search.frame(pair.b) == config.getFrame("post").id();
  }
  EXPECT_TRUE(met);
}

TEST(NearPairs, OfManyBodiesAreApartWhereNoPairIsNear) {
  Config config = crowd(100, 6., 6);
  NearPairs pairs(config.model());
  Rng rng(7);
  int apart = 0, near = 0;
  for (int i = 0; i < 60; ++i) {
    VectorXd q = config.getJointState();
    q[q.size() - 1 - i % 6] += rng.normal();
    if (i % 3 == 0) q.head(6) += .5 * VectorXd::Ones(6) * rng.normal();
    config.setJointState(q);
    pairs.place(config.state());
    bool expected = true;
    for (const auto& pair : measuredCollisions(config, .3)) expected &= pair.distance >= .3;
    EXPECT_EQ(pairs.apart(.3), expected);
    ++(expected ? apart : near);
  }
  EXPECT_GT(apart + near, 50);
}

TEST(NearPairSearch, ThatAsksWhetherAllAreApartStopsAtThePairThatIsNot) {
  Config config = crowd(100, 1.2, 6);
  NearPairSearch search(config.model()), all(config.model());
  search.place(config.state());
  all.place(config.state());
  EXPECT_FALSE(search.apart(.1));
  all.near(.1);
  EXPECT_LT(search.measured(), all.measured());
  VectorXd q = config.getJointState();
  for (int i = 0; i < 10; ++i) {  // the same pair again, first
    q.array() += 1e-6;
    config.setJointState(q);
    search.place(config.state());
    const long before = search.measured();
    EXPECT_FALSE(search.apart(.1));
    EXPECT_LE(search.measured() - before, 1);
  }
}
