#include "kinegraph/features/feature_source.h"

#include <gtest/gtest.h>

using namespace kinegraph;

namespace {

MatrixXd made(const Scale& scale) { return scale.matrix(); }
VectorXd wanted(const Target& target) { return target.vector(); }

}  // namespace

TEST(Scale, IsMadeFromWhateverSaysIt) {
  EXPECT_EQ(made({}).size(), 0);
  EXPECT_EQ(made(10), MatrixXd::Constant(1, 1, 10.));
  EXPECT_EQ(made(.5), MatrixXd::Constant(1, 1, .5));
  EXPECT_EQ(made({1., 2., 3.}), (MatrixXd(3, 1) << 1., 2., 3.).finished());
  EXPECT_EQ(made(Vector3d(1., 2., 3.)), (MatrixXd(3, 1) << 1., 2., 3.).finished());
  EXPECT_EQ(made(Eigen::RowVector2d(1., 2.)), (MatrixXd(1, 2) << 1., 2.).finished());
  EXPECT_EQ(made(2. * MatrixXd::Identity(2, 2)), (MatrixXd(2, 2) << 2., 0., 0., 2.).finished());
}

TEST(Target, IsMadeFromWhateverSaysIt) {
  EXPECT_EQ(wanted({}).size(), 0);
  EXPECT_EQ(wanted(.1), VectorXd::Constant(1, .1));
  EXPECT_EQ(wanted({0., 0., .1}), VectorXd(Vector3d(0., 0., .1)));
  EXPECT_EQ(wanted(Vector3d(0., 0., .1)), VectorXd(Vector3d(0., 0., .1)));
  EXPECT_EQ(wanted(-VectorXd::Ones(4)), VectorXd(VectorXd::Constant(4, -1.)));
}
