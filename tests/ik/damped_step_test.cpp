#include "kinegraph/ik/damped_step.h"

#include <gtest/gtest.h>

#include <limits>

#include "kinegraph/common/random.h"

namespace kinegraph {
namespace {

constexpr double kInf = std::numeric_limits<double>::infinity();

struct Sample {
  MatrixXd J;
  VectorXd e, x, lower, upper, longest, pull;
};

Sample draw(Rng& rng, int rows, int columns) {
  const auto vector = [&](int size) { return VectorXd(VectorXd::NullaryExpr(size, [&] { return rng.normal(); })); };
  Sample s;
  s.J = MatrixXd::NullaryExpr(rows, columns, [&] { return rng.normal(); });
  s.e = vector(rows);
  s.x = vector(columns);
  s.pull = vector(columns);
  s.lower = VectorXd::Constant(columns, -kInf);
  s.upper = VectorXd::Constant(columns, kInf);
  s.longest = VectorXd::Constant(columns, kInf);
  return s;
}

VectorXd stepOf(const Sample& s, double damping, bool with_preferred) {
  DampedStep step;
  step.resize(int(s.J.rows()), int(s.J.cols()));
  for (int c = 0; c < s.J.cols(); ++c) Eigen::Map<VectorXd>(step.column(c), s.J.rows()) = s.J.col(c);
  for (int r = 0; r < s.J.rows(); ++r) step.error(r) = s.e[r];
  step.solve(s.x.data(), s.lower.data(), s.upper.data(), s.longest.data(), damping,
             with_preferred ? s.pull.data() : nullptr);
  return step.step();
}

TEST(DampedStep, MinimizesTheDampedSquares) {
  Rng rng(0);
  for (const auto& [rows, columns] : {std::pair(3, 7), {6, 7}, {6, 3}, {5, 9}}) {
    const Sample s = draw(rng, rows, columns);
    for (const bool with_preferred : {false, true}) {
      const VectorXd pull = with_preferred ? s.pull : VectorXd(VectorXd::Zero(columns)),
                     dx = stepOf(s, .3, with_preferred);
      const VectorXd gradient = s.J.transpose() * (s.J * dx - s.e) + .3 * (dx - pull);
      EXPECT_LT(gradient.norm(), 1e-10);
    }
  }
}

TEST(DampedStep, VariablesAtBoundsThatItWouldCrossAreHeldAndTheOthersSolvedAgain) {
  Rng rng(1);
  Sample s = draw(rng, 3, 7);
  const VectorXd free = stepOf(s, .1, false);
  for (int i = 0; i < 2; ++i) (free[i] < 0. ? s.lower : s.upper)[i] = s.x[i];
  const VectorXd dx = stepOf(s, .1, false);
  const VectorXd gradient = s.J.transpose() * (s.J * dx - s.e) + .1 * dx;
  EXPECT_EQ(dx.head(2).norm(), 0.);
  EXPECT_LT(gradient.tail(5).norm(), 1e-10);
}

TEST(DampedStep, EndsWithinTheBoundsAndTheLongestStep) {
  Rng rng(2);
  for (int i = 0; i < 50; ++i) {
    Sample s = draw(rng, 3, 5);
    s.lower = s.x.array() - .2;
    s.upper = s.x.array() + .3;
    s.longest << .1, .1, .25, kInf, kInf;
    const VectorXd dx = stepOf(s, 1e-3, false);
    EXPECT_TRUE((dx.array() >= -.2 - 1e-12).all() && (dx.array() <= .3 + 1e-12).all());
    EXPECT_TRUE((dx.array().abs() <= s.longest.array() + 1e-12).all());
  }
}

}  // namespace
}  // namespace kinegraph
