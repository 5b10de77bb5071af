#include "kinegraph/planning/smoothing/rope_shortcut.h"

#include <gtest/gtest.h>

#include "kinegraph/planning/smoothing/shortcut.h"
#include "tests/planning/plane_room.h"

namespace kinegraph {
namespace {

double lengthOf(const JointSpace& space, const std::vector<VectorXd>& points) {
  return pathLength(space, space.unroll(points));
}

TEST(TightenPath, LiesAroundCornersAsAStringDoes) {
  for (std::uint64_t seed = 0; seed < 5; ++seed) {
    Asked asked{room(.5)};
    PathQuery request = asked.request(1, seed);
    request.constraints.clearance.guard = Clearance::kGuard;
    const PathSearchResult found = searchPath(request);
    ASSERT_FALSE(found.points.empty());
    Steering steering(request.constraints);
    const std::vector<VectorXd> rough = shortcutPath(steering, found.points, {.cuts = 10}),
                                tightened = tightenPath(steering, rough);
    EXPECT_EQ(tightened.front(), found.points.front());
    EXPECT_EQ(tightened.back(), found.points.back());
    EXPECT_GE(leastDistance(asked.C, tightened), 0.);
    EXPECT_LE(lengthOf(asked.space, tightened), lengthOf(asked.space, rough));
    EXPECT_GT(lengthOf(asked.space, tightened), tightenedLength());
    EXPECT_LT(lengthOf(asked.space, tightened), 1.005 * tightenedLength()) << seed;
  }
}

TEST(TightenPath, WhereNothingIsInTheWayItIsTheStraightLine) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  Steering steering(request.constraints);
  const std::vector<VectorXd> bent = {VectorXd{{-1., 1.2}}, VectorXd{{-1.5, 0.}}, VectorXd{{-1., -1.2}}};
  const std::vector<VectorXd> tightened = tightenPath(steering, bent);
  ASSERT_EQ(tightened.size(), 2u);
  EXPECT_EQ(tightened.front(), bent.front());
  EXPECT_EQ(tightened.back(), bent.back());
}

TEST(TightenPath, LengthMeansWhatTheWeightsSay) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  request.constraints.clearance.guard = Clearance::kGuard;
  const PathSearchResult found = searchPath(request);
  Steering steering(request.constraints);
  const VectorXd weight{{1., 3.}};
  const auto cost = [&](const std::vector<VectorXd>& points) {
    double sum = 0.;
    for (std::size_t i = 1; i < points.size(); ++i) sum += (points[i] - points[i - 1]).cwiseProduct(weight).norm();
    return sum;
  };
  const std::vector<VectorXd> plain = tightenPath(steering, found.points),
                              weighted = tightenPath(steering, found.points, {.weight = weight});
  EXPECT_LT(cost(weighted), cost(plain));
  EXPECT_LT(lengthOf(asked.space, plain), lengthOf(asked.space, weighted));
}

TEST(TightenPath, FinerCornersAreShorter) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  request.constraints.clearance.guard = Clearance::kGuard;
  const PathSearchResult found = searchPath(request);
  Steering steering(request.constraints);
  const std::vector<VectorXd> coarse = tightenPath(steering, found.points, {.refinements = 0}),
                              fine = tightenPath(steering, found.points, {.refinements = 2});
  const auto excess = [&](const std::vector<VectorXd>& path) {
    return lengthOf(asked.space, path) - tightenedLength();
  };
  EXPECT_GT(excess(fine), 0.);
  EXPECT_LT(excess(fine), .5 * excess(coarse)) << "sides of half the length leave a quarter of it";
  EXPECT_LT(coarse.size(), fine.size());
  EXPECT_GE(leastDistance(asked.C, fine), 0.);
}

TEST(TightenPath, DoesNotDependOnWhatWasAskedBefore) {
  Asked asked{room(.5)};
  PathQuery request = asked.request();
  request.constraints.clearance.guard = Clearance::kGuard;
  const PathSearchResult found = searchPath(request);
  Steering fresh(request.constraints), used(request.constraints);
  const std::vector<VectorXd> tightened = tightenPath(fresh, found.points);
  for (const double y : {-1., 1.}) used.isFree(VectorXd{{-1., y}}, VectorXd{{1., y}});
  const std::vector<VectorXd> again = tightenPath(used, found.points);
  ASSERT_EQ(tightened.size(), again.size());
  for (std::size_t i = 0; i < tightened.size(); ++i) EXPECT_EQ(tightened[i], again[i]) << i;
}

TEST(TightenPath, AnEndlessJointGoesTheWayThatThePathGoes) {
  Config C;
  C.addText(R"(
world: {}
turn(world): {joint: hingeZ}
slide(turn): {joint: transX, limits: [0, 1]}
tip(slide): {shape: box, size: [0.1, 0.1, 0.1], Q: [1, 0, 0], contact: 1}
post(world): {shape: box, size: [0.3, 0.3, 0.3], Q: [-1.2, 0, 0], contact: 1}
)");
  Asked asked{std::move(C)};
  PathQuery request{.constraints = {&asked.scene, &asked.space}, .starts = {}, .goals = {}};
  request.constraints.clearance.guard = Clearance::kGuard;
  Steering steering(request.constraints);  // past the seam at pi, over the post by sliding out
  const std::vector<VectorXd> over = {VectorXd{{2.4, .2}}, VectorXd{{2.6, .95}}, VectorXd{{-2.6, .95}},
                                      VectorXd{{-2.4, .2}}};
  for (std::size_t i = 1; i < over.size(); ++i) ASSERT_TRUE(steering.isFree(over[i - 1], over[i])) << i;
  const std::vector<VectorXd> tightened = tightenPath(steering, over);
  EXPECT_LT(lengthOf(asked.space, tightened), .95 * lengthOf(asked.space, over));
  EXPECT_GE(leastDistance(asked.C,
                          [&] {
                            const MatrixXd rows = asked.space.unroll(tightened);
                            std::vector<VectorXd> points;
                            for (Eigen::Index k = 0; k < rows.rows(); ++k) points.push_back(rows.row(k).transpose());
                            return points;
                          }()),
            0.);
}

}  // namespace
}  // namespace kinegraph
