#include "kinegraph/solvers/algebra/indefinite.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace kinegraph {
namespace {

bool isConvex(const MatrixXd& H) { return Eigen::LLT<MatrixXd>(H).info() == Eigen::Success; }

TEST(Indefinite, AConvexFunctionStaysAsItIs) {
  const MatrixXd W = (MatrixXd(2, 2) << 2., 1., 1., 3.).finished();
  const QuadraticFunction f = convexified(W, Eigen::Vector2d(1., 2.), MatrixXd(0, 2), VectorXd(0), 1e-3);
  EXPECT_EQ(f.H, W);
  EXPECT_EQ(f.g, Eigen::Vector2d(1., 2.));
}

TEST(Indefinite, WhereRowsHoldTheNegativeCurvatureTheFunctionOnThemIsTheSame) {
  const MatrixXd W = (MatrixXd(2, 2) << 1., 0., 0., -4.).finished();
  const VectorXd g = Eigen::Vector2d(.3, -2.), b = VectorXd::Constant(1, .5);
  const MatrixXd A = (MatrixXd(1, 2) << 0., 1.).finished();
  const QuadraticFunction f = convexified(W, g, A, b, 1e-3);
  EXPECT_TRUE(isConvex(f.H));
  const auto difference = [&](double x) {
    const Eigen::Vector2d d(x, -.5);
    return .5 * d.dot(f.H * d) + f.g.dot(d) - .5 * d.dot(W * d) - g.dot(d);
  };
  EXPECT_NEAR(difference(-1.), difference(2.), 1e-12);
  const Eigen::Vector2d there(0., -.5);  // and so is its gradient, across the row: multipliers are the same
  EXPECT_NEAR(((f.H - W) * there + f.g - g).norm(), 0., 1e-12);
}

TEST(Indefinite, TheFunctionOnTheRowsIsTheSameHoweverStronglyTheyAreCoupledWithWhatIsFree) {
  const MatrixXd W = (MatrixXd(3, 3) << 16., -216., 0., -216., 0., 1., 0., 1., .06).finished();
  const VectorXd g = Eigen::Vector3d(-1., .5, .2), b = VectorXd::Constant(1, -.25);
  const MatrixXd A = (MatrixXd(1, 3) << 0., 1., 0.).finished();
  const QuadraticFunction f = convexified(W, g, A, b, 1e-3);
  EXPECT_TRUE(isConvex(f.H));
  const auto difference = [&](double x, double z) {
    const Eigen::Vector3d d(x, .25, z);
    return .5 * d.dot(f.H * d) + f.g.dot(d) - .5 * d.dot(W * d) - g.dot(d);
  };
  EXPECT_NEAR(difference(-1., 2.), difference(2., -3.), 1e-9);
  const Eigen::Vector3d there(.7, .25, -.3);
  EXPECT_NEAR(((f.H - W) * there + f.g - g).norm(), 0., 1e-8);
}

TEST(Indefinite, OnlyCurvatureAlongTheRowsChangesItsSign) {
  const MatrixXd W = Eigen::Vector3d(-3., 2., 7.).asDiagonal(), A = (MatrixXd(1, 3) << 0., 0., 1.).finished();
  const QuadraticFunction f = convexified(W, VectorXd::Zero(3), A, VectorXd::Zero(1), 1e-3);
  EXPECT_TRUE(isConvex(f.H));
  EXPECT_NEAR((f.H.topLeftCorner(2, 2) - MatrixXd(Eigen::Vector2d(3., 2.).asDiagonal())).norm(), 0., 1e-12);
}

TEST(Indefinite, AFunctionWithoutCurvatureGetsTheLeast) {
  const QuadraticFunction f =
      convexified(MatrixXd::Zero(2, 2), Eigen::Vector2d(1., 0.), MatrixXd(0, 2), VectorXd(0), .5);
  EXPECT_NEAR((f.H - .5 * MatrixXd::Identity(2, 2)).norm(), 0., 1e-12);
}

TEST(Indefinite, OtherwiseNoCurvatureIsLessThanTheLeast) {
  const MatrixXd W = (MatrixXd(3, 3) << 0., 3., 1., 3., 0., -2., 1., -2., 0.).finished();  // zero diagonal
  const QuadraticFunction f = convexified(W, Eigen::Vector3d::Ones(), MatrixXd(0, 3), VectorXd(0), .25);
  MatrixXd shifted = f.H;
  shifted.diagonal().array() -= .25 - 1e-9;
  EXPECT_TRUE(isConvex(shifted));
}

TEST(Indefinite, NegativeCurvatureIsFoundWhereRowsAdmitIt) {
  const MatrixXd W = Eigen::Vector3d(1., -2., -3.).asDiagonal();
  Restriction rows{(MatrixXd(1, 3) << 0., 0., 1.).finished(), (MatrixXd(1, 3) << 0., 1., 0.).finished()};
  const std::optional<VectorXd> d = negativeCurvature(W, rows, 1e-9);
  ASSERT_TRUE(d.has_value());
  EXPECT_NEAR((*d - Eigen::Vector3d(0., -1., 0.)).norm(), 0., 1e-12);  // away from the row that is tight
  appendRow(rows.fixed, rows.tight.row(0));
  EXPECT_FALSE(negativeCurvature(W, rows, 1e-9).has_value());
}

TEST(Indefinite, RowsThatAreTouchedFromBothSidesAreHeld) {
  const MatrixXd W = Eigen::Vector2d(-1., 1.).asDiagonal();
  const MatrixXd both = (MatrixXd(2, 2) << 1., 0., -1., 0.).finished();
  EXPECT_FALSE(negativeCurvature(W, {MatrixXd(0, 2), both}, 1e-9).has_value());
}

TEST(Indefinite, TheNullSpaceIsOrthonormalAlsoOfRowsThatDepend) {
  const MatrixXd rows = (MatrixXd(2, 3) << 1., 1., 0., 2., 2., 0.).finished();
  const MatrixXd Z = nullSpace(rows);
  ASSERT_EQ(Z.cols(), 2);
  EXPECT_NEAR((rows * Z).norm(), 0., 1e-12);
  EXPECT_NEAR((Z.transpose() * Z - MatrixXd::Identity(2, 2)).norm(), 0., 1e-12);
}

}  // namespace
}  // namespace kinegraph
