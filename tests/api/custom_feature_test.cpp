#include "kinegraph/api/custom_feature.h"

#include <gtest/gtest.h>

#include "kinegraph/api/names.h"
#include "kinegraph/features/eval.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

using Frames = std::span<const FrameView>;

Config arm() {
  Config config;
  config.addText(R"(
    base: { }
    one (base): { joint: hingeX, Q: [0, 0, .3] }
    two (one): { joint: hingeZ, Q: [.1, .2, .3] }
    end (two): { Q: [0, .1, .4] }
    other (base): { joint: transY }
  )");
  config.setJointState(VectorXd{{.3, -.4, .2}});
  return config;
}

const std::vector<std::string> kEnd = {"end"};

TEST(CustomFeature, ValueAndJacobianComeFromTheFunction) {
  const Config config = arm();
  const FeatureSource mine = customFeature(
      "mine", [](Frames f) { return FeatureValue(VectorXd(f[0].getPosition()), f[0].getPositionJacobian()); });
  const Evaluation own = eval(config, mine, kEnd), known = eval(config, FeatureSymbol::position, kEnd);
  EXPECT_EQ(own.y, known.y);
  EXPECT_TRUE(own.J.isApprox(known.J, 1e-14));
}

TEST(CustomFeature, WithoutAJacobianCentralDifferencesReplaceIt) {
  const Config config = arm();
  const FeatureSource mine = customFeature("mine", [](Frames f) { return FeatureValue(VectorXd(f[0].getPosition())); });
  const Evaluation own = eval(config, mine, kEnd), known = eval(config, FeatureSymbol::position, kEnd);
  EXPECT_LT((own.J - known.J).lpNorm<Eigen::Infinity>(), 1e-9);
  EXPECT_GT(known.J.norm(), .1);
  EXPECT_EQ(own.J.col(2).norm(), 0.);  // `other` does not move the frame
}

TEST(CustomFeature, TheJacobianOfAPointAndOfTheRotationAreThoseOfTheRegistry) {
  const Config config = arm();
  const FeatureSource axis = customFeature("axis", [](Frames f) {
    const Vector3d z = f[0].getRotationMatrix().col(2);
    return FeatureValue(VectorXd(z), -skew(z) * f[0].getAngularJacobian());
  });
  const Evaluation own = eval(config, axis, kEnd), known = eval(config, FeatureSymbol::vectorZ, kEnd);
  EXPECT_TRUE(own.y.isApprox(known.y, 1e-12));
  EXPECT_TRUE(own.J.isApprox(known.J, 1e-12));
}

TEST(CustomFeature, WithoutFramesAllDofsAreDifferentiated) {
  const Config config = arm();
  int calls = 0;
  const FeatureSource constant = customFeature("constant", [&calls](Frames frames) {
    ++calls;
    return FeatureValue(double(frames.size()));
  });
  const Evaluation own = eval(config, constant, {});
  EXPECT_EQ(own.y[0], 0.);
  EXPECT_EQ(calls, 1 + 1 + 2 * config.getJointDimension());
}

TEST(CustomFeature, ResultsOfAnotherSizeAreReportedWithTheName) {
  const Config config = arm();
  const FeatureSource wide = customFeature("wide", [](Frames) { return FeatureValue(1., MatrixXd::Zero(2, 2)); });
  expectError<ValueError>([&] { eval(config, wide, kEnd); }, {"feature wide", "2 x 2", "expected 1 x 3"});
  int calls = 0;
  const FeatureSource growing =
      customFeature("growing", [&calls](Frames) { return FeatureValue(VectorXd(VectorXd::Zero(++calls))); });
  expectError<ValueError>([&] { eval(config, growing, kEnd); },
                          {"feature growing", "returned 2 numbers", "expected 1"});
}

}  // namespace
}  // namespace kinegraph
