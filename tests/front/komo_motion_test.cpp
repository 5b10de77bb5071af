#include "kinegraph/front/komo_motion.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

TEST(KomoMotion, HasASliceForEachOfThePathAndBeforeItAndMarksWhatIsViolated) {
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

}  // namespace
}  // namespace kinegraph
