#include "tests/solvers/hock_schittkowski.h"

#include <gtest/gtest.h>

#include <cmath>

#include "kinegraph/solvers/methods/augmented_lagrangian.h"
#include "tests/solvers/numbers.h"
#include "tests/support/near.h"

namespace kinegraph {

namespace {

using enum ObjectiveType;

VectorXd all(int n, double value) { return VectorXd::Constant(n, value); }

KnownProblem rosenbrock() {
  return {"Rosenbrock",
          {sos, sos},
          all(2, -kInf),
          all(2, kInf),
          vec({-1.2, 1}),
          vec({1, 1}),
          0.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << 10. * (x[1] - x[0] * x[0]), 1. - x[0];
            J << -20. * x[0], 10., -1., 0.;
          },
          {}};
}

KnownProblem hs6() {
  return {"HS6",
          {sos, eq},
          all(2, -kInf),
          all(2, kInf),
          vec({-1.2, 1}),
          vec({1, 1}),
          0.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << 1. - x[0], 10. * (x[1] - x[0] * x[0]);
            J << -1., 0., -20. * x[0], 10.;
          },
          {}};
}

KnownProblem hs7() {
  return {"HS7",
          {f, eq},
          all(2, -kInf),
          all(2, kInf),
          vec({2, 2}),
          vec({0, std::sqrt(3.)}),
          -std::sqrt(3.),
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            const double s = 1. + x[0] * x[0];
            phi << std::log(s) - x[1], s * s + x[1] * x[1] - 4.;
            J << 2. * x[0] / s, -1., 4. * x[0] * s, 2. * x[1];
          },
          [](const VectorXd& x) {
            const double s = 1. + x[0] * x[0];
            return MatrixXd((MatrixXd(2, 2) << 2. / s - 4. * x[0] * x[0] / (s * s), 0., 0., 0.).finished());
          }};
}

KnownProblem hs14() {
  const double a = .5 * (std::sqrt(7.) - 1.), b = .25 * (std::sqrt(7.) + 1.);
  return {"HS14",
          {sos, sos, ineq, eq},
          all(2, -kInf),
          all(2, kInf),
          vec({2, 2}),
          vec({a, b}),
          9. - 2.875 * std::sqrt(7.),
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << x[0] - 2., x[1] - 1., .25 * x[0] * x[0] + x[1] * x[1] - 1., x[0] - 2. * x[1] + 1.;
            J << 1., 0., 0., 1., .5 * x[0], 2. * x[1], 1., -2.;
          },
          {}};
}

KnownProblem hs21() {
  return {"HS21",
          {sos, sos, f, ineq},
          vec({2, -50}),
          all(2, 50),
          vec({-1, -1}),
          vec({2, 0}),
          -99.96,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << .1 * x[0], x[1], -100., 10. - 10. * x[0] + x[1];
            J << .1, 0., 0., 1., 0., 0., -10., 1.;
          },
          {}};
}

KnownProblem hs28() {
  return {"HS28",
          {sos, sos, eq},
          all(3, -kInf),
          all(3, kInf),
          vec({-4, 1, 1}),
          vec({.5, -.5, .5}),
          0.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << x[0] + x[1], x[1] + x[2], x[0] + 2. * x[1] + 3. * x[2] - 1.;
            J << 1., 1., 0., 0., 1., 1., 1., 2., 3.;
          },
          {}};
}

KnownProblem hs35() {
  const MatrixXd H = (MatrixXd(3, 3) << 4, 2, 2, 2, 4, 0, 2, 0, 2).finished();
  const VectorXd g = vec({-8, -6, -4});
  return {"HS35",
          {f, ineq},
          all(3, 0.),
          all(3, kInf),
          all(3, .5),
          vec({4. / 3., 7. / 9., 4. / 9.}),
          1. / 9.,
          [H, g](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << 9. + g.dot(x) + .5 * x.dot(H * x), x[0] + x[1] + 2. * x[2] - 3.;
            J.row(0) = (g + H * x).transpose();
            J.row(1) << 1., 1., 2.;
          },
          [H](const VectorXd&) { return H; }};
}

KnownProblem hs39() {
  return {"HS39",
          {f, eq, eq},
          all(4, -kInf),
          all(4, kInf),
          all(4, 2.),
          vec({1, 1, 0, 0}),
          -1.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << -x[0], x[1] - std::pow(x[0], 3) - x[2] * x[2], x[0] * x[0] - x[1] - x[3] * x[3];
            J << -1., 0., 0., 0., -3. * x[0] * x[0], 1., -2. * x[2], 0., 2. * x[0], -1., 0., -2. * x[3];
          },
          {}};
}

KnownProblem hs43() {
  return {"HS43",
          {f, ineq, ineq, ineq},
          all(4, -kInf),
          all(4, kInf),
          all(4, 0.),
          vec({0, 1, 2, -1}),
          -44.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            const double a = x[0], b = x[1], c = x[2], d = x[3];
            phi << a * a + b * b + 2. * c * c + d * d - 5. * a - 5. * b - 21. * c + 7. * d,
                a * a + b * b + c * c + d * d + a - b + c - d - 8.,
                a * a + 2. * b * b + c * c + 2. * d * d - a - d - 10., 2. * a * a + b * b + c * c + 2. * a - b - d - 5.;
            J << 2. * a - 5., 2. * b - 5., 4. * c - 21., 2. * d + 7., 2. * a + 1., 2. * b - 1., 2. * c + 1.,
                2. * d - 1., 2. * a - 1., 4. * b, 2. * c, 4. * d - 1., 4. * a + 2., 2. * b - 1., 2. * c, -1.;
          },
          [](const VectorXd&) {
            return MatrixXd(vec({2, 2, 4, 2}).asDiagonal());
          }};
}

KnownProblem hs48() {
  return {"HS48",
          {sos, sos, sos, eq, eq},
          all(5, -kInf),
          all(5, kInf),
          vec({3, 5, -3, 2, -2}),
          all(5, 1.),
          0.,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            phi << x[0] - 1., x[1] - x[2], x[3] - x[4], x.sum() - 5., x[2] - 2. * (x[3] + x[4]) + 3.;
            J << 1., 0., 0., 0., 0., 0., 1., -1., 0., 0., 0., 0., 0., 1., -1., 1., 1., 1., 1., 1., 0., 0., 1., -2., -2.;
          },
          {}};
}

KnownProblem hs71() {
  return {"HS71",
          {f, ineq, eq},
          all(4, 1.),
          all(4, 5.),
          vec({1, 5, 5, 1}),
          vec({1, 4.74299963, 3.82114998, 1.37940829}),
          17.0140173,
          [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
            const double a = x[0], b = x[1], c = x[2], d = x[3];
            phi << a * d * (a + b + c) + c, 25. - a * b * c * d, x.squaredNorm() - 40.;
            J << d * (2. * a + b + c), a * d, a * d + 1., a * (a + b + c), -b * c * d, -a * c * d, -a * b * d,
                -a * b * c, 2. * a, 2. * b, 2. * c, 2. * d;
          },
          [](const VectorXd& x) {
            const double a = x[0], b = x[1], c = x[2], d = x[3], s = 2. * a + b + c;
            return MatrixXd((MatrixXd(4, 4) << 2. * d, d, d, s, d, 0., 0., a, d, 0., 0., a, s, a, a, 0.).finished());
          }};
}

constexpr int kStarts = 20;

/// Largest entry of the gradient of the Lagrangian that the bounds do not explain, and of multiplier times inequality,
/// relative to the multipliers. Infinite for a negative multiplier of an inequality.
double stationarityError(KnownNlp& nlp, const SolverResult& result) {
  Jacobian J = nlp.makeJacobian();
  VectorXd phi;
  nlp.evaluate(result.x, phi, &J);
  VectorXd gradient = VectorXd::Zero(nlp.dimension());
  double worst = 0.;
  for (int row = 0; row < J.rows(); ++row) {
    const ObjectiveType type = nlp.types()[row];
    const double dual = result.dual[row];
    J.addRowTo(row, type == f ? 1. : type == sos ? 2. * phi[row] : dual, gradient);
    if (type != ineq) continue;
    if (dual < 0.) return kInf;
    worst = std::max(worst, std::abs(dual * phi[row]));
  }
  const VectorXd step = (result.x - gradient).cwiseMax(nlp.lower()).cwiseMin(nlp.upper()) - result.x;
  return std::max(worst, step.lpNorm<Eigen::Infinity>()) / std::max(1., result.dual.lpNorm<Eigen::Infinity>());
}

class KnownOptimum : public ::testing::TestWithParam<KnownProblem> {};

}  // namespace

std::vector<KnownProblem> knownProblems() {
  return {rosenbrock(), hs6(), hs7(), hs14(), hs21(), hs28(), hs35(), hs39(), hs43(), hs48(), hs71()};
}

TEST_P(KnownOptimum, HasTheDerivativesThatItClaims) {
  KnownNlp nlp(GetParam());
  Rng rng(2);
  VectorXd x = GetParam().start;
  for (double& value : x) value += .3 * rng.normal();
  const JacobianCheck check = checkJacobian(nlp, x);
  EXPECT_LT(check.error, 1e-7) << "row " << check.row << " column " << check.column;
  if (!GetParam().cost_hessian) return;
  Jacobian J = nlp.makeJacobian();
  VectorXd phi;
  const auto gradient = [&](int i, double step) {
    VectorXd moved = x;
    moved[i] += step;
    nlp.evaluate(moved, phi, &J);
    return VectorXd(J.toDense().row(0).transpose());
  };
  MatrixXd H(x.size(), x.size());
  for (int i = 0; i < x.size(); ++i) H.col(i) = (gradient(i, 1e-5) - gradient(i, -1e-5)) / 2e-5;
  EXPECT_TRUE(near(GetParam().cost_hessian(x), H, 1e-6));
}

TEST_P(KnownOptimum, IsFoundToSixDigitsWhenAsked) {
  const KnownProblem& problem = GetParam();
  KnownNlp nlp(problem);
  SolverOptions options;
  options.stopTolerance = options.stopGTolerance = 1e-8;
  const SolverResult result = solveAugmentedLagrangian(nlp, problem.start, options);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_LE(result.violation, 1e-8);
  EXPECT_TRUE(near(result.x, problem.optimum, 1e-6));
  EXPECT_NEAR(result.f + result.sos, problem.cost, 1e-6 * std::max(1., std::abs(problem.cost)));
  EXPECT_LE(result.evals, 100);
  RecordProperty("evaluations", result.evals);
}

TEST_P(KnownOptimum, IsStationaryFromEveryStartThatIsReportedAsConverged) {
  const KnownProblem& problem = GetParam();
  Rng rng(5);
  int converged = 0, evaluations = 0;
  for (int start = 0; start < kStarts; ++start) {
    KnownNlp nlp(problem);
    SolverOptions options;
    options.stopTolerance = options.stopGTolerance = 1e-6;
    VectorXd x0 = problem.start;
    for (double& x : x0) x += rng.normal();
    const SolverResult result = solveAugmentedLagrangian(nlp, x0, options);
    evaluations += result.evals;
    if (result.status != SolverStatus::converged) continue;
    ++converged;
    EXPECT_LE(result.violation, 1e-6);
    EXPECT_LT(stationarityError(nlp, result), 1e-3) << "start " << start;
  }
  EXPECT_GE(converged, .9 * kStarts);
  RecordProperty("converged", converged);
  RecordProperty("evaluations", evaluations);
}

TEST_P(KnownOptimum, SatisfiesTheFirstOrderConditions) {
  const KnownProblem& problem = GetParam();
  KnownNlp nlp(problem);
  SolverOptions options;
  options.stopTolerance = options.stopGTolerance = 1e-8;
  const SolverResult result = solveAugmentedLagrangian(nlp, problem.start, options);
  EXPECT_LT(stationarityError(nlp, result), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(HockSchittkowski, KnownOptimum, ::testing::ValuesIn(knownProblems()),
                         [](const auto& info) { return info.param.name; });

}  // namespace kinegraph
