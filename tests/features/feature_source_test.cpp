#include "kinegraph/features/feature_source.h"

#include <gtest/gtest.h>

#include "kinegraph/features/eval.h"
#include "kinegraph/features/make_residual.h"
#include "tests/features/slices.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// Height of a frame, as a custom feature.
class Height final : public Feature {
 public:
  explicit Height(int frame) : frame_(frame) {}
  int rows() const override { return 1; }
  void eval(std::span<const State* const> states, double, Eigen::Ref<VectorXd> y, JacobianRows* J) const override {
    const Vector3d p = states[0]->position(frame_);
    y[0] = p.z();
    if (J) states[0]->addJacobian(frame_, p, Eigen::RowVector3d(0., 0., 1.), Eigen::RowVector3d(0., 0., 0.), *J);
  }

 private:
  int frame_;
};

FeatureSource height() {
  return {"height", [](const std::vector<int>& frames, const State&) -> std::unique_ptr<Feature> {
            if (frames.size() != 1) throw ValueError("height takes 1 frame");
            return std::make_unique<Height>(frames[0]);
          }};
}

Config slider() {
  Config config;
  config.addText("world: {}  slider(world): { joint: transZ, q: .5 }  tip(slider): { Q: [0 .3 .2] }");
  return config;
}

}  // namespace

TEST(FeatureSource, ASymbolIsItsOwnName) {
  const FeatureSource source = FeatureSymbol::position;
  EXPECT_EQ(source.name(), "position");
  EXPECT_TRUE(source == FeatureSymbol::position);
  EXPECT_FALSE(source == FeatureSymbol::quaternion);
  EXPECT_EQ(source.symbol(), FeatureSymbol::position);
}

TEST(FeatureSource, AFeatureOfOnesOwnIsEvaluatedAsABuiltInOne) {
  const Config config = slider();
  const Evaluation own = eval(config, height(), {"tip"}, MatrixXd::Constant(1, 1, 2.), VectorXd::Constant(1, .3));
  EXPECT_NEAR(own.y[0], 2. * (.7 - .3), 1e-12);
  EXPECT_NEAR(own.J(0, 0), 2., 1e-12);
  EXPECT_FALSE(height().symbol());
  EXPECT_FALSE(height() == FeatureSymbol::position);
}

TEST(FeatureSource, AFeatureOfOnesOwnHasDifferencesAsVelocity) {
  const Config config = slider();
  Residual velocity = makeResidual(config.state(), height(), {"tip"}, {}, {}, 1);
  EXPECT_NEAR(overSlices(config, velocity, {VectorXd::Constant(1, .1), VectorXd::Constant(1, .2)}, .5)[0], .2, 1e-12);
}

TEST(FeatureSource, ErrorsCarryTheNameOrTheReasonOfItsOwn) {
  const Config config = slider();
  expectError<FrameNotFound>([&] { eval(config, height(), {"top"}); }, {"height", "'top'", "tip"});
  expectError<ValueError>([&] { eval(config, height(), {"tip", "slider"}); }, {"height takes 1 frame"});
}
