#include "kinegraph/komo/komo.h"

#include <gtest/gtest.h>

#include "kinegraph/features/feature_source.h"
#include "kinegraph/komo/komo_parts.h"
#include "kinegraph/scene/config.h"
#include "kinegraph/solvers/nlp_solver.h"
#include "tests/support/expect_error.h"

namespace kinegraph {

TEST(StepLimit, BoundsWhatJointsMoveFromSliceToSlice) {
  Config scene;
  scene.addText("base: {} arm (base): { joint: hingeZ }");
  for (const bool is_limited : {false, true}) {
    Komo komo(scene, 2, 4, 2);
    komo.setTiming(2, 4, 3., 2);
    komo.addControlObjective({}, 2, 1.);
    komo.addObjective({2.}, FeatureSymbol::qItself, {}, ObjectiveType::eq, {}, VectorXd::Constant(1, -1.));
    if (is_limited) addStepLimit(komo, .14);
    EXPECT_TRUE(komo.solve().feasible);
    const MatrixXd path = komo.getPath();
    double largest = std::abs(path(0, 0));
    for (int t = 1; t < 8; ++t) largest = std::max(largest, std::abs(path(t, 0) - path(t - 1, 0)));
    EXPECT_EQ(largest < .14 + 1e-4, is_limited) << largest;
  }
}

TEST(StepLimit, RefusesWhatMakesNoSense) {
  Config scene;
  scene.addText("base: {} arm (base): { joint: hingeZ }");
  Komo komo(scene, 1, 4, 1), still(scene, 1, 4, 0);
  expectError<ValueError>([&] { addStepLimit(komo, 0.); }, {"addStepLimit: step is 0; expected a number > 0"});
  expectError<ValueError>([&] { addStepLimit(still, .1); }, {"kOrder 1"});
}

}  // namespace kinegraph
