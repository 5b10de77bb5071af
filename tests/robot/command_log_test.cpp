#include "kinegraph/robot/command_log.h"

#include <gtest/gtest.h>

#include <locale>

#include "tests/robot/arm.h"
#include "tests/support/expect_error.h"
#include "tests/support/temporary_folder.h"

using namespace kinegraph;

namespace {

CommandLog sample() {
  CommandLog log;
  log.period = 1. / 3.;
  MatrixXd points(3, 2);
  points << 0., .1, 1. / 7., -2e-300, 3., 1e300;
  const BSpline motion(3, points, Vector3d(0., 1. / 3., 1.));
  log.entries = {{0, FollowSpline{motion}},
                 {2, GripperCommand{1, true, .05, .1, 10., "a \"thing\" with spaces"}},
                 {2, GripperCommand{0, false, .07, .2, 30., {}}},
                 {3, HoldRobot{motion}},
                 {4, FloatRobot{.5}},
                 {5, SetStiffness{Eigen::Matrix2d::Identity() / 3.}},
                 {5, SetStiffness{}},
                 {6, AttachFrames{"hand", "box", true}},
                 {7, AttachFrames{"hand", "box", false}},
                 {8, PlaceFrame{"box", Pose({1., 2., 1. / 3.}, Quaterniond(0., 1., 0., 0.))}},
                 {9, RecoverRobot{}}};
  log.ticks = 12;
  return log;
}

}  // namespace

TEST(CommandLog, ReadsBackWhatItWrote) {
  const CommandLog log = sample(), again = CommandLog::fromText(log.text());
  EXPECT_EQ(again.text(), log.text());
  EXPECT_EQ(again.period, log.period);
  EXPECT_EQ(again.ticks, 12);
  ASSERT_EQ(again.entries.size(), log.entries.size());
  const auto& motion = std::get<FollowSpline>(again.entries[0].command).motion;
  EXPECT_EQ(motion.eval(.4), std::get<FollowSpline>(log.entries[0].command).motion.eval(.4));
  EXPECT_EQ(std::get<GripperCommand>(again.entries[1].command).object, "a \"thing\" with spaces");
  EXPECT_TRUE(std::get<GripperCommand>(again.entries[1].command).grasp);
  EXPECT_EQ(std::get<SetStiffness>(again.entries[5].command).stiffness(1, 1), 1. / 3.);
  EXPECT_EQ(std::get<PlaceFrame>(again.entries[9].command).pose.numbers(),
            std::get<PlaceFrame>(log.entries[9].command).pose.numbers());
}

TEST(CommandLog, IsSavedAndLoaded) {
  const TemporaryFolder folder;
  const std::string path = (folder / "log.txt").string();
  sample().save(path);
  EXPECT_EQ(CommandLog::load(path).text(), sample().text());
  expectError<FileError>([&] { CommandLog::load((folder / "missing").string()); }, {"cannot read", "missing"});
  expectError<FileError>([&] { sample().save((folder / "missing/log").string()); }, {"cannot write"});
}

TEST(CommandLog, IsWrittenAndReadInTheCLocaleWhateverThatOfTheProgram) {
  struct CommaAndDots final : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
  };
  CommandLog log = sample();
  log.ticks = 1635;
  const std::string text = log.text();
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new CommaAndDots));
  const std::string with_commas = log.text();
  long ticks = 0;
  try {
    ticks = CommandLog::fromText(text).ticks;
  } catch (const Error& error) {
    ADD_FAILURE() << error.what();
  }
  std::locale::global(before);
  EXPECT_EQ(with_commas, text);
  EXPECT_NE(text.find("1635 end"), std::string::npos);
  EXPECT_EQ(ticks, 1635);
}

TEST(CommandLog, SaysWhereATextIsNone) {
  const std::string head = "kinegraph commands 1\nperiod 0.01\n";
  const auto fails = [](const std::string& text, std::initializer_list<const char*> parts) {
    expectError<ParseError>([&] { CommandLog::fromText(text, "log"); }, parts);
  };
  fails("", {"log:1:1", "kinegraph commands"});
  fails("kinegraph commands 1\nperiod -1\n", {"log:2:1", "above 0"});
  fails(head + "1 jump 3\n", {"log:3:1", "unknown command 'jump'"});
  fails(head + "5 recover\n4 recover\n", {"log:4:1", "control period 4 follows 5"});
  fails(head + "1 follow 3 2 0 1 0 0\n", {"log:3:1", "knots"});
  fails(head + "1 follow 3 x\n", {"'x' is not a number"});
  fails(head + "1 gripper 0 .1 .2\n", {"ends too early"});
  fails(head + "1 stiffness 100000 100000 1\n", {"expected at most 1e7"});
  fails(head + "1 end\n2 recover\n", {"a line follows the end"});
}
