#include "kinegraph/solvers/nlp_solver.h"

#include <gtest/gtest.h>

#include "kinegraph/nlp/problems.h"
#include "tests/solvers/numbers.h"
#include "tests/support/expect_error.h"
#include "tests/support/near.h"

using namespace kinegraph;
using enum ObjectiveType;

namespace {

using Verdict = Explanation::Verdict;

/// A x - b
CallbackNlp linear(std::vector<ObjectiveType> types, const MatrixXd& A, const VectorXd& b, const VectorXd& lower = {},
                   const VectorXd& upper = {}) {
  return CallbackNlp(int(A.cols()), std::move(types), lower, upper,
                     [A, b](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
                       phi = A * x - b;
                       J = A;
                     });
}

}  // namespace

TEST(Explanation, HasNothingToSayWhereAllConstraintsHold) {
  CallbackNlp nlp = linear({sos, eq}, MatrixXd::Identity(2, 2), vec({5., 1.}));
  const Explanation out = explain(nlp, vec({0., 1.}));
  EXPECT_EQ(out.verdict, Verdict::holds);
  EXPECT_TRUE(out.conflicts.empty());
  EXPECT_EQ(out.str(), "All constraints hold to 0.001.");
}

TEST(Explanation, SaysWhenAProblemIsOnlyNotSolvedYet) {
  CallbackNlp nlp = linear({sos, eq}, MatrixXd::Identity(2, 2), vec({5., 1.}));
  const Explanation out = explain(nlp, vec({0., 3.}));
  EXPECT_EQ(out.verdict, Verdict::not_reached);
  ASSERT_EQ(out.conflicts.size(), 1u);
  EXPECT_DOUBLE_EQ(out.conflicts[0].violation.scaled, 2.);
  EXPECT_NE(out.str().find("solve (again)"), std::string::npos);
}

TEST(Explanation, TwoEqualitiesThatContradictEachOtherShareTheLeastViolation) {
  // x = 0 and x = 1, where y = 2 and x <= 5 are no part of it
  MatrixXd A(4, 2);
  A << 1., 0., 1., 0., 0., 1., 1., 0.;
  CallbackNlp nlp = linear({eq, eq, eq, ineq}, A, vec({0., 1., 2., 5.}));
  const Explanation out = explain(nlp, vec({7., -3.}));
  EXPECT_EQ(out.verdict, Verdict::conflict);
  EXPECT_TRUE(near(out.x, vec({.5, 2.}), 1e-5)) << "the least squares";
  ASSERT_EQ(out.conflicts.size(), 2u);
  for (const Conflict& conflict : out.conflicts) {
    EXPECT_NEAR(conflict.violation.scaled, .5, 1e-5);
    EXPECT_TRUE(conflict.suffices);
    EXPECT_NEAR(conflict.relaxation.scaled, 1., 1e-3) << "its relaxation alone is all of it";
  }
  EXPECT_GE(out.best, 0);
  EXPECT_NE(out.str().find("row 0 (eq) is violated by 0.5"), std::string::npos) << out.str();
}

TEST(Explanation, NamesTheBoundThatIsInTheWay) {
  CallbackNlp nlp = linear({eq}, MatrixXd::Identity(1, 2), vec({3.}), vec({-1., -1.}), vec({1., 1.}));
  const Explanation out = explain(nlp, vec({0., 0.}));
  EXPECT_EQ(out.verdict, Verdict::conflict);
  ASSERT_EQ(out.conflicts.size(), 2u);
  EXPECT_TRUE(out.conflicts[1].is_bound);
  EXPECT_EQ(out.conflicts[1].name, "upper limit of variable 0");
  EXPECT_NEAR(out.conflicts[1].pull, 4., 1e-4) << "d/dx (x - 3)^2 at 1";
  EXPECT_TRUE(out.conflicts[0].suffices && out.conflicts[1].suffices);
  EXPECT_NEAR(out.conflicts[0].relaxation.scaled, 2., 1e-3);
  EXPECT_NEAR(out.conflicts[1].relaxation.scaled, 2., 1e-3);
}

TEST(Explanation, TheOneThatHelpsIsFoundAmongOnesThatDoNot) {
  // x = 0, x = 1, x = 1.1 on the line; y <= 0 and y = x: giving up x = 0 is not enough, no single one is
  MatrixXd A = MatrixXd::Ones(3, 1);
  CallbackNlp three = linear({eq, eq, eq}, A, vec({0., 1., 1.1}));
  const Explanation out = explain(three, vec({0.}));
  ASSERT_GE(out.best, 0);
  EXPECT_EQ(out.conflicts[out.best].rows, std::vector<int>{0});
  EXPECT_FALSE(out.conflicts[out.best].suffices);
  EXPECT_NEAR(out.conflicts[out.best].remaining, .05, 5e-3) << "between 1 and 1.1";
  // x = 0, x = 1 and x >= 1: giving up x = 0 is enough
  MatrixXd B(3, 1);
  B << 1., 1., -1.;
  CallbackNlp one = linear({eq, eq, ineq}, B, vec({0., 1., -1.}));
  const Explanation second = explain(one, vec({.2}));
  ASSERT_GE(second.best, 0);
  EXPECT_EQ(second.conflicts[second.best].rows, std::vector<int>{0});
  EXPECT_TRUE(second.conflicts[second.best].suffices);
  EXPECT_NEAR(second.conflicts[second.best].relaxation.scaled, 1., 1e-3);
}

TEST(Explanation, EndsWhereWhatIsCalledInBetweenThrows) {
  MatrixXd A(2, 1);
  A << 1., 1.;
  CallbackNlp nlp = linear({eq, eq}, A, vec({0., 1.}));
  int asked = 0;
  EXPECT_THROW(explain(nlp, vec({7.}), 1e-3,
                       [&] {
                         if (++asked == 2) throw std::runtime_error("stop");
                       }),
               std::runtime_error);
  EXPECT_EQ(asked, 2);
  asked = -1000;
  EXPECT_EQ(explain(nlp, vec({7.}), 1e-3, [&] { ++asked; }).verdict, Verdict::conflict);
  EXPECT_GT(asked, -1000);
}

TEST(Explanation, ReportsNumbersThatAreNotFiniteByTheirRow) {
  CallbackNlp nlp(1, {sos, eq}, {}, {}, [](const VectorXd& x, VectorXd& phi, MatrixXd& J) {
    phi << x[0], std::nan("");
    J.setOnes();
  });
  expectError<ValueError>([&] { explain(nlp, vec({0.})); }, {"row 1", "nan"});
}

TEST(Amount, SpeaksInMetersAndRadians) {
  EXPECT_EQ(Amount{.scaled = .5}.str(), "0.5 (scaled)");
  EXPECT_EQ((Amount{.scaled = 1., .meters = .0031}.str()), "3.1 mm");
  EXPECT_EQ((Amount{.scaled = 1., .meters = .031}.str()), "3.1 cm");
  EXPECT_EQ((Amount{.scaled = 1., .meters = 2.5, .radians = .2}.str()), "2.5 m and 0.2 rad");
  EXPECT_EQ((Amount{.scaled = 1., .radians = .2, .time_order = 1}.str()), "0.2 rad/s");
}
