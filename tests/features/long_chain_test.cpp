#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/text.h"
#include "kinegraph/features/eval.h"
#include "kinegraph/kinematics/kinematic_model.h"

using namespace kinegraph;

namespace {

constexpr int kJoints = 1000;
constexpr double kLink = .01;  ///< m

/// Hinges about z in series, each 1 cm along the x axis of the previous one.
Config chain() {
  std::string text = "link0: {}\n";
  for (int i = 1; i <= kJoints; ++i) {
    text += cat("link", i, "(link", i - 1, "): { pre: \"t(", kLink, " 0 0)\", joint: hingeZ }\n");
  }
  Config config;
  config.addText(text + cat("tip(link", kJoints, "): { Q: [", kLink, " 0 0] }\n"));
  return config;
}

}  // namespace

TEST(LongChain, OfAThousandJointsRollsUpToAPolygon) {
  Config config = chain();
  ASSERT_EQ(config.getJointDimension(), kJoints);
  const double angle = 4. * std::acos(0.) / kJoints;  // a full rotation
  config.setJointState(VectorXd::Constant(kJoints, angle));
  const Evaluation tip = eval(config, FeatureSymbol::position, {"tip"});
  Vector3d expected(kLink, 0., 0.);
  for (int i = 1; i <= kJoints; ++i) expected += kLink * Vector3d(std::cos(i * angle), std::sin(i * angle), 0.);
  EXPECT_LT((tip.y - expected).norm(), 1e-11);
  Vector3d joint(kLink, 0., 0.);
  for (int i = 0; i < kJoints; ++i) {
    const Vector3d arm = expected - joint;
    EXPECT_LT((tip.J.col(i) - Vector3d(-arm.y(), arm.x(), 0.)).norm(), 1e-11) << "joint " << i;
    joint += kLink * Vector3d(std::cos((i + 1) * angle), std::sin((i + 1) * angle), 0.);
  }
}

TEST(LongChain, TakesMemoryThatGrowsLikeItsJoints) {
  const Config config = chain();
  const KinematicModel& model = *config.model();
  for (std::size_t size : {model.links.size(), model.steps.size(), model.column_dof.size(), model.column_before.size(),
                           model.last_column.size(), model.frame_link.size()}) {
    EXPECT_LE(size, 3 * std::size_t(kJoints));
  }
}
