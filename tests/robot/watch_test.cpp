#include <gtest/gtest.h>

#include "kinegraph/robot/bot_op.h"
#include "kinegraph/robot/drivers.h"
#include "tests/robot/arm.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

class Watch : public ::testing::Test {
 protected:
  Config C_ = twoJointArm();
  BotOp bot_{C_, std::make_shared<KinematicDriver>(C_)};
};

TEST_F(Watch, CallsAFunctionAtMultiplesOfItsPeriodUntilItReturnsFalse) {
  std::vector<double> times;
  bot_.watch(.05, [&](double time) {
    times.push_back(time);
    return times.size() < 8;
  });
  EXPECT_TRUE(times.empty());
  bot_.sync(C_, 1.);
  ASSERT_EQ(times.size(), 8u);
  for (std::size_t k = 0; k < times.size(); ++k) EXPECT_NEAR(times[k], .05 * double(k), 1e-9);
}

TEST_F(Watch, SeesOneStateAndMayHoldTheRobot) {
  bot_.moveTo(pair(1., 1.));
  bot_.watch(0., [&](double time) {
    EXPECT_EQ(bot_.get_t(), time);
    EXPECT_EQ(bot_.get_t(), time);
    if (bot_.get_q()[0] < .5) return true;
    bot_.hold();
    return false;
  });
  bot_.wait(C_);
  EXPECT_EQ(bot_.getMode(), LoopMode::hold);
  EXPECT_NEAR(bot_.get_q()[0], .5, .1);
}

TEST_F(Watch, HoldsTheRobotIfTheFunctionThrows) {
  bot_.moveTo(pair(1., 1.));
  bot_.watch(.1, [](double time) -> bool { return time < .25 ? true : throw FileError("full"); });
  EXPECT_THROW(bot_.wait(C_), FileError);
  EXPECT_EQ(bot_.getMode(), LoopMode::hold);
  bot_.sync(C_, .5);  // the function is gone
}

TEST_F(Watch, RefusesToWaitInsideAndBadPeriods) {
  bot_.watch(.1, [&](double) { return bot_.sync(C_, .1) == 0; });
  expectError<ValueError>([&] { bot_.sync(C_, .1); }, {"a function of watch cannot wait"});
  expectError<ValueError>([&] { bot_.watch(-1., [](double) { return true; }); }, {"period is -1 s"});
}

TEST_F(Watch, TheTargetOfAGripperIsItsLastCommand) {
  EXPECT_NEAR(bot_.getGripperTarget(0), bot_.getGripperPos(0), 1e-12);
  bot_.gripperMove(0, .03);
  EXPECT_EQ(bot_.getGripperTarget(0), .03);
  bot_.gripperClose(0);
  EXPECT_EQ(bot_.getGripperTarget(0), bot_.getInfo().grippers[0].min_width);
}

}  // namespace
