#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "kinegraph/common/errors.h"
#include "kinegraph/tool_paths/tool_curve.h"

namespace kinegraph {
namespace {

ToolPath gcode(const std::string& text, double blend = 0.) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / "kinegraph_program.nc";
  std::ofstream(file) << text;
  return ToolPath::readGcode(file.string(), "tool", "", blend);
}

std::string gcodeError(const std::string& text) {
  try {
    gcode(text);
  } catch (const ParseError& error) {
    return error.what();
  }
  return "";
}

/// A slot with round ends, as a program for mills has it: mm, mm per minute, clockwise.
TEST(ReadGcode, ReadsLinesArcsAndFeeds) {
  const ToolPath path = gcode(R"(% (a slot)
N10 G21 G17 G90
N20 G0 Z5
N30 G0 X10 Y-5
N40 G1 Z0 F600
X40 F1200
G3 Y5 I0 J5
G1 X10
G3 X10 Y-5 R5
G0 Z5
M30
G1 X1000
)");
  ASSERT_TRUE(path.first());
  EXPECT_TRUE(path.first()->p.isApprox(Vector3d(.01, -.005, .005)));
  ASSERT_EQ(path.elements().size(), 6u);
  const ToolCurve curve(path, Pose(), {1e-6, 1e-5});
  EXPECT_NEAR(curve.length(), .005 + 2. * .03 + 2. * std::numbers::pi * .005 + .005, 1e-7);
  EXPECT_DOUBLE_EQ(curve.speedAt(.001), .01);
  EXPECT_DOUBLE_EQ(curve.speedAt(.02), .02);
  EXPECT_DOUBLE_EQ(curve.speedAt(curve.length() - 1e-3), 0.);
  EXPECT_EQ(curve.speedChanges().size(), 2u);
  const double middle_of_arc = .005 + .03 + .5 * std::numbers::pi * .005;
  EXPECT_LT((curve.at(middle_of_arc).p - Vector3d(.045, 0., 0.)).norm(), 1e-6);
  const double second_arc = middle_of_arc + .03 + std::numbers::pi * .005;
  EXPECT_LT((curve.at(second_arc).p - Vector3d(.005, 0., 0.)).norm(), 1e-6);
}

TEST(ReadGcode, ReadsInchesIncrementsPlanesAndHelices) {
  const ToolPath inches = gcode("G20 G91\nG1 X1 F60\nG1 Y-2\n");
  EXPECT_TRUE(inches.elements()[1].waypoints[0].p.isApprox(Vector3d(.0254, -.0508, 0.)));
  EXPECT_NEAR(inches.elements()[0].speed, .0254, 1e-12);
  // G2 about +y seen from +y is clockwise: from +x (10 mm) a quarter turn leads to +z.
  const ToolCurve side(gcode("G0 X10 Y0 Z0\nG18 G2 X0 Z10 I-10 K0 F600\n"), Pose(), {1e-6, 1e-5});
  EXPECT_NEAR(side.length(), .5 * std::numbers::pi * .01, 1e-7);
  EXPECT_LT((side.at(.5 * side.length()).p - .01 * Vector3d(std::sqrt(.5), 0., std::sqrt(.5))).norm(), 1e-6);
  const ToolCurve helix(gcode("G0 X10 Y0 Z0\nG2 X10 Y0 Z-4 I-10 F600\n"), Pose(), {1e-6, 1e-5});
  EXPECT_NEAR(helix.length(), std::hypot(2. * std::numbers::pi * .01, .004), 1e-7);
  EXPECT_LT((helix.at(.25 * helix.length()).p - Vector3d(0., -.01, -.001)).norm(), 1e-6);
  const ToolCurve large(gcode("G0 X10 Y0 Z0\nG2 X0 Y10 R-10 F600\n"), Pose(), {1e-6, 1e-5});
  EXPECT_NEAR(large.length(), 1.5 * std::numbers::pi * .01, 1e-7);
}

TEST(ReadGcode, BlendsAreThoseOfG64) {
  const ToolPath path = gcode("G0 X0 Y0 Z0\nG1 X10 F600\nG64 P2\nY10\nG61\nX0\n", .001);
  EXPECT_DOUBLE_EQ(path.elements()[0].blend, 0.);  // no corner at its start
  EXPECT_DOUBLE_EQ(path.elements()[1].blend, .002);
  EXPECT_DOUBLE_EQ(path.elements()[2].blend, 0.);
  EXPECT_DOUBLE_EQ(gcode("G0 X0 Y0 Z0\nG1 X10 F600\nY10\n", .001).elements()[1].blend, .001);
}

/// The head and the end that programs for mills with automatic tool changers have.
TEST(ReadGcode, MovesOfTheMachineAreNotPartOfThePath) {
  const std::string moves = "G0 X0 Y0\nG43 Z5 H1\nG1 Z0 F600\nX10\n";
  const ToolPath path = gcode("G21 G90 G94\nG28 G91 Z0\nG90\nT1 M6\n" + moves + "G53 G0 Z0\nG91 G28 X0 Y0\nM30\n");
  ASSERT_EQ(path.elements().size(), 2u);
  EXPECT_TRUE(path.first()->p.isApprox(Vector3d(0., 0., .005)));
  EXPECT_TRUE(path.elements()[1].waypoints[0].p.isApprox(Vector3d(.01, 0., 0.)));
  ASSERT_EQ(path.warnings().size(), 7u);
  EXPECT_NE(path.warnings()[0].find(".nc:2:1: the move with G28 is ignored"), std::string::npos) << path.warnings()[0];
  EXPECT_NE(path.warnings()[3].find(".nc:6:1: G43 (tool length) is ignored"), std::string::npos) << path.warnings()[3];
}

TEST(ReadGcode, CentersAreRelativeUnlessG90Point1) {
  const ToolCurve curve(gcode("\xef\xbb\xbfG90.1\nG0 X10 Y10 Z0\nG2 X30 Y10 I20 J10 F600\n"), Pose(), {1e-6, 1e-5});
  EXPECT_LT((curve.at(.5 * curve.length()).p - Vector3d(.02, .02, 0.)).norm(), 1e-6);
  const ToolCurve same(gcode("G90.1\nG91.1\nG0 X10 Y10 Z0\nG2 X30 Y10 I10 J0 F600\n"), Pose(), {1e-6, 1e-5});
  EXPECT_LT((same.at(.5 * same.length()).p - Vector3d(.02, .02, 0.)).norm(), 1e-6);
}

TEST(ReadGcode, NamesWhatItIgnoresAndWhatItDoesNotKnow) {
  const ToolPath path = gcode("M3 S8000\nG0 X0 Y0 Z0\nG1 X10 F600\nG4 P2\n");
  ASSERT_EQ(path.warnings().size(), 3u);
  EXPECT_NE(path.warnings()[1].find(".nc:1:4: S8000 is ignored"), std::string::npos) << path.warnings()[1];
  EXPECT_NE(gcodeError("G0 X0\nG1 X5 G81 Z1\n").find(".nc:2:7: unknown code G81"), std::string::npos);
  EXPECT_NE(gcodeError("G1 X5 A90\n").find(".nc:1:7: the axis A"), std::string::npos);
  EXPECT_NE(gcodeError("G1 X5 X6\n").find(".nc:1:7: the line has two words X"), std::string::npos);
  EXPECT_NE(gcodeError("G1 Xa\n").find(".nc:1:4: 'X' has no number"), std::string::npos);
  EXPECT_NE(gcodeError("G0 X0 Y0 Z0\nG2 X10 I3 J1\n").find("from its center"), std::string::npos);
  EXPECT_NE(gcodeError("G0 X0 Y0 Z0\nG2 X10 R3\n").find(".nc:2:8: R is 3"), std::string::npos);
  EXPECT_NE(gcodeError("G0 X0 Y0 Z0\nG2 X10\n").find("either I, J, K or R"), std::string::npos);
  EXPECT_NE(gcodeError("(nothing)\n").find("no move"), std::string::npos);
}

TEST(ReadGcode, RefusesCodesThatNoNumberHolds) {
  EXPECT_NE(gcodeError("G99999999999 X1\n").find("is no code"), std::string::npos);
}

}  // namespace
}  // namespace kinegraph
