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

TEST(LimitsInTurn, ReadsLimitsOfEarlierYearsInTodaysOrder) {
  std::string warning;
  EXPECT_EQ(limitsInTurn(std::vector<double>{-1., 1., -2., 2.}, warning), (std::vector<double>{-1., -2., 1., 2.}));
  EXPECT_NE(warning.find("[-1 -2 1 2]"), std::string::npos);
  EXPECT_EQ(limitsInTurn(std::vector<double>{-1., 1., -1., 1.}, warning), (std::vector<double>{-1., -1., 1., 1.}));
  EXPECT_FALSE(limitsInTurn(std::vector<double>{-1., -2., 1., 2.}, warning));  // today's order
  EXPECT_FALSE(limitsInTurn(std::vector<double>{2., -1., 1., 3.}, warning));   // neither
  EXPECT_FALSE(limitsInTurn(std::vector<double>{1., -1.}, warning));
}

TEST(LimitsInTurn, HoldsForFilesAndForCalls) {
  Config config;
  config.addText("a: {} b (a): { joint: transXY, limits: [-1 1 -2 2] }");
  const std::vector<std::string> warnings = config.takeWarnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("[-1 -2 1 2]"), std::string::npos);
  config.getFrame("b").setJoint(JointType::transXY, {-1., 1., -1., 1.});
  expectError<ValueError>(
      [&] {
        config.getFrame("b").setJoint(JointType::transXY, {1., -1., 2., -2.});
      },
      {"frame 'b'", "a lower limit is above its upper limit"});
}
