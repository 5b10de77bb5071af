#include "kinegraph/ik/ik_target.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/expect_error.h"
#include "tests/support/field_count.h"

using namespace kinegraph;

TEST(IkOptions, DefaultsAreValid) { EXPECT_NO_THROW(IkOptions{}.validate()); }

TEST(IkOptions, AllFieldsAreInTheTable) {
  EXPECT_EQ(std::size_t(fieldCount<IkOptions>()), ikOptionTable().rows().size());
}

TEST(IkOptions, AFieldThatMakesNoSenseIsNamedWithItsValue) {
  const auto wrong = [](const char* name, auto member, auto given, const char* shown) {
    IkOptions options;
    options.*member = given;
    expectError<ValueError>([&] { options.validate(); }, {"solveIk", name, shown, "expected"});
  };
  wrong("position_tolerance", &IkOptions::position_tolerance, 0., "0");
  wrong("rotation_tolerance", &IkOptions::rotation_tolerance, NAN, "nan");
  wrong("attempts", &IkOptions::attempts, 0, "0");
  wrong("steps", &IkOptions::steps, -2, "-2");
  wrong("margin", &IkOptions::margin, INFINITY, "inf");
  wrong("home_weight", &IkOptions::home_weight, -1., "-1");
}
