#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/komo/komo.h"
#include "kinegraph/komo/path/path.h"

using namespace kinegraph;

namespace {

Config slider() {
  Config config;
  config.addText("a: {} b(a): { joint: transX, limits: [-2, 2], sampleUniform: 1 } c(b): { joint: hingeZ }");
  return config;
}

VectorXd pair(double a, double b) { return Eigen::Vector2d(a, b); }

}  // namespace

TEST(PathInitialization, WaypointsAreHeldOrBlended) {
  Komo komo(slider(), 2., 5, 1);
  EXPECT_EQ(komo.setWaypoints({pair(1., 0.), pair(-1., 0.)}), (std::vector<int>{4, 9}));
  const std::vector<double> held = {0, 0, 0, 0, 1, 1, 1, 1, 1, -1};
  for (int t = 0; t < 10; ++t) EXPECT_NEAR(komo.getPath()(t, 0), held[t], 1e-12) << t;
  Komo blended(slider(), 2., 5, 1);
  blended.setWaypoints({pair(1., 0.), pair(-1., 0.)}, {.interpolate = true});
  const std::vector<double> recorded = {0, .146, .5, .854, 1, .809, .309, -.309, -.809, -1};
  for (int t = 0; t < 10; ++t) EXPECT_NEAR(blended.getPath()(t, 0), recorded[t], 1e-3) << t;
}

TEST(PathInitialization, EndlessRotationsTakeTheShortWay) {
  Komo komo(slider(), 2., 4, 1);
  komo.setWaypoints({pair(0., 3.), pair(0., -3.)}, {.interpolate = true});
  const MatrixXd path = komo.getPath();
  for (int t = 4; t < 8; ++t) EXPECT_LT(std::abs(path(t, 1) - path(t - 1, 1)), .2) << t;
  EXPECT_NEAR(std::remainder(path(7, 1) + 3., 2. * M_PI), 0., 1e-12);
}

TEST(PathInitialization, WaypointsOfAProblemWithTheSameSwitchesFit) {
  Config config = slider();
  config.addFrame("box").setShape(ShapeType::ssBox, {.1, .1, .1, .01});
  Komo coarse(config, 2., 1, 1), fine(config, 2., 8, 2);
  for (Komo* komo : {&coarse, &fine}) komo->addModeSwitch({1., -1.}, SwitchMode::stable, {"c", "box"});
  VectorXd x = coarse.path().variables();
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] += .01 * double(i + 1);
  coarse.path().setVariables(x);
  fine.setWaypoints({coarse.path().ownDofs(0), coarse.path().ownDofs(1)}, {.interpolate = true});
  for (int phase : {0, 1}) {
    const Pose wanted = coarse.configuration(phase).getFrame("box").getPose();
    const Pose got = fine.configuration(8 * phase + 7).getFrame("box").getPose();
    EXPECT_LT((wanted.p - got.p).norm(), 1e-12);
    EXPECT_LT(wanted.q.angularDistance(got.q), 1e-9);
  }
}

TEST(PathInitialization, RandomPathsStayWithinLimitsAndRepeatWithTheSeed) {
  Komo komo(slider(), 1., 30, 1);
  Rng first(3), second(3);
  komo.setRandomPath(first);
  const MatrixXd path = komo.getPath();
  EXPECT_LE(path.col(0).cwiseAbs().maxCoeff(), 2.);
  EXPECT_GT(path.col(0).cwiseAbs().maxCoeff(), 1.);
  komo.resetPath();
  EXPECT_NEAR(komo.getPath().norm(), 0., 1e-12);
  komo.setRandomPath(second);
  EXPECT_EQ(komo.getPath(), path);
}

TEST(PathInitialization, APhaseTakesAPathOfAnyLengthIfResampled) {
  Komo komo(slider(), 2., 5, 1);
  MatrixXd path(3, 2);
  path << 0, 0, 1, 2, 2, 4;
  EXPECT_THROW(komo.setPhasePath(1, {}, path, false), ValueError);
  komo.setPhasePath(1, {}, path, true);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(komo.getPath()(5 + i, 1), i, 1e-12);
  EXPECT_NEAR(komo.getPath().topRows(5).norm(), 0., 1e-12);
  EXPECT_THROW(komo.setPhasePath(2, {}, path, true), ValueError);
}

TEST(PathInitialization, MistakesAreExplained) {
  Komo komo(slider(), 2., 5, 1);
  EXPECT_THROW(komo.setWaypoints({VectorXd::Zero(3)}), ValueError);
  EXPECT_THROW(komo.setWaypoints({pair(0, 0), pair(0, 0), pair(0, 0)}), ValueError);
  EXPECT_THROW(komo.setConstantPath(VectorXd::Zero(3)), ValueError);
  EXPECT_THROW(komo.setPath(MatrixXd::Zero(9, 2)), ValueError);
}
