#include "kinegraph/viewer/draw_quad.h"

#include <gtest/gtest.h>

namespace kinegraph {

namespace {

constexpr int kWidth = 6, kHeight = 4;

/// Two pixels, red 10 and 20, side by side; places are in heights of the picture.
Quad pair(double x, double y, double height) {
  Quad quad;
  quad.x = x;
  quad.y = y;
  quad.height = height;
  quad.columns = 2;
  quad.rows = 1;
  quad.rgb = {10, 0, 0, 20, 0, 0};
  return quad;
}

/// The red of a black picture with that quad, row by row.
std::vector<int> drawn(const Quad& quad) {
  std::vector<std::uint8_t> rgb(3 * kWidth * kHeight, 0);
  drawQuad(rgb, kWidth, quad);
  std::vector<int> red;
  for (std::size_t i = 0; i < rgb.size(); i += 3) red.push_back(rgb[i]);
  return red;
}

}  // namespace

TEST(DrawQuad, HasItsPlaceInHeightsOfThePicture) {
  EXPECT_EQ(drawn(pair(.25, .5, .5)), (std::vector{0, 0,  0,  0,  0,  0,  //
                                                   0, 0,  0,  0,  0,  0,  //
                                                   0, 10, 10, 20, 20, 0,  //
                                                   0, 10, 10, 20, 20, 0}));
}

TEST(DrawQuad, IsCutOffAtTheEdges) {
  EXPECT_EQ(drawn(pair(-.5, -.25, .5)), (std::vector{20, 20, 0, 0, 0, 0,  //
                                                     0,  0,  0, 0, 0, 0,  //
                                                     0,  0,  0, 0, 0, 0,  //
                                                     0,  0,  0, 0, 0, 0}));
  EXPECT_EQ(drawn(pair(7., 7., .5)), std::vector<int>(kWidth * kHeight, 0));
  EXPECT_EQ(drawn(pair(-1e12, 0., 1e13)), std::vector<int>(kWidth * kHeight, 10));
}

}  // namespace kinegraph
