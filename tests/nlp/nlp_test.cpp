#include "kinegraph/nlp/nlp.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/problems.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;

namespace {

using enum ObjectiveType;

/// Rows over windows of three variables, one of them with a second window far away: as in a path with a goal.
class Windows final : public Nlp {
 public:
  static constexpr int kVariables = 9;

  Windows() {
    lower_ = VectorXd::Constant(kVariables, -1.);
    upper_ = VectorXd::Constant(kVariables, 2.);
    types_ = {sos, eq, ineq, sos};
  }

  Jacobian makeJacobian() const override {
    Jacobian J;
    J.columns = kVariables;
    J.addRow({{0, 3}});
    J.addRow({{1, 3}});
    J.addRow({{6, 3}});
    J.addRow({{5, 2}, {0, 2}});
    return J;
  }

  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    phi << x[0] * x[1] + x[2], x[1] - x[2] * x[3], std::sin(x[6]) + x[7] * x[8], x[5] * x[6] - x[0] * x[1] * x[1];
    if (!J) return;
    J->values = {
        x[1], x[0], 1., 1., -x[3], -x[2], std::cos(x[6]), x[8], x[7], x[6], x[5], -x[1] * x[1], -2. * x[0] * x[1]};
  }
};

/// The same residuals with a dense Jacobian.
CallbackNlp denseWindows() {
  return CallbackNlp(9, {sos, eq, ineq, sos}, VectorXd::Constant(9, -1.), VectorXd::Constant(9, 2.),
                     [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                       phi << x[0] * x[1] + x[2], x[1] - x[2] * x[3], std::sin(x[6]) + x[7] * x[8],
                           x[5] * x[6] - x[0] * x[1] * x[1];
                       J.row(0).head(3) << x[1], x[0], 1.;
                       J.row(1).segment(1, 3) << 1., -x[3], -x[2];
                       J.row(2).tail(3) << std::cos(x[6]), x[8], x[7];
                       J.row(3).segment(5, 2) << x[6], x[5];
                       J.row(3).head(2) << -x[1] * x[1], -2. * x[0] * x[1];
                     });
}

VectorXd somewhere(const Nlp& nlp, int seed) {
  Rng rng(std::uint64_t(seed) + 1);
  return nlp.uniformPoint(rng);
}

}  // namespace

TEST(Nlp, EvaluateSizesPhiAndRefusesAnXOrJOfAnotherSize) {
  CallbackNlp nlp(2, {sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0], x[1];
    J.setIdentity();
  });
  const auto formula = makeTestProblem("Rosenbrock");
  for (Nlp* problem : std::initializer_list<Nlp*>{&nlp, formula.get()}) {
    VectorXd phi;
    problem->evaluate(VectorXd::Ones(2), phi, nullptr);
    EXPECT_EQ(phi.size(), Eigen::Index(problem->types().size()));
    EXPECT_TRUE(phi.allFinite());
    expectError<ValueError>([&] { problem->evaluate(VectorXd::Ones(3), phi, nullptr); },
                            {"Nlp::evaluate: x has 3 entries; the problem has 2 variables"});
    Jacobian J;
    expectError<ValueError>([&] { problem->evaluate(VectorXd::Ones(2), phi, &J); },
                            {"Nlp::evaluate: J is 0 x 0; expected ", " x 2, the sizes of makeJacobian()"});
  }
}

TEST(Jacobian, InSegmentsEqualsTheDenseOne) {
  Windows windows;
  CallbackNlp dense = denseWindows();
  Jacobian J = windows.makeJacobian(), J_dense = dense.makeJacobian();
  VectorXd phi(4), phi_dense(4);
  for (int sample = 0; sample < 5; ++sample) {
    const VectorXd x = somewhere(windows, sample), v = somewhere(windows, sample + 100);
    windows.evaluate(x, phi, &J);
    dense.evaluate(x, phi_dense, &J_dense);
    EXPECT_EQ(phi, phi_dense);
    EXPECT_EQ(J.toDense(), J_dense.toDense());
    for (int row = 0; row < J.rows(); ++row) {
      EXPECT_NEAR(J.rowTimes(row, v), J_dense.toDense().row(row).dot(v), 1e-14);
      VectorXd sum = v;
      J.addRowTo(row, -2., sum);
      EXPECT_TRUE(near(sum, v - 2. * J_dense.toDense().row(row).transpose(), 1e-14));
    }
  }
}

TEST(Jacobian, SegmentsThatOverlapAddUp) {
  Jacobian J;
  J.columns = 4;
  J.addRow({{0, 3}, {2, 2}});
  J.values = {1, 2, 3, 4, 5};
  EXPECT_EQ(J.toDense(), (MatrixXd(1, 4) << 1, 2, 7, 5).finished());
}

TEST(CheckJacobian, OfARightOneFindsNothing) {
  Windows windows;
  for (int sample = 0; sample < 5; ++sample) EXPECT_LT(checkJacobian(windows, somewhere(windows, sample)).error, 1e-9);
}

TEST(CheckJacobian, FindsAPlantedErrorAndSaysWhereItIs) {
  CallbackNlp wrong(3, {sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] * x[1], x[1] * x[2];
    J << x[1], x[0], 0., 0., x[2], x[1] + .01;
  });
  const JacobianCheck check = checkJacobian(wrong, Vector3d(1., 2., 3.));
  EXPECT_NEAR(check.error, .01 / 2., 1e-8);
  EXPECT_EQ(check.row, 1);
  EXPECT_EQ(check.column, 2);
  EXPECT_NEAR(check.analytic, 2.01, 1e-12);
  EXPECT_NEAR(check.numeric, 2., 1e-8);
}

TEST(CheckJacobian, ReportsNumbersThatAreNotFinite) {
  CallbackNlp nan(2, {sos, sos}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi = x;
    J << 1., 0., NAN, 1.;
  });
  const JacobianCheck check = checkJacobian(nan, Eigen::Vector2d(1., 1.));
  EXPECT_FALSE(check.error < 1.);
  EXPECT_EQ(check.row, 1);
  EXPECT_EQ(check.column, 0);
}

TEST(CheckJacobian, LeavesTheProblemAtThePointThatWasGiven) {
  VectorXd last;
  CallbackNlp nlp(2, {sos}, {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    last = x;
    phi << x.squaredNorm();
    J = 2. * x.transpose();
  });
  checkJacobian(nlp, Eigen::Vector2d(1., 2.));
  EXPECT_EQ(last, Eigen::Vector2d(1., 2.));
}

TEST(CheckJacobian, AsksBetweenColumnsAndEndsWhereThatThrows) {
  int evaluations = 0, asked = 0;
  CallbackNlp nlp(9, {f}, {}, {}, [&](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    ++evaluations;
    phi << x.squaredNorm();
    J = 2. * x.transpose();
  });
  const CancellationToken stop = [&] {
    if (++asked == 3) throw std::runtime_error("stop");
  };
  EXPECT_THROW(checkJacobian(nlp, VectorXd::Ones(9), 1e-5, stop), std::runtime_error);
  EXPECT_EQ(evaluations, 1 + 2 * 2) << "at x, and twice for each of two columns";
  EXPECT_THROW(worstJacobianEntries(nlp, VectorXd::Ones(9), 1e-4, 5, 1e-5, [&] { throw std::runtime_error("stop"); }),
               std::runtime_error);
}

TEST(CheckJacobian, ListsTheWorstEntriesFirst) {
  CallbackNlp wrong(2, {sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0] + 2. * x[1], x[0] - x[1];
    J << 1., 2.6, 1.25, -1.;
  });
  const auto entries = worstJacobianEntries(wrong, Eigen::Vector2d(1., 2.), 1e-4, 5);
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].row, 0) << ".6 of 2, and .25 of 1";
  EXPECT_NEAR(entries[1].analytic, 1.25, 1e-12);
  EXPECT_EQ(worstJacobianEntries(wrong, Eigen::Vector2d(1., 2.), 1e-4, 1).size(), 1u);
  EXPECT_TRUE(worstJacobianEntries(wrong, Eigen::Vector2d(1., 2.), 1., 5).empty());
}

namespace {

/// f = x^3 y and the square of x - y; its Hessian as it is, or doubled.
class Cubic final : public Nlp {
 public:
  explicit Cubic(double factor) : factor_(factor) {
    lower_ = VectorXd::Constant(2, -2.);
    upper_ = VectorXd::Constant(2, 2.);
    types_ = {f, sos};
  }
  void evaluate(const VectorXd& x, VectorXd& phi, Jacobian* J) override {
    phi.resize(2);
    phi << x[0] * x[0] * x[0] * x[1], x[0] - x[1];
    if (J) J->values = {3. * x[0] * x[0] * x[1], x[0] * x[0] * x[0], 1., -1.};
  }
  bool addCostHessian(const VectorXd& x, MatrixXd& H) override {
    H(0, 0) += factor_ * 6. * x[0] * x[1];
    H(0, 1) += factor_ * 3. * x[0] * x[0];
    H(1, 0) += factor_ * 3. * x[0] * x[0];
    return true;
  }

 private:
  double factor_;
};

}  // namespace

TEST(CheckHessian, FindsAWrongOne) {
  Cubic right(1.), wrong(2.);
  EXPECT_LT(checkHessian(right, Eigen::Vector2d(.5, -1.)).error, 1e-8);
  const JacobianCheck check = checkHessian(wrong, Eigen::Vector2d(.5, -1.));
  EXPECT_NEAR(check.error, 1., 1e-6);
  EXPECT_EQ(check.row, 0);
  EXPECT_NEAR(check.numeric, -3., 1e-6);
  Windows none;
  EXPECT_EQ(checkHessian(none, somewhere(none, 0)).row, -1) << "it has no f residuals";
}

TEST(EvaluateScalar, IsTheSumWithItsDerivatives) {
  Cubic cubic(1.);
  const Eigen::Vector2d x(.5, -1.);
  const ScalarEvaluation at = evaluateScalar(cubic, x);
  EXPECT_NEAR(at.value, -.125 + 2.25, 1e-12);
  EXPECT_TRUE(near(at.gradient, Eigen::Vector2d(-.75 + 3., .125 - 3.), 1e-12));
  EXPECT_TRUE(near(at.hessian, (MatrixXd(2, 2) << -3. + 2., .75 - 2., .75 - 2., 2.).finished(), 1e-12));
  Windows constrained;
  expectError<ValueError>([&] { evaluateScalar(constrained, somewhere(constrained, 0)); },
                          {"expected f or sos", "row 1 (eq)"});
}

TEST(CallbackNlp, SizesThatDoNotFitSayWhatWasExpected) {
  const auto nothing = [](const VectorXd&, VectorXd&, MatrixXd&) {};
  expectError<ValueError>([&] { CallbackNlp(3, {sos}, VectorXd::Zero(2), VectorXd::Ones(3), nothing); },
                          {"2 lower and 3 upper", "expected 3"});
  expectError<ValueError>([&] { CallbackNlp(-1, {}, {}, {}, nothing); }, {"dimension", "-1"});
  CallbackNlp wrong_rows(2, {sos, sos}, {}, {}, [](const VectorXd&, VectorXd& phi, MatrixXd&) { phi.setZero(3); });
  CallbackNlp wrong_columns(2, {sos}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd& J) { J.setZero(1, 5); });
  VectorXd phi;
  expectError<ValueError>([&] { wrong_rows.evaluate(VectorXd::Zero(2), phi, nullptr); }, {"size 3", "expected 2"});
  expectError<ValueError>([&] { wrong_columns.evaluate(VectorXd::Zero(2), phi, nullptr); }, {"1 x 5", "1 x 2"});
}

TEST(Nlp, PointsAreDrawnWithinTheBounds) {
  const double inf = std::numeric_limits<double>::infinity();
  CallbackNlp nlp(3, {sos}, Vector3d(2., -inf, -inf), Vector3d(3., inf, .5),
                  [](const VectorXd&, VectorXd&, MatrixXd&) {});
  Rng rng(3);
  VectorXd lowest = VectorXd::Constant(3, inf), highest = -lowest;
  for (int sample = 0; sample < 200; ++sample) {
    const VectorXd x = nlp.uniformPoint(rng);
    lowest = lowest.cwiseMin(x);
    highest = highest.cwiseMax(x);
  }
  EXPECT_GE(lowest[0], 2.);
  EXPECT_LE(highest[0], 3.);
  EXPECT_GT(highest[0] - lowest[0], .9);
  EXPECT_GE(lowest[1], -1.);
  EXPECT_LE(highest[1], 1.);
  EXPECT_LE(highest[2], .5) << "a bound on one side only";
}

TEST(SumErrors, AddsUpByType) {
  const std::vector<ObjectiveType> types = {f, sos, ineq, ineq, eq, eq, ineqB, ineqP, none};
  const VectorXd phi = (VectorXd(9) << -3, 2, .5, -4, -1, 2, .25, -1, 100).finished();
  const ErrorSums sums = sumErrors(types, phi);
  EXPECT_EQ(sums.f, -3.);
  EXPECT_EQ(sums.sos, 4.);
  EXPECT_EQ(sums.ineq, .75);
  EXPECT_EQ(sums.eq, 3.);
}

TEST(Violation, IsThatOfConstraintsOnly) {
  EXPECT_EQ(violation(eq, -.5), .5);
  EXPECT_EQ(violation(ineq, -.5), 0.);
  EXPECT_EQ(violation(ineq, .5), .5);
  EXPECT_EQ(violation(ineqB, .5), .5);
  EXPECT_EQ(violation(sos, .5), 0.);
  EXPECT_EQ(violation(f, .5), 0.);
}

TEST(CallbackNlp, TellsTheHessianOfItsCostTerms) {
  // Rosenbrock's function as one term f, whose Hessian is known.
  const auto residuals = [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    const double a = 1. - x[0], b = x[1] - x[0] * x[0];
    phi << a * a + 100. * b * b;
    J << -2. * a - 400. * x[0] * b, 200. * b;
  };
  const auto hessian = [](const VectorXd& x, MatrixXd& H) {
    H << 2. - 400. * (x[1] - 3. * x[0] * x[0]), -400. * x[0], -400. * x[0], 200.;
  };
  CallbackNlp without(2, {f}, {}, {}, residuals), with(2, {f}, {}, {}, residuals, hessian);
  const VectorXd x{{-.4, .7}};
  MatrixXd H = MatrixXd::Identity(2, 2), difference(2, 2);
  EXPECT_FALSE(without.addCostHessian(x, H));
  ASSERT_TRUE(with.addCostHessian(x, H));
  VectorXd phi;
  Jacobian high = with.makeJacobian(), low = with.makeJacobian();
  for (int i = 0; i < 2; ++i) {
    const VectorXd step = 1e-5 * VectorXd::Unit(2, i);
    with.evaluate(x + step, phi, &high);
    with.evaluate(x - step, phi, &low);
    for (int k = 0; k < 2; ++k) difference(k, i) = (high.values[std::size_t(k)] - low.values[std::size_t(k)]) / 2e-5;
  }
  EXPECT_NEAR((H - MatrixXd::Identity(2, 2) - difference).norm(), 0., 1e-6);

  CallbackNlp wrong(2, {f}, {}, {}, residuals, [](const VectorXd&, MatrixXd& other) { other.setZero(3, 3); });
  expectError<ValueError>([&] { wrong.addCostHessian(x, H); }, {"Hessian has shape 3 x 3; expected 2 x 2"});
}

TEST(CallbackNlp, ACancelledEvaluationIsAStandardException) {
  CallbackNlp nlp(1, {f}, {}, {}, [](const VectorXd&, VectorXd&, MatrixXd&) { throw EvaluationCancelled(); });
  VectorXd phi;
  EXPECT_THROW(nlp.evaluate(VectorXd::Zero(1), phi, nullptr), std::exception);
}
