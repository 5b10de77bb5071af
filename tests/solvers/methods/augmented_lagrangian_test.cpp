#include "kinegraph/solvers/methods/augmented_lagrangian.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/problems.h"
#include "tests/solvers/hock_schittkowski.h"
#include "tests/solvers/numbers.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

/// Residuals A x - b of the given types.
CallbackNlp linear(const MatrixXd& A, const VectorXd& b, std::vector<ObjectiveType> types, VectorXd lower = {},
                   VectorXd upper = {}) {
  return CallbackNlp(int(A.cols()), std::move(types), std::move(lower), std::move(upper),
                     [A, b](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                       phi = A * x - b;
                       J = A;
                     });
}

MatrixXd randomMatrix(int rows, int columns, int seed) {
  Rng rng{std::uint64_t(seed)};
  MatrixXd A(rows, columns);
  for (double& x : A.reshaped()) x = rng.normal();
  return A;
}

SolverOptions tight(double tolerance = 1e-9) {
  SolverOptions options;
  options.stopTolerance = options.stopGTolerance = tolerance;
  return options;
}

/// min |x - p|^2 with a linear constraint a^T x <= b or = b.
struct OneConstraint {
  VectorXd p, a;
  double b;
  CallbackNlp nlp(ObjectiveType type) const {
    const int n = int(p.size());
    MatrixXd A(n + 1, n);
    A << MatrixXd::Identity(n, n), a.transpose();
    std::vector<ObjectiveType> types(std::size_t(n), sos);
    types.push_back(type);
    return linear(A, (VectorXd(n + 1) << p, b).finished(), types);
  }
  VectorXd solution() const { return p - (a.dot(p) - b) / a.squaredNorm() * a; }
  double multiplier() const { return 2. * (a.dot(p) - b) / a.squaredNorm(); }
};

const OneConstraint kOne = {vec({2, 1, -.5}), vec({1, 1, -2}), 1.};

}  // namespace

TEST(AugmentedLagrangian, SolvesASumOfSquaresInOneNewtonStep) {
  const MatrixXd A = randomMatrix(6, 4, 1);
  const VectorXd b = randomMatrix(6, 1, 2);
  CallbackNlp nlp = linear(A, b, std::vector<ObjectiveType>(6, sos));
  SolverOptions options = tight();
  options.damping = 0.;
  options.stepMax = 100.;
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(4), options);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_EQ(result.evals, 2);
  EXPECT_TRUE(near(result.x, A.colPivHouseholderQr().solve(b), 1e-12));
}

TEST(AugmentedLagrangian, AWeakCostIsMinimizedAllTheWay) {
  CallbackNlp nlp =
      linear(.1 * MatrixXd::Identity(7, 7), VectorXd::Constant(7, .1), std::vector<ObjectiveType>(7, sos));
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(7), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, VectorXd::Ones(7), 1e-3));
  EXPECT_LE(result.evals, 5);
}

TEST(AugmentedLagrangian, FindsPointAndMultiplierOfAnEquality) {
  CallbackNlp nlp = kOne.nlp(eq);
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(3), tight());
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, kOne.solution(), 1e-8));
  EXPECT_NEAR(result.dual[3], kOne.multiplier(), 1e-6);
  EXPECT_EQ(result.dual.head(3), VectorXd::Zero(3)) << "costs have no multiplier";
  EXPECT_LE(result.evals, 12);
}

TEST(AugmentedLagrangian, FindsPointAndMultiplierOfAnActiveInequality) {
  CallbackNlp nlp = kOne.nlp(ineq);
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(3), tight());
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, kOne.solution(), 1e-8));
  EXPECT_NEAR(result.dual[3], kOne.multiplier(), 1e-6);
}

TEST(AugmentedLagrangian, AnInactiveInequalityChangesNothingAndHasNoMultiplier) {
  OneConstraint loose = kOne;
  loose.b = 100.;
  CallbackNlp nlp = loose.nlp(ineq);
  const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(3), tight());
  EXPECT_TRUE(near(result.x, kOne.p, 1e-8));
  EXPECT_EQ(result.dual[3], 0.);
}

TEST(AugmentedLagrangian, ABarrierConstraintEndsWhereAnInequalityDoes) {
  CallbackNlp nlp = kOne.nlp(ineqB);
  EXPECT_TRUE(near(solveAugmentedLagrangian(nlp, VectorXd::Zero(3), tight()).x, kOne.solution(), 1e-8));
}

TEST(AugmentedLagrangian, APlainPenaltyIsASquareOutsideOnly) {
  const MatrixXd A = MatrixXd::Ones(2, 1);
  CallbackNlp outside = linear(A, vec({2., 1.}), {sos, ineqP}), inside = linear(A, vec({.5, 1.}), {sos, ineqP});
  EXPECT_NEAR(solveAugmentedLagrangian(outside, vec({0.}), tight()).x[0], 1.5, 1e-8);
  EXPECT_NEAR(solveAugmentedLagrangian(inside, vec({0.}), tight()).x[0], .5, 1e-8);
}

TEST(AugmentedLagrangian, SolvesLinearPrograms) {
  // least x + y with 1.5 x - x - y <= .2 and 1.5 y - x - y <= .2: both at (-.4, -.4)
  CallbackNlp nlp(2, {f, ineq, ineq}, VectorXd::Constant(2, -2.), VectorXd::Constant(2, 2.),
                  [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                    phi << x.sum(), -x.sum() + 1.5 * x[0] - .2, -x.sum() + 1.5 * x[1] - .2;
                    J << 1., 1., .5, -1., -1., .5;
                  });
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({1., 1.5}), tight(1e-8));
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_TRUE(near(result.x, vec({-.4, -.4}), 1e-7));
  EXPECT_TRUE(near(result.dual, vec({0., 2., 2.}), 1e-5));
}

TEST(AugmentedLagrangian, TakesStepsBelowTheirToleranceWhereTheViolationIsAboveIts) {
  const double root = std::asin(.5);
  CallbackNlp steep(1, {sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0], 1e3 * (std::sin(x[0]) - .5);
    J << 1., 1e3 * std::cos(x[0]);
  });
  const SolverResult result = solveAugmentedLagrangian(steep, vec({root + 5e-5}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_LE(result.violation, 1e-4);
  EXPECT_LE(result.evals, 4);
}

TEST(AugmentedLagrangian, RowOrderAndDuplicatedEqualitiesDoNotMoveTheSolution) {
  const MatrixXd C = randomMatrix(2, 5, 7);
  const VectorXd target = randomMatrix(5, 1, 8), c = randomMatrix(2, 1, 9);
  MatrixXd A(7, 5), reversed(9, 5);
  VectorXd b(7), reversed_b(9);
  A << MatrixXd::Identity(5, 5), C;
  b << target, c;
  reversed << C.colwise().reverse(), MatrixXd::Identity(5, 5), C;
  reversed_b << c.reverse(), target, c;
  CallbackNlp one = linear(A, b, {sos, sos, sos, sos, sos, eq, eq});
  CallbackNlp other = linear(reversed, reversed_b, {eq, eq, sos, sos, sos, sos, sos, eq, eq});
  const VectorXd expected = target - C.transpose() * (C * C.transpose()).inverse() * (C * target - c);
  EXPECT_TRUE(near(solveAugmentedLagrangian(one, VectorXd::Zero(5), tight()).x, expected, 1e-8));
  EXPECT_TRUE(near(solveAugmentedLagrangian(other, VectorXd::Zero(5), tight()).x, expected, 1e-8));
}

TEST(AugmentedLagrangian, TheFirstPenaltyDoesNotMoveTheSolution) {
  for (double mu : {1e-2, 1., 1e3}) {
    SolverOptions options = tight();
    options.muInit = mu;
    CallbackNlp nlp = kOne.nlp(eq);
    const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(3), options);
    EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
    EXPECT_TRUE(near(result.x, kOne.solution(), 1e-8)) << "mu " << mu;
    EXPECT_NEAR(result.dual[3], kOne.multiplier(), 1e-6) << "mu " << mu;
  }
}

TEST(AugmentedLagrangian, AConstraintScaledUpHasTheSameSolutionAndAMultiplierScaledDown) {
  for (double scale : {.01, 1., 100.}) {
    OneConstraint scaled = kOne;
    scaled.a *= scale;
    scaled.b *= scale;
    CallbackNlp nlp = scaled.nlp(ineq);
    const SolverResult result = solveAugmentedLagrangian(nlp, VectorXd::Zero(3), tight(1e-10));
    EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
    EXPECT_TRUE(near(result.x, kOne.solution(), 1e-7)) << "scale " << scale;
    EXPECT_NEAR(scale * result.dual[3], kOne.multiplier(), 1e-6) << "scale " << scale;
  }
}

TEST(AugmentedLagrangian, TheSameCallTwiceGivesTheSameBits) {
  for (const KnownProblem& problem : knownProblems()) {
    KnownNlp first(problem), second(problem);
    const SolverResult a = solveAugmentedLagrangian(first, problem.start, SolverOptions{});
    const SolverResult b = solveAugmentedLagrangian(second, problem.start, SolverOptions{});
    EXPECT_EQ(a.x, b.x) << problem.name;
    EXPECT_EQ(a.dual, b.dual) << problem.name;
    EXPECT_EQ(a.evals, b.evals) << problem.name;
  }
}

TEST(AugmentedLagrangian, NeverEvaluatesOutsideTheBounds) {
  for (const KnownProblem& problem : knownProblems()) {
    KnownNlp nlp(problem);
    int points = 0;
    const auto inside = [&](const VectorXd& x, const VectorXd&) {
      EXPECT_TRUE((x.array() >= problem.lower.array()).all() && (x.array() <= problem.upper.array()).all())
          << problem.name;
      ++points;
      return true;
    };
    const SolverResult result = solveAugmentedLagrangian(nlp, problem.start.array() - 3., SolverOptions{}, {}, inside);
    EXPECT_EQ(points, result.evals) << problem.name;
  }
}

TEST(AugmentedLagrangian, StopsAtABoundThatIsInTheWay) {
  const MatrixXd A = (MatrixXd(3, 2) << 1, 0, 0, 1, 1, 1).finished();
  CallbackNlp nlp = linear(A, vec({3, 3, 0}), {sos, sos, sos}, vec({-kInf, .25}), vec({.5, .25}));
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({0., 7.}), tight());
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_EQ(result.x, vec({.5, .25})) << "the second variable has one value only";
  SolverOptions free = tight();
  free.boundedNewton = false;
  EXPECT_TRUE(near(solveAugmentedLagrangian(nlp, vec({0., 7.}), free).x, vec({1., 1.}), 1e-8));
}

TEST(AugmentedLagrangian, ContradictingEqualitiesAreInfeasibleWithTheLeastViolation) {
  CallbackNlp nlp = linear(MatrixXd::Ones(3, 1), vec({0., 1., 5.}), {eq, eq, sos});
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({.2}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::infeasible) << result.message;
  EXPECT_FALSE(result.feasible);
  EXPECT_NEAR(result.x[0], .5, 1e-3);
  EXPECT_NEAR(result.violation, .5, 1e-3);
  EXPECT_LE(result.evals, 40);
  EXPECT_NE(result.message.find("contradict"), std::string::npos) << result.message;
}

TEST(AugmentedLagrangian, AConstraintThatABoundForbidsIsInfeasible) {
  CallbackNlp nlp = linear(-MatrixXd::Ones(1, 1), vec({-1.}), {ineq}, vec({-2.}), vec({.25}));
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({-1.}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::infeasible) << result.message;
  EXPECT_EQ(result.x[0], .25);
  EXPECT_NEAR(result.violation, .75, 1e-12);
}

TEST(AugmentedLagrangian, ASphereThatIsOutOfReachIsInfeasible) {
  // |x|^2 <= 1 and x0 >= 2: the violations 2 - x and x^2 - 1 balance where their squares sum to the least
  CallbackNlp nlp(2, {ineq, ineq, sos}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x.squaredNorm() - 1., 2. - x[0], x[1] - .3;
    J << 2. * x.transpose(), -1., 0., 0., 1.;
  });
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({0., 0.}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::infeasible) << result.message;
  EXPECT_NEAR(2. * result.x[0] * (result.x.squaredNorm() - 1.), 2. - result.x[0], 1e-2);
  EXPECT_NEAR(result.x[1], 0., 1e-2);
}

TEST(AugmentedLagrangian, FeasibleMeansTheStatedTolerance) {
  // one round without multipliers: x^2 + mu/2 (x - 1)^2 leaves a violation of about 2 / (2 + mu); not quite quadratic,
  // because such problems are solved in one step
  const auto constraint = [](double x) { return x - 1. + 1e-4 * (x - 1.) * (x - 1.); };
  CallbackNlp nlp(1, {sos, eq}, {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi = vec({x[0], constraint(x[0])});
    J = vec({1., 1. + 2e-4 * (x[0] - 1.)});
  });
  for (const auto& [mu, feasible] : {std::pair{1e3, false}, std::pair{4e3, true}}) {
    SolverOptions options;
    options.muInit = mu;
    options.stopOuters = 1;
    options.stopGTolerance = 1e-6;
    const SolverResult result = solveAugmentedLagrangian(nlp, vec({0.}), options);
    EXPECT_EQ(result.status, SolverStatus::limit) << result.message;
    EXPECT_EQ(result.violation, std::abs(constraint(result.x[0])));
    EXPECT_NEAR(result.violation, 2. / (2. + mu), .2 * result.violation);
    EXPECT_EQ(result.feasible, feasible) << "violation " << result.violation << "; the limit is 1e-3";
    options.stopGTolerance = 1e-3;
    EXPECT_TRUE(solveAugmentedLagrangian(nlp, vec({0.}), options).feasible) << "ten times the tolerance asked for";
  }
}

TEST(AugmentedLagrangian, TighterTolerancesDoNotRaiseTheViolation) {
  for (const KnownProblem& problem : knownProblems()) {
    double previous = kInf;
    for (double tolerance : {1e-2, 1e-4, 1e-6}) {
      KnownNlp nlp(problem);
      const SolverResult result = solveAugmentedLagrangian(nlp, problem.start, tight(tolerance));
      EXPECT_EQ(result.status, SolverStatus::converged)
          << problem.name << " to " << tolerance << ": " << result.message;
      EXPECT_LE(result.violation, tolerance) << problem.name;
      EXPECT_LE(result.violation, std::max(previous, 1e-9)) << problem.name;
      previous = result.violation;
    }
  }
}

TEST(AugmentedLagrangian, StartedAtTheSolutionWithItsMultipliersItHasNothingToDo) {
  for (const KnownProblem& problem : knownProblems()) {
    KnownNlp nlp(problem);
    SolverOptions options;
    const SolverResult cold = solveAugmentedLagrangian(nlp, problem.start, tight(1e-8));
    const SolverResult warm = solveAugmentedLagrangian(nlp, cold.x, options, cold.dual);
    EXPECT_EQ(warm.status, SolverStatus::converged) << problem.name;
    EXPECT_LE(warm.evals, 2) << problem.name;
    EXPECT_TRUE(near(warm.x, cold.x, 1e-4)) << problem.name;
  }
}

TEST(AugmentedLagrangian, StopsAtTheLimitOfEvaluations) {
  for (int limit : {1, 2, 5, 9}) {
    KnownNlp nlp(knownProblems().front());
    SolverOptions options = tight();
    options.stopEvals = limit;
    const SolverResult result = solveAugmentedLagrangian(nlp, vec({-1.2, 1.}), options);
    EXPECT_EQ(result.status, SolverStatus::limit);
    EXPECT_EQ(result.evals, limit);
    EXPECT_LE(nlp.evaluations, limit + 1) << "one more leaves the problem at the point that is returned";
    EXPECT_NE(result.message.find(std::to_string(limit) + " evaluations"), std::string::npos) << result.message;
  }
}

TEST(AugmentedLagrangian, CountsEveryEvaluation) {
  for (const KnownProblem& problem : knownProblems()) {
    KnownNlp nlp(problem);
    const SolverResult result = solveAugmentedLagrangian(nlp, problem.start, tight());
    EXPECT_LE(nlp.evaluations, result.evals + 1) << problem.name;
  }
}

TEST(AugmentedLagrangian, ReturnsTheBestPointWhenTheCallerCancels) {
  KnownNlp nlp(knownProblems().front());
  VectorXd best;
  double best_cost = kInf;
  int seen = 0;
  const auto watch = [&](const VectorXd& x, const VectorXd& phi) {
    if (++seen == 6) return false;
    if (phi.squaredNorm() < best_cost) {
      best_cost = phi.squaredNorm();
      best = x;
    }
    return true;
  };
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({-1.2, 1.}), SolverOptions{}, {}, watch);
  EXPECT_EQ(result.status, SolverStatus::cancelled);
  EXPECT_EQ(result.evals, 6);
  EXPECT_EQ(result.x, best);
  EXPECT_DOUBLE_EQ(result.sos, best_cost);
}

TEST(AugmentedLagrangian, ProblemsWithoutVariablesOrResidualsAreSolved) {
  CallbackNlp nothing(0, {}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd&) {});
  EXPECT_EQ(solveAugmentedLagrangian(nothing, VectorXd(), SolverOptions{}).status, SolverStatus::converged);
  CallbackNlp broken(0, {eq}, {}, {}, [](const VectorXd&, VectorXd& phi, MatrixXd&) { phi << 1.; });
  EXPECT_EQ(solveAugmentedLagrangian(broken, VectorXd(), SolverOptions{}).status, SolverStatus::infeasible);
  CallbackNlp indifferent(2, {}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd&) {});
  const SolverResult result = solveAugmentedLagrangian(indifferent, vec({1., 2.}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::converged);
  EXPECT_EQ(result.x, vec({1., 2.}));
}

TEST(AugmentedLagrangian, ANumberThatIsNotFiniteAtTheStartIsAnErrorThatNamesTheResidual) {
  const auto nan = [](double phi_2, double J_21) {
    return CallbackNlp(2, {sos, sos, eq}, {}, {}, [=](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
      phi << x, phi_2;
      J << 1., 0., 0., 1., 0., J_21;
    });
  };
  CallbackNlp value = nan(NAN, 1.), derivative = nan(1., NAN), infinite = nan(INFINITY, 1.);
  const VectorXd start = vec({1., 1.});
  expectError<ValueError>([&] { solveAugmentedLagrangian(value, start, {}); }, {"row 2 (eq)", "not finite"});
  expectError<ValueError>([&] { solveAugmentedLagrangian(infinite, start, {}); }, {"row 2 (eq)", "not finite"});
  expectError<ValueError>([&] { solveAugmentedLagrangian(derivative, start, {}); },
                          {"row 2 (eq)", "Jacobian", "not finite"});
}

TEST(AugmentedLagrangian, RecoversFromATrialPointThatIsNotFinite) {
  // log x + 1 has its root at 1/e; the first full step from 3 goes below zero
  CallbackNlp nlp(1, {sos}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << std::log(x[0]) + 1.;
    J << 1. / x[0];
  });
  SolverOptions options = tight(1e-8);
  options.stepMax = 100.;
  options.damping = 0.;
  int outside = 0;
  const auto count = [&](const VectorXd& x, const VectorXd&) {
    outside += x[0] < 0.;
    return true;
  };
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({3.}), options, {}, count);
  EXPECT_GT(outside, 0);
  EXPECT_EQ(result.status, SolverStatus::converged) << result.message;
  EXPECT_NEAR(result.x[0], std::exp(-1.), 1e-7);
}

TEST(AugmentedLagrangian, AWrongJacobianIsNotCalledConverged) {
  CallbackNlp nlp(2, {sos, sos}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] - 3., x[1];
    J << -1., 0., 0., 1.;
  });
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({1., 1.}), SolverOptions{});
  EXPECT_EQ(result.status, SolverStatus::stalled) << result.message;
  EXPECT_NE(result.message.find("no step decreases the objective as predicted"), std::string::npos) << result.message;
}

TEST(AugmentedLagrangian, NamesTheResidualThatIsNotFiniteWhereverItTriesToGo) {
  CallbackNlp nlp(1, {sos, sos}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0], x[0] < 1. ? NAN : 0.;
    J << 1., 0.;
  });
  const SolverResult result = solveAugmentedLagrangian(nlp, vec({1.}), SolverOptions{});
  EXPECT_NE(result.status, SolverStatus::converged);
  EXPECT_NE(result.message.find("row 1 (sos)"), std::string::npos) << result.message;
  EXPECT_NE(result.message.find("not finite"), std::string::npos) << result.message;
  EXPECT_EQ(result.x[0], 1.);
}

TEST(AugmentedLagrangian, StartsThatDoNotFitAreErrors) {
  CallbackNlp nlp = kOne.nlp(eq);
  expectError<ValueError>([&] { solveAugmentedLagrangian(nlp, vec({1.}), {}); }, {"1 entries", "3 variables"});
  expectError<ValueError>([&] { solveAugmentedLagrangian(nlp, vec({1., NAN, 0.}), {}); }, {"not finite"});
}
