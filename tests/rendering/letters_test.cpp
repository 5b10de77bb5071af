#include "kinegraph/rendering/letters.h"

#include <gtest/gtest.h>

#include <numeric>

#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph {
namespace {

using Lines = std::vector<std::string>;

/// All characters are one wide.
Lines broken(const std::string& text, int width) {
  const std::vector<int> ones(128, 1);
  return brokenLines(text, width, ones.data());
}

TEST(Letters, LinesThatFitStayAsTheyAre) { EXPECT_EQ(broken("one\ntwo words\n", 9), (Lines{"one", "two words", ""})); }

TEST(Letters, LongLinesAreBrokenAtTheirLastSpace) {
  EXPECT_EQ(broken("one two three four", 9), (Lines{"one two", "three", "four"}));
  EXPECT_EQ(broken("one two three", 7), (Lines{"one two", "three"}));
}

TEST(Letters, LongWordsAreBrokenAnywhere) { EXPECT_EQ(broken("abcdefgh", 3), (Lines{"abc", "def", "gh"})); }

TEST(Letters, EveryLineFits) {
  const std::string text = "a bb  ccc dddd\teeeee ffffff ggggggg hhhhhhhh i";
  for (int width = 1; width < 20; ++width) {
    std::string all;
    for (const std::string& line : broken(text, width)) {
      EXPECT_LE(int(line.size()), width);
      all += line;
    }
    std::erase(all, ' ');
    EXPECT_EQ(all, "abbcccddddeeeeeffffffggggggghhhhhhhhi");
  }
}

TEST(Letters, OtherCharactersThanAsciiAreQuestionMarks) {
  EXPECT_EQ(broken("gr\xc3\xbc\xc3\x9f"
                   "e \xe2\x82\xac\x01!",
                   20),
            (Lines{"gr??e ?!"}));
}

TEST(Letters, DrawingPutsAPanelWithDarkLettersInTheCorner) {
  constexpr int kWidth = 60, kHeight = 40;
  std::vector<std::uint8_t> rgb(3 * kWidth * kHeight, 0);
  drawLetters(rgb, kWidth, {4, 2, {255, 0, 0, 0, 0, 0, 0, 255}});
  const auto gray = [&](int row, int column) { return int(rgb[3 * std::size_t(row * kWidth + column)]); };
  EXPECT_EQ(gray(11, 30), 0);  // above
  EXPECT_EQ(gray(20, 11), 0);  // beside
  EXPECT_NEAR(gray(13, 13), .93 * 255, 1);
  EXPECT_EQ(gray(19, 24), 36);  // the first pixel of the letters
  EXPECT_NEAR(gray(19, 25), .93 * 255, 1);
  EXPECT_EQ(gray(20, 27), 36);  // and the last
  EXPECT_EQ(gray(30, 30), 0);
}

TEST(Letters, DrawingIsCutOffAtThePicture) {
  for (const auto& [width, height] : {std::pair{1, 1}, {13, 5}, {5, 30}, {20, 20}}) {
    std::vector<std::uint8_t> rgb(std::size_t(3 * width * height), 7);
    drawLetters(rgb, width, {50, 50, std::vector<std::uint8_t>(2500, 255)});
    EXPECT_EQ(rgb.front(), 7);
  }
}

TEST(Letters, ARendererWritesAnyText) {
  CameraRenderer renderer;
  const Letters one = renderer.write("Hello", 500, 300), two = renderer.write("Hello\nHello", 500, 300);
  EXPECT_GT(one.width, 20);
  EXPECT_LT(one.width, 100);
  EXPECT_EQ(two.width, one.width);
  EXPECT_EQ(two.cover.size(), std::size_t(two.width * two.height));
  const auto ink = [](const Letters& letters) {
    return std::accumulate(letters.cover.begin(), letters.cover.end(), 0.);
  };
  EXPECT_GT(ink(one), 5000.);
  EXPECT_NEAR(ink(two), 2. * ink(one), .02 * ink(one));
  EXPECT_EQ(ink(renderer.write("", 500, 300)), 0.);
  const Letters many = renderer.write(std::string(3000, 'm') + "\n" + std::string(100000, '\n'), 300, 200);
  EXPECT_LE(many.width, 300);
  EXPECT_LE(many.height, 200);
}

TEST(Letters, LabelsHaveTheirCenterAtAPixelAndAreClipped) {
  constexpr int kWidth = 20, kHeight = 10;
  std::vector<std::uint8_t> rgb(3 * kWidth * kHeight, 0);
  const Letters letters{2, 2, {255, 255, 255, 255}};
  drawLabel(rgb, kWidth, letters, 10, 5);
  const auto gray = [&](int row, int column) { return int(rgb[3 * std::size_t(row * kWidth + column)]); };
  EXPECT_EQ(gray(5, 10), 36);
  EXPECT_GT(gray(5, 12), 200);  // the panel beside
  EXPECT_EQ(gray(5, 16), 0);
  EXPECT_EQ(gray(7, 10), 0);
  drawLabel(rgb, kWidth, letters, -1, 0);
  drawLabel(rgb, kWidth, letters, kWidth, kHeight);
  EXPECT_GT(gray(0, 2), 200);
}

}  // namespace
}  // namespace kinegraph
