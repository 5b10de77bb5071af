#include "kinegraph/control/target_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

TEST(TargetFile, PositionsGoStraightAndRotationsTurnEvenly) {
  const TargetFile targets = TargetFile::fromText(
      "t, x, y, z, qw, qx, qy, qz\n# a turn about z\n1, 0, 0, 1, 1, 0, 0, 0\r\n\n+3, 2, 0, 1, 0, 0, 0, -2");
  EXPECT_EQ(targets.duration(), 3.);
  const double angle = std::numbers::pi / 8.;  // half of a quarter of the turn
  EXPECT_TRUE(targets(1.5).isApprox(VectorXd{{.5, 0., 1., std::cos(angle), 0., 0., -std::sin(angle)}}, 1e-14));
  EXPECT_TRUE(targets(0.).isApprox(VectorXd{{0., 0., 1., 1., 0., 0., 0.}}));
  EXPECT_TRUE(targets(9.).isApprox(VectorXd{{2., 0., 1., 0., 0., 0., -1.}}));
  EXPECT_TRUE(TargetFile::fromText("0, 1, 2, 3\n")(5.).isApprox(Vector3d(1., 2., 3.)));
}

TEST(TargetFile, TheShortWayIsTaken) {
  const TargetFile targets = TargetFile::fromText("0, 0,0,0, 1,0,0,0\n1, 0,0,0, -1,0,0,0\n");
  EXPECT_TRUE(targets(.5).isApprox(VectorXd{{0., 0., 0., 1., 0., 0., 0.}}));
}

TEST(TargetFile, MistakesAreNamedWithTheirPlace) {
  const auto refused = [](const char* text, std::initializer_list<const char*> said) {
    expectError<ParseError>([&] { TargetFile::fromText(text, "way.csv"); }, said);
  };
  refused("0, 1, 2\n", {"way.csv:1:1: 3 numbers", "expected t, x, y, z"});
  refused("0, 1, 2, 3\n1, 1, 2, 3, 1, 0, 0, 0\n", {"way.csv:2:1: 8 numbers", "4"});
  refused("0, 1, 2, 3\n0, 1, 2, 3\n", {"way.csv:2:1: time 0 does not come after 0"});
  refused("0, 1, 2, 3\n1, 1, 2, inf\n", {"way.csv:2:10: 'inf' is not finite"});
  refused("0, 1, two, 3\n", {"way.csv:1:7: 'two' is not a number"});
  refused("0, 1, , 3\n", {"way.csv:1:6: '' is not a number"});
  refused("0, 1, 2, 3, 0, 0, 0, 0\n", {"way.csv:1:1: the quaternion is zero"});
  refused("t, x, y, z\n", {"way.csv:2:1: the text has no poses"});
  expectError<FileError>([] { TargetFile("nowhere.csv"); }, {"nowhere.csv"});
}
