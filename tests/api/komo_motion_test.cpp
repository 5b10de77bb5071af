#include "kinegraph/api/komo_motion.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(KomoMotion, HasAllSlicesAndThePrefixAndMarksViolations) {
  Config config;
  config.addText("base: { } \n hand (base): { joint: transX, limits: [-2 2] } \n goal: { X: [1 0 0] }");
  Komo komo(config, 1., 3, 2);
  komo.addObjective({1.}, FeatureSymbol::positionDiff, {"hand", "goal"}, ObjectiveType::eq);
  const ShownMotion missed = motionOf(komo);
  ASSERT_EQ(missed.poses.size(), 5u);
  EXPECT_EQ(missed.prefix, 2);
  EXPECT_NEAR(missed.seconds, komo.tau() * 5, 1e-12);
  EXPECT_EQ(missed.q.rows(), 5);
  EXPECT_NEAR(missed.violations.back(), 1., 1e-9);
  EXPECT_EQ(missed.marked.back(), (std::vector<int>{1, 2}));
  EXPECT_TRUE(missed.marked.front().empty());

  komo.setPath(MatrixXd{{.3}, {.6}, {1.}});
  const ShownMotion reached = motionOf(komo);
  EXPECT_EQ(reached.violations.back(), 0.);
  EXPECT_TRUE(reached.marked.back().empty());
  EXPECT_EQ(reached.poses.back()[1].p.x(), 1.);
}

/// A ball that slides along x, into a table; it stands on a foot that overlaps the table at every q.
Config ballAtTable() {
  Config config;
  config.addText(R"(
    table: { X: [1 0 0], shape: box, size: [1 1 1], contact: 1 }
    foot: { X: [.4 0 0], shape: box, size: [.4 .1 .1], contact: 1 }
    base: { }
    ball (base): { joint: transX, limits: [-2 2], shape: sphere, size: [.1], contact: 1 }
  )");
  return config;
}

void expectLine(const NearLine& line, const std::string& names, double distance, double xa, double xb) {
  EXPECT_EQ(line.names, names);
  EXPECT_NEAR(line.distance, distance, 1e-6);
  EXPECT_LT((line.a - Vector3d(xa, 0., 0.)).norm(), 1e-4) << line.a.transpose();
  EXPECT_LT((line.b - Vector3d(xb, 0., 0.)).norm(), 1e-4) << line.b.transpose();
}

TEST(KomoMotion, ShowsForbiddenContacts) {
  for (const FeatureSymbol symbol : {FeatureSymbol::accumulatedCollisions, FeatureSymbol::pairCollisions}) {
    Config config = ballAtTable();
    config.getFrame("foot").setContact(0);
    Komo komo(config, 1., 2, 1);
    const bool all_pairs = symbol == FeatureSymbol::accumulatedCollisions;
    komo.addObjective({}, symbol, {}, all_pairs ? ObjectiveType::eq : ObjectiveType::ineq);
    komo.setPath(MatrixXd{{.3}, {.43}});
    const ShownMotion motion = motionOf(komo);
    ASSERT_EQ(motion.touching.size(), motion.poses.size());
    EXPECT_TRUE(motion.touching[1].empty()) << "apart";
    ASSERT_EQ(motion.touching[2].size(), 1u);
    expectLine(motion.touching[2][0], "table - ball", -.03, .5, .53);
    EXPECT_TRUE(motion.marked[2].empty()) << "not all of the table";
  }
}

TEST(KomoMotion, ShowsViolatedDistances) {
  Komo komo(ballAtTable(), 1., 1, 1);
  komo.addObjective({}, FeatureSymbol::distance, {"ball", "table"}, ObjectiveType::eq);
  const ShownMotion motion = motionOf(komo);
  ASSERT_EQ(motion.touching[1].size(), 1u);
  expectLine(motion.touching[1][0], "ball - table", .4, .1, .5);
  EXPECT_TRUE(motion.marked[1].empty());
}

TEST(KomoMotion, ShowsNoPairsThatOverlapAtEveryQ) {
  Komo komo(ballAtTable(), 1., 1, 1);
  komo.addObjective({}, FeatureSymbol::accumulatedCollisions, {}, ObjectiveType::eq);
  komo.setPath(MatrixXd{{.43}});
  const ShownMotion motion = motionOf(komo);
  for (const NearLine& line : motion.touching[1]) EXPECT_NE(line.names, "table - foot");
  EXPECT_EQ(motion.touching[1].size(), 2u) << "the ball is in the table and in the foot";
}

}  // namespace
}  // namespace kinegraph
