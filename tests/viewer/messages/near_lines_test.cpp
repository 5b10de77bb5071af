#include "kinegraph/viewer/messages/near_lines.h"

#include <gtest/gtest.h>

#include "kinegraph/scene/tree/scene_tree.h"
#include "kinegraph/viewer/scene_edits.h"

namespace kinegraph {
namespace {

/// Balls of 5 cm at these places on the x axis.
Config balls(const std::vector<double>& places) {
  Config config;
  for (std::size_t i = 0; i < places.size(); ++i) {
    Frame ball = config.addFrame("ball" + std::to_string(i));
    ball.setShape(ShapeType::sphere, {.05}).setContact(1);
    ball.setPosition({places[i], 0., 0.});
  }
  return config;
}

TEST(NearLines, JoinTheSurfacesOfPairsWithinTheMargin) {
  const std::vector<NearLine> lines = nearLines(balls({0., .12, .2, 1.}), .03);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].names, "ball0 - ball1");
  EXPECT_NEAR(lines[0].distance, .02, 1e-9);
  EXPECT_LT((lines[0].a - Vector3d(.05, 0., 0.)).norm(), 1e-6);
  EXPECT_LT((lines[0].b - Vector3d(.07, 0., 0.)).norm(), 1e-6);
  EXPECT_NEAR(lines[1].distance, -.02, 1e-9);
}

TEST(NearLines, OfAFrameWithoutAShapeBeginAtItsOrigin) {
  Config config = balls({0.});
  config.addFrame("point").setPosition({.2, 0., 0.});
  const NearLine line = nearLine(config.state(), 1, 0);
  EXPECT_EQ(line.names, "point - ball0");
  EXPECT_NEAR(line.distance, .15, 1e-9);
  EXPECT_LT((line.a - Vector3d(.2, 0., 0.)).norm(), 1e-6);
  EXPECT_LT((line.b - Vector3d(.05, 0., 0.)).norm(), 1e-6);
}

TEST(NearLines, ComeWithEveryEditAfterARequest) {
  const Config config = balls({0., .12});
  SceneEdits edits;
  edits.setScene(config.scene()->snapshot(), 1);
  EXPECT_TRUE(edits.apply(MoveFrameCommand{1, 0, {.01, 0., 0., 1., 0., 0., 0.}})->near.empty());
  EXPECT_EQ(edits.apply(NearCommand{1, .05})->near.size(), 1u);
  EXPECT_EQ(edits.margin(), .05);
  EXPECT_NEAR(edits.apply(MoveFrameCommand{1, 0, {.0, 0., 0., 1., 0., 0., 0.}})->near.at(0).distance, .02, 1e-9);
  EXPECT_FALSE(edits.apply(NearCommand{2, .05}));  // of another structure
}

}  // namespace
}  // namespace kinegraph
