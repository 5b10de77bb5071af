#include "kinegraph/solvers/sampling/sampler.h"

#include <gtest/gtest.h>

#include "tests/support/expect_error.h"
#include "tests/support/field_count.h"

using namespace kinegraph;

TEST(SamplerOptions, DefaultsAreValid) { EXPECT_NO_THROW(SamplerOptions{}.validate()); }

TEST(SamplerOptions, AllFieldsAreInTheTable) {
  EXPECT_EQ(std::size_t(fieldCount<SamplerOptions>()), samplerOptionTable().rows().size());
}

TEST(SamplerOptions, AFieldThatMakesNoSenseIsNamedWithItsValue) {
  const auto wrong = [](const char* name, auto member, auto given, const char* shown) {
    SamplerOptions options;
    options.*member = given;
    expectError<ValueError>([&] { options.validate(); }, {name, shown, "expected"});
  };
  wrong("seedMethod", &SamplerOptions::seedMethod, "any", "'any'");
  wrong("seedAttempts", &SamplerOptions::seedAttempts, 0, "0");
  wrong("tolerance", &SamplerOptions::tolerance, 0., "0");
  wrong("downhillNoiseSigma", &SamplerOptions::downhillNoiseSigma, -1., "-1");
  wrong("ineqOverstep", &SamplerOptions::ineqOverstep, INFINITY, "inf");
  wrong("langevinTauPrime", &SamplerOptions::langevinTauPrime, NAN, "nan");
}
