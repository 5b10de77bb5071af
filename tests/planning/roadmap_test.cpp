#include "kinegraph/planning/roadmap.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "kinegraph/common/errors.h"

namespace kinegraph {
namespace {

Config roomWithWall(double wall_at = 0.) {
  Config C;
  C.addText(R"(
world: {}
disc(world): {joint: transXY, limits: [-2, -2, 2, 2]}
body(disc): {shape: cylinder, size: [0.2, 0.2], contact: 1}
wall(world): {shape: box, size: [0.1, 3, 1], contact: 1}
)");
  C.getFrame("wall").setPosition({wall_at, 0., 0.});
  return C;
}

const VectorXd kBefore{{-1., 0.}}, kBehindTheWall{{1., 0.}};

bool isFree(Config& C, const MatrixXd& path) {
  for (Eigen::Index k = 1; k < path.rows(); ++k)
    if (C.checkMotion(path.row(k - 1).transpose(), path.row(k).transpose(), 0., 1e-6)) return false;
  return path.rows() > 1;
}

std::string scratch(const char* name) { return (std::filesystem::temp_directory_path() / name).string(); }

TEST(Roadmap, FindsAFreePathAndKnowsItTheSecondTime) {
  Config C = roomWithWall();
  Roadmap map(C);
  map.grow(300);
  const RoadmapPath first = map.findPath(kBefore, kBehindTheWall);
  ASSERT_TRUE(first.feasible()) << first.message;
  EXPECT_TRUE(isFree(C, first.path));
  EXPECT_EQ(first.path.row(0).transpose(), kBefore);
  EXPECT_EQ(first.path.bottomRows(1).transpose(), kBehindTheWall);
  const int size = map.size();
  const RoadmapPath second = map.findPath(kBefore, kBehindTheWall);
  EXPECT_EQ(second.path, first.path);
  EXPECT_LT(second.evaluations, first.evaluations);
  EXPECT_EQ(map.size(), size);
}

TEST(Roadmap, AWallThatHasMovedIsSeenAfterSetScene) {
  Roadmap map(roomWithWall());
  map.grow(300);
  ASSERT_TRUE(map.findPath(kBefore, kBehindTheWall).feasible());
  Config moved = roomWithWall(.5);
  map.setScene(moved);
  const RoadmapPath answer = map.findPath(kBefore, kBehindTheWall);
  ASSERT_TRUE(answer.feasible());
  EXPECT_TRUE(isFree(moved, answer.path));
}

TEST(Roadmap, WhatIsSavedIsLoadedWithWhatIsKnown) {
  const Config C = roomWithWall();
  Roadmap map(C, .01, 5);
  map.grow(200);
  const MatrixXd path = map.findPath(kBefore, kBehindTheWall).path;
  const std::string file = scratch("kinegraph_roadmap_test.bin");
  map.save(file);
  Roadmap same(C, .01), other(roomWithWall(.5), .01);
  same.load(file);
  EXPECT_EQ(same.configurations(), map.configurations());
  EXPECT_EQ(same.edges(), map.edges());
  const RoadmapPath answer = same.findPath(kBefore, kBehindTheWall);
  EXPECT_EQ(answer.path, path);
  other.load(file);  // another scene: nothing is known
  EXPECT_GT(other.findPath(kBefore, kBehindTheWall).evaluations, answer.evaluations);
  std::filesystem::remove(file);
}

TEST(Roadmap, DamagedFilesAreRefusedAndTheMapStays) {
  const Config C = roomWithWall();
  Roadmap map(C);
  map.grow(20);
  const std::string file = scratch("kinegraph_roadmap_damaged.bin");
  map.save(file);
  std::ifstream in(file, std::ios::binary);
  const std::string bytes((std::istreambuf_iterator<char>(in)), {});
  for (std::size_t length = 0; length < bytes.size(); length += 101) {
    std::ofstream(file, std::ios::binary) << bytes.substr(0, length);
    EXPECT_THROW(map.load(file), FileError) << length;
  }
  EXPECT_EQ(map.size(), 20);
  std::filesystem::remove(file);
  EXPECT_THROW(map.load(file), FileError);
}

TEST(Roadmap, AStartThatCollidesIsToldAndAMapWithoutAWaySaysSo) {
  Roadmap map(roomWithWall());
  EXPECT_NE(map.findPath(VectorXd{{0., 0.}}, kBehindTheWall).message.find("the start collides: 'body' and 'wall'"),
            std::string::npos);
  EXPECT_NE(map.findPath(kBefore, kBehindTheWall).message.find("grow adds more"), std::string::npos);
  EXPECT_THROW(map.grow(-1), ValueError);
}

}  // namespace
}  // namespace kinegraph
