#include "kinegraph/solvers/algebra/constraint_curvature.h"

#include <gtest/gtest.h>

namespace kinegraph {
namespace {

/// Rows 1/2 x^T C x + a^T x; the second is linear.
struct Rows {
  MatrixXd C = (MatrixXd(3, 3) << 1., 2., 0., 2., -3., 1., 0., 1., .5).finished();
  Jacobian at(const VectorXd& x) const {
    Jacobian J = Jacobian::dense(2, 3);
    const VectorXd first = C * x;
    for (int i = 0; i < 3; ++i) J.values[std::size_t(i)] = first[i], J.values[std::size_t(3 + i)] = 1. + i;
    return J;
  }
};

TEST(ConstraintCurvature, IsExactAfterAsManyStepsAsThereAreVariables) {
  const Rows rows;
  ConstraintCurvature curvature;
  curvature.reset({0, 1}, 3);
  VectorXd x = VectorXd::Zero(3);
  for (const Eigen::Vector3d& s :
       {Eigen::Vector3d(1., .2, 0.), Eigen::Vector3d(-.3, 1., .1), Eigen::Vector3d(0., .4, 1.)}) {
    curvature.update(s, rows.at(x), rows.at(x + s));
    x += s;
  }
  MatrixXd H = MatrixXd::Zero(3, 3);
  curvature.addTo(H, Eigen::Vector2d(2., 5.));
  EXPECT_NEAR((H - 2. * rows.C).norm(), 0., 1e-10);
}

TEST(ConstraintCurvature, KnowsInWhichDirectionsItSawNothing) {
  const Rows rows;
  ConstraintCurvature curvature;
  curvature.reset({0, 1}, 3);
  EXPECT_EQ(curvature.observed(Eigen::Vector2d(1., 1.)).rows(), 0);
  const VectorXd x = VectorXd::Zero(3), s = Eigen::Vector3d(0., 1., 0.);
  curvature.update(s, rows.at(x), rows.at(x + s));
  const MatrixXd observed = curvature.observed(Eigen::Vector2d(1., 1.));
  const Eigen::Vector3d along = rows.C * s, across(3., 2., 0.);  // the estimate has rank one
  EXPECT_GT((observed * along).norm(), .1);
  EXPECT_NEAR((observed * across).norm(), 0., 1e-12);
  EXPECT_EQ(curvature.observed(Eigen::Vector2d(0., 1.)).rows(), 0);  // the other row is linear
}

}  // namespace
}  // namespace kinegraph
