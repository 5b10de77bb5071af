#include "kinegraph/perception/occupancy_map.h"

#include <gtest/gtest.h>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/random.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/scene/collisions.h"
#include "tests/perception/camera_above_table.h"

namespace kinegraph {
namespace {

/// A table, and a camera above its front edge.
Config mapScene() {
  Config C;
  C.addText(R"(
    table: { shape: ssBox, size: [1.2, 1.2, .1, .005], pose: [0, 0, .6], contact: 1 }
    cam: { pose: [0, -.8, 1.3], focalLength: 1., width: 320, height: 240 }
  )");
  aimCamera(C);
  return C;
}

TEST(OccupancyMap, ABoxThatTheSceneDoesNotHaveIsOccupiedAndHidesWhatIsBehind) {
  Config C = mapScene(), truth = mapScene();
  truth.addText("box: { shape: box, size: [.2, .1, .2], pose: [0, 0, .75], contact: 1 }");
  OccupancyMap map(C, {-.3, -.3, .65}, {.3, .3, 1.}, .02);
  EXPECT_EQ(map.state({0., 0., .8}), CellState::unseen);
  const std::vector<DepthView> views = {imageOf(truth)};
  EXPECT_TRUE(map.update(C, views).empty());
  EXPECT_EQ(map.state({.01, -.05, .79}), CellState::occupied);
  EXPECT_EQ(map.state({.01, .09, .71}), CellState::hidden);
  EXPECT_EQ(map.state({.01, -.25, .81}), CellState::free);
  EXPECT_EQ(map.state({9., 0., 0.}), CellState::free);
}

TEST(OccupancyMap, AnImageUpsideDownLooksThroughTheTable) {
  Config C = mapScene();
  OccupancyMap map(C, {-.3, -.3, .65}, {.3, .3, 1.}, .02);
  DepthView view = imageOf(C);
  EXPECT_TRUE(map.update(C, std::vector<DepthView>{view}).empty());
  std::reverse(view.depth.begin(), view.depth.end());
  const std::vector<std::string> warnings = map.update(C, std::vector<DepthView>{view});
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("looks through known shapes"), std::string::npos) << warnings[0];
}

TEST(OccupancyMap, TheLargestDepthOfAFormatIsNoMeasurement) {
  Config C = mapScene();
  OccupancyMap map(C, {-.3, -.3, .65}, {.3, .3, 1.}, .02);
  DepthView view = imageOf(C);
  for (int row = 0; row < view.height; ++row)
    std::fill_n(view.depth.begin() + row * view.width, view.width / 3, 65.535f);
  map.update(C, std::vector<DepthView>{view});
  EXPECT_NE(map.state({-.25, 0., .8}), CellState::free);
  EXPECT_EQ(map.state({.15, 0., .8}), CellState::free);
}

/// The number of cells that block if all cells but some are free.
int blocking(Config C, const std::vector<std::pair<std::array<int, 3>, CellState>>& cells, Unseen unseen) {
  OccupancyMap map(C, {-.3, -.3, .65}, {.3, .3, 1.}, .05);
  std::vector<CellState> states(map.states().size(), CellState::free);
  for (const auto& [at, state] : cells)
    states[std::size_t((at[0] * map.counts()[1] + at[1]) * map.counts()[2] + at[2])] = state;
  map.setStates(std::move(states));
  map.attach(C, unseen);
  const std::vector<float>& values = C.getFrame("map").data().shape->geometry->grid->values;
  return int(std::count_if(values.begin(), values.end(), [](float value) { return value != CellKind::free; }));
}

TEST(OccupancyMap, HiddenCellsBlockIfTheyTouchWhatCanHoldAThingSinceNothingFloats) {
  const Config table = mapScene();
  const std::pair<std::array<int, 3>, CellState> floating = {{5, 5, 4}, CellState::hidden};
  for (const Unseen unseen : {Unseen::shadows, Unseen::blocked}) {
    EXPECT_EQ(blocking(table, {floating}, unseen), 0);
    EXPECT_EQ(blocking(table, {floating, {{5, 6, 5}, CellState::hidden}}, unseen), 0);
    EXPECT_EQ(blocking(table, {floating, {{5, 6, 4}, CellState::occupied}}, unseen), 2);
    EXPECT_EQ(blocking(table, {floating, {{6, 6, 5}, CellState::occupied}}, unseen), 1);  // not by a corner
    // down to the table; the lowest cells touch it, and are its own
    EXPECT_EQ(blocking(table, {floating, {{5, 5, 3}, CellState::hidden}, {{5, 5, 2}, CellState::hidden}}, unseen), 0);
    EXPECT_EQ(
        blocking(
            table,
            {floating, {{5, 5, 3}, CellState::hidden}, {{5, 5, 2}, CellState::hidden}, {{5, 5, 1}, CellState::hidden}},
            unseen),
        4);
  }
  // never in an image: free in one case, anything in the other
  EXPECT_EQ(blocking(table, {floating, {{5, 5, 5}, CellState::unseen}}, Unseen::shadows), 0);
  EXPECT_EQ(blocking(table, {floating, {{5, 5, 5}, CellState::unseen}}, Unseen::blocked), 2);
  // in part in an image: a way to the table, but not itself an obstacle of shadows
  const std::vector<std::pair<std::array<int, 3>, CellState>> in_part = {
      floating, {{5, 5, 3}, CellState::undecided}, {{5, 5, 2}, CellState::hidden}, {{5, 5, 1}, CellState::hidden}};
  EXPECT_EQ(blocking(table, in_part, Unseen::shadows), 3);
  EXPECT_EQ(blocking(table, in_part, Unseen::blocked), 4);
}

TEST(OccupancyMap, ThingsMayLieInADrawerButNotOnAnArm) {
  const std::string box = "shape: box, size: [.04, .04, .04], contact: 1 }";  // below the cell (5, 5, 4)
  Config drawer = mapScene(), arm = mapScene();
  drawer.addText("world: {} drawer (world): { joint: transX, pre: \"t(-.025 -.025 .825)\", " + box);
  arm.addText(
      "world: {} upper (world): { joint: hingeZ, pre: \"t(-.025 -.025 .7)\" } hand (upper): { joint: transZ, pre: "
      "\"t(0 0 .125)\", " +
      box);
  const std::pair<std::array<int, 3>, CellState> above = {{5, 5, 4}, CellState::hidden};
  EXPECT_EQ(blocking(drawer, {above}, Unseen::shadows), 1);
  EXPECT_EQ(blocking(arm, {above}, Unseen::shadows), 0);
}

TEST(OccupancyMap, AttachAddsAFrameOfCellsAndReplacesItsCells) {
  Config C = mapScene();
  const OccupancyMap map(C, {-.3, -.3, .7}, {.3, .3, 1.}, .05);
  map.attach(C);
  EXPECT_EQ(C.getFrame("map").getShapeType(), kCells);
  const Frame frame = C.getFrame("map");
  const auto solid = [&] {
    const std::vector<float>& values = C.getFrame("map").data().shape->geometry->grid->values;
    return std::count(values.begin(), values.end(), CellKind::unseen);
  };
  EXPECT_EQ(solid(), 12 * 12 * 6);
  map.attach(C, Unseen::free);
  EXPECT_EQ(solid(), 0);
  EXPECT_THROW(map.attach(C, Unseen::blocked, "table"), ValueError);
  EXPECT_THROW(unseenFromName("all"), ValueError);
}

TEST(OccupancyMap, InvalidRegionsAndViewsAreRefused) {
  Config C = mapScene();
  EXPECT_THROW(OccupancyMap(C, {0., 0., 0.}, {1., -1., 1.}, .1), ValueError);
  EXPECT_THROW(OccupancyMap(C, {0., 0., 0.}, {1., 1., 1.}, 0.), ValueError);
  EXPECT_THROW(OccupancyMap(C, {0., 0., 0.}, {1., 1., 1.}, 1e-4), ValueError);
  EXPECT_THROW(OccupancyMap(C, {0., 0., 0.}, {1., 1., 1.}, .1, {"nothing"}), FrameNotFound);
  OccupancyMap map(C, {-.3, -.3, .7}, {.3, .3, 1.}, .05);
  DepthView view = imageOf(C);
  view.width = 100;
  EXPECT_THROW(map.update(C, std::vector<DepthView>{view}), ValueError);
  std::vector<CellState> states = map.states();
  states.back() = CellState(200);
  EXPECT_THROW(map.setStates(states), ValueError);
}

/// An arm of two capsules among cubes, as one shape of cells or as a frame for each cube.
TEST(CellsAsObstacles, EdgesAreFreeExactlyIfTheyAreFreeAmongSingleCubes) {
  constexpr double kSide = .1;
  const std::string arm = R"g(
    base: { pose: [0, 0, .5] }
    shoulder(base): { joint: hingeX }
    upper(shoulder): { shape: capsule, size: [.3, .05], Q: "t(0 0 .2)", contact: 1 }
    elbow(upper): { pre: "t(0 0 .2)", joint: hingeY }
    lower(elbow): { shape: ssBox, size: [.06, .08, .4, .01], Q: "t(0 0 .25)", contact: 1 }
  )g";
  Rng rng(11);
  Config cells, cubes;
  cells.addText(arm);
  cubes.addText(arm);
  Grid grid{{16, 16, 10}, std::vector<float>(16 * 16 * 10, CellKind::free)};
  for (int i = 0; i < 16 * 16 * 10; ++i) {
    if (rng.uniform() > .02) continue;
    const Vector3d middle = kSide * Vector3d(i / 160 + .5 - 8., i / 10 % 16 + .5 - 8., i % 10 + .5 - 5.);
    if (middle.norm() < .2) continue;
    grid.values[std::size_t(i)] = CellKind::occupied;
    Frame cube = cubes.addFrame("cube" + std::to_string(i));
    cube.setShape(ShapeType::box, {kSide, kSide, kSide});
    cube.setPosition(middle + Vector3d(0., 0., .5));
    cube.setContact(1);
  }
  Frame map = cells.addFrame("cells");
  setCells(map, grid, {1.6, 1.6, 1.});
  map.setPosition({0., 0., .5});
  map.setContact(1);
  EdgeChecker among_cells(cells.state()), among_cubes(cubes.state());
  int free = 0, hit = 0;
  for (int trial = 0; trial < 400; ++trial) {
    VectorXd from(2), to(2);
    for (int j = 0; j < 2; ++j) from[j] = rng.uniform(-3., 3.), to[j] = from[j] + .5 * rng.normal();
    const bool expected = among_cubes.isFree(from.data(), to.data());
    EXPECT_EQ(among_cells.isFree(from.data(), to.data()), expected);
    EXPECT_EQ(among_cells.isFree(from.data()), among_cubes.isFree(from.data()));
    const double clearance = among_cubes.clearance(from.data(), .2);
    if (clearance > 0.) {
      EXPECT_NEAR(among_cells.clearance(from.data(), .2), clearance, 1e-9);
      if (expected) {
        EXPECT_NEAR(among_cells.clearance(from.data(), to.data(), .2),
                    among_cubes.clearance(from.data(), to.data(), .2), 2e-5);
      }
    }
    ++(expected ? free : hit);
  }
  EXPECT_GT(free, 20);
  EXPECT_GT(hit, 20);
}

}  // namespace
}  // namespace kinegraph
