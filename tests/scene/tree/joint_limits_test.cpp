#include "kinegraph/scene/tree/joint_limits.h"

#include <gtest/gtest.h>

#include <vector>

#include "kinegraph/scene/config.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

TEST(LimitsError, IsNoneWhereAllLowerLimitsAreBelowTheUpperOnes) {
  EXPECT_EQ(limitsError(std::vector<double>{-1., 1.}), "");
  EXPECT_EQ(limitsError(std::vector<double>{2., 2.}), "");  // one dof that is held
  EXPECT_EQ(limitsError(std::vector<double>{-1., -2., 1., 2.}), "");
  EXPECT_EQ(limitsError(std::vector<double>{0., 0., 0., 0.}), "");
}

TEST(LimitsError, SuggestsSwappedLimitsInTheRightOrder) {
  EXPECT_EQ(limitsError(std::vector<double>{1., -1.}),
            "the lower limit 1 is above the upper limit -1; expected [lower, upper]: [-1 1]");
  EXPECT_EQ(limitsError(std::vector<double>{2., -1., 1., 3.}),
            "a lower limit is above its upper limit: that of dof 0 is 2, and 1; all lower limits come first, then all "
            "upper ones: [1 -1 2 3] if only these are swapped");
  EXPECT_EQ(limitsError(std::vector<double>{-1., 1.}), "");
  EXPECT_EQ(limitsError(std::vector<double>{1., -1., 2., 3.}), "");  // the advice
}

TEST(LimitsError, WritesLimitsOfEarlierYearsAsTheyAreWrittenToday) {
  for (const std::vector<double>& limits : {std::vector<double>{-1., 1., -2., 2.}, {-1., 1., -1., 1.}}) {
    EXPECT_NE(limitsError(limits).find("all lower limits come first"), std::string::npos);
  }
  EXPECT_NE(limitsError(std::vector<double>{-1., 1., -2., 2.}).find("[-1 -2 1 2]"), std::string::npos);
}

TEST(LimitsError, IsReportedForFilesAndForCalls) {
  Config config;
  expectError<ParseError>([&] { config.addText("a: {} b (a): { joint: transXY, limits: [-1 1 -2 2] }"); },
                          {"all lower limits come first", "[-1 -2 1 2]"});
  config.addText("a: {} b (a): {}");
  expectError<ValueError>(
      [&] {
        config.getFrame("b").setJoint(JointType::transXY, {-1., 1., -1., 1.});
      },
      {"frame 'b'", "[-1 -1 1 1]"});
}
