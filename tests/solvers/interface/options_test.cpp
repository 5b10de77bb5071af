#include "kinegraph/solvers/interface/options.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/field_count.h"

using namespace kinegraph;

TEST(SolverOptions, DefaultsAreValid) { EXPECT_NO_THROW(SolverOptions{}.validate()); }

TEST(SolverOptions, AllFieldsAreInTheTable) {
  EXPECT_EQ(std::size_t(fieldCount<SolverOptions>()), solverOptionTable().rows().size());
}

TEST(SolverOptions, AFieldThatMakesNoSenseIsNamedWithItsValue) {
  const auto wrong = [](const char* name, auto member, auto given, const char* shown) {
    SolverOptions options;
    options.*member = given;
    expectError<ValueError>([&] { options.validate(); }, {name, shown, "expected"});
  };
  wrong("stopTolerance", &SolverOptions::stopTolerance, 0., "0");
  wrong("stepMax", &SolverOptions::stepMax, -1., "-1");
  wrong("muInit", &SolverOptions::muInit, NAN, "nan");
  wrong("muMax", &SolverOptions::muMax, INFINITY, "inf");
  wrong("damping", &SolverOptions::damping, -.5, "-0.5");
  wrong("damping", &SolverOptions::damping, NAN, "nan");
  wrong("muInc", &SolverOptions::muInc, 1., "1");
  wrong("stopEvals", &SolverOptions::stopEvals, 0, "0");
  wrong("wolfe", &SolverOptions::wolfe, NAN, "nan");
  wrong("wolfe", &SolverOptions::wolfe, 1., "1");
  wrong("stopGTolerance", &SolverOptions::stopGTolerance, NAN, "nan");
}

TEST(SolverOptions, ToleranceOfConstraintsIsTheirOwnOrThatOfSteps) {
  SolverOptions options;
  EXPECT_EQ(options.constraintTolerance(), 1e-4);
  options.stopTolerance = 1e-2;
  EXPECT_EQ(options.constraintTolerance(), 1e-4);
  options.stopTolerance = 1e-6;
  EXPECT_EQ(options.constraintTolerance(), 1e-6);
  options.stopGTolerance = .5;
  EXPECT_EQ(options.constraintTolerance(), .5);
}
