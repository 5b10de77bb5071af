#include "kinegraph/collision/cell_separation.h"

#include <gtest/gtest.h>

#include "kinegraph/collision/edge_check.h"
#include "kinegraph/common/random.h"
#include "kinegraph/geometry/distance/cell_field.h"
#include "kinegraph/geometry/distance/grid_field.h"
#include "kinegraph/geometry/distance/proximity.h"
#include "kinegraph/geometry/shapes/cells.h"
#include "kinegraph/scene/collisions.h"
#include "kinegraph/scene/config.h"

namespace kinegraph {
namespace {

constexpr double kSide = .02;  // m, of a cube
constexpr int kCount = 24;     // cubes per axis

/// A rough wall, and single cubes in front of it.
Grid drawWall(Rng& rng) {
  Grid grid{{kCount, kCount, kCount}, std::vector<float>(std::size_t(kCount * kCount * kCount), CellKind::free)};
  for (int i = 0; i < kCount * kCount * kCount; ++i) {
    const int depth = i / kCount / kCount;
    if (depth < 4 || (depth == 4 && rng.uniform() < .5) || rng.uniform() < .0005)
      grid.values[std::size_t(i)] = CellKind::occupied;
  }
  return grid;
}

std::shared_ptr<const CollisionBody> bodyOf(const Grid& grid) {
  const double size = kCount * kSide;
  return makeCollisionBody({kCells, {size, size, size}, nullptr, {}, Vector3d::Ones(), std::make_shared<Grid>(grid)});
}

/// The distance from every single cube.
double distanceFromCubes(const CollisionBody& body, const RigidTransform& X, const CellField& field) {
  double least = std::numeric_limits<double>::infinity();
  for (std::array<int, 3> at{}; at[0] < kCount; ++at[0]) {
    for (at[1] = 0; at[1] < kCount; ++at[1]) {
      for (at[2] = 0; at[2] < kCount; ++at[2]) {
        const Vector3d middle = kSide * Vector3d(at[0] + .5, at[1] + .5, at[2] + .5) - field.half;
        if (!field.solid(at) || (middle - X.p).norm() > least + body.boundRadius() + .2) continue;
        least = std::min(least, proximity(body, X, *field.cube, {Matrix3d::Identity(), middle}).distance);
      }
    }
  }
  return least;
}

std::vector<std::shared_ptr<const CollisionBody>> separationShapes() {
  return {makeCollisionBody({ShapeType::sphere, {.03}, nullptr}),
          makeCollisionBody({ShapeType::capsule, {.2, .04}, nullptr}),
          makeCollisionBody({ShapeType::ssBox, {.1, .05, .2, .01}, nullptr}),
          makeCollisionBody({ShapeType::cylinder, {.1, .03}, nullptr})};
}

/// A translation together with a rotation about the moving origin.
struct Screw {
  RigidTransform begin;
  Vector3d shift, axis;
  double angle;

  RigidTransform at(double s) const {
    return {Eigen::AngleAxisd(s * angle, axis).toRotationMatrix() * begin.R, begin.p + s * shift};
  }
};

Screw drawScrew(Rng& rng) {
  const auto normal = [&] { return Vector3d(rng.normal(), rng.normal(), rng.normal()); };
  const Quaterniond q = Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized();
  const Vector3d place(rng.uniform(-.1, .25), rng.uniform(-.2, .2), rng.uniform(-.2, .2));
  return {{q.toRotationMatrix(), place}, .03 * normal(), normal().normalized(), .2 * rng.normal()};
}

TEST(CellSeparation, AtOneTimeItDecidesWhetherACubeIsCloserThanTheMargin) {
  Rng rng(5);
  int apart = 0, near = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const auto cells = bodyOf(drawWall(rng));
    for (const auto& body : separationShapes()) {
      const RigidTransform X = drawScrew(rng).begin;
      const double distance = distanceFromCubes(*body, X, *cells->grid().cells);
      for (const double margin : {0., .01, distance - 1e-6, distance + 1e-6}) {
        if (margin + body->radius() <= 0.) continue;
        const CellVerdict verdict = separateFromCells({*body, *cells, X, X}, margin);
        ASSERT_EQ(verdict.kind == CellVerdict::apart, distance >= margin) << distance << " " << margin;
        ASSERT_NE(verdict.kind, CellVerdict::unknown);
        ++(verdict.kind == CellVerdict::apart ? apart : near);
      }
    }
  }
  EXPECT_GT(apart, 100);
  EXPECT_GT(near, 100);
}

TEST(CellSeparation, AProvedMotionKeepsTheMarginAtAllTimes) {
  constexpr double kMargin = .004;
  Rng rng(6);
  int proved = 0, beyond_first_order = 0, near = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const auto cells = bodyOf(drawWall(rng));
    const CellField& field = *cells->grid().cells;
    for (const auto& body : separationShapes()) {
      const Screw screw = drawScrew(rng);
      const double reach = body->boundCenter().norm() + body->boundRadius(), turn = std::abs(screw.angle);
      MotionAmongCells motion{*body, *cells, screw.at(0.), screw.at(1.)};
      motion.travel = screw.shift.norm() + turn * reach;
      motion.bow = .125 * turn * turn * reach;
      const CellVerdict verdict = separateFromCells(motion, kMargin);
      const double begin = distanceFromCubes(*body, motion.begin, field),
                   end = distanceFromCubes(*body, motion.end, field);
      if (verdict.kind == CellVerdict::apart) {
        ++proved;
        if (begin + end - motion.travel < 2. * kMargin) ++beyond_first_order;
        for (int i = 0; i <= 20; ++i) ASSERT_GE(distanceFromCubes(*body, screw.at(i / 20.), field), kMargin - 1e-9);
      } else if (verdict.kind == CellVerdict::unknown) {
        EXPECT_GE(verdict.distance, kMargin);
        EXPECT_GE(verdict.distance, std::min(begin, end) - 1e-9);
      } else {
        ++near;
        EXPECT_LT(verdict.kind == CellVerdict::near_begin ? begin : end, kMargin + 1e-9);
      }
    }
  }
  EXPECT_GT(proved, 50);
  EXPECT_GT(beyond_first_order, 15);
  EXPECT_GT(near, 30);
}

TEST(CellSeparation, CellsOnALinkBehaveAsTheirCubes) {
  const std::string arm = R"g(
    base: { pose: [0, 0, .5] }
    shoulder(base): { joint: hingeX }
    upper(shoulder): { shape: capsule, size: [.3, .05], Q: "t(0 0 .2)", contact: 1 }
    elbow(upper): { pre: "t(0 0 .2)", joint: hingeY }
    post: { shape: capsule, size: [.6, .05], pose: [.35, .3, .5], contact: 1 }
  )g";
  Rng rng(12);
  Config cells, cubes;
  cells.addText(arm);
  cubes.addText(arm);
  Grid grid{{6, 6, 12}, std::vector<float>(6 * 6 * 12, CellKind::free)};
  for (int i = 0; i < 6 * 6 * 12; ++i) {
    if (rng.uniform() > .15) continue;
    grid.values[std::size_t(i)] = CellKind::occupied;
    Frame cube = cubes.addFrame("cube" + std::to_string(i), "elbow");
    cube.setShape(ShapeType::box, {.05, .05, .05});
    cube.setRelativePosition(.05 * Vector3d(i / 72 - 2.5, i / 12 % 6 - 2.5, i % 12 - 5.5) + Vector3d(0., 0., .4));
    cube.setContact(1);
  }
  Frame map = cells.addFrame("cells", "elbow");
  setCells(map, grid, {.3, .3, .6});
  map.setRelativePosition({0., 0., .4});
  map.setContact(1);
  EdgeChecker among_cells(cells.state()), among_cubes(cubes.state());
  int free = 0, hit = 0;
  for (int trial = 0; trial < 300; ++trial) {
    VectorXd from(2), to(2);
    for (int j = 0; j < 2; ++j) from[j] = rng.uniform(-3., 3.), to[j] = from[j] + .4 * rng.normal();
    const bool expected = among_cubes.isFree(from.data(), to.data());
    EXPECT_EQ(among_cells.isFree(from.data(), to.data()), expected);
    ++(expected ? free : hit);
  }
  EXPECT_GT(free, 30);
  EXPECT_GT(hit, 30);
}

}  // namespace
}  // namespace kinegraph
