#include "kinegraph/perception/scene_observer.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "tests/perception/camera_above_table.h"

namespace kinegraph {
namespace {

Config observedScene() {
  Config C;
  C.addText(R"(
    table: { shape: ssBox, size: [1.2, 1.2, .1, .005], pose: [0, 0, .6], contact: 1 }
    cube: { shape: ssBox, size: [.06, .06, .06, .004], pose: [.1, 0, .68], contact: 1 }
    world: {}
    upper (world): { joint: hingeZ, pre: [0 .5 .9]
}
    hand (upper): { joint: hingeZ, rel: [-.2, -.3, 0] }
    held (hand): { shape: ssBox, size: [.05, .05, .05, .004], contact: 1 }
    cam: { pose: [0, -.8, 1.3, 0.924, -.383, 0, 0], focalLength: 1., width: 320, height: 240 }
  )");
  aimCamera(C);
  return C;
}

TEST(SceneObserver, MovesTheThingsThatItSeesAndAttachesAllElse) {
  Config C = observedScene(), truth = observedScene();
  truth.getFrame("cube").setPosition({.13, .02, .68});
  truth.addText("bottle: { shape: box, size: [.07, .07, .2], pose: [-.2, .1, .75], contact: 1 }");
  OccupancyMap map(C, {-.4, -.3, .66}, {.4, .4, 1.1}, .02);
  SceneObserver observer([&] { return std::vector{imageOf(truth)}; }, {"cube", "held"}, {.support = "table"}, &map);
  const auto poses = observer.observe(C);
  ASSERT_TRUE(poses.at("cube"));
  EXPECT_LT((poses.at("cube")->p - Vector3d(.13, .02, .68)).norm(), .002);
  EXPECT_LT((C.getFrame("cube").getPosition() - poses.at("cube")->p).norm(), 1e-9);
  EXPECT_FALSE(poses.at("held"));  // the hand tells where it is
  EXPECT_FALSE(observer.seen().frames.contains("held"));
  EXPECT_EQ(map.state({-.2, .065, .8}), CellState::occupied);
  EXPECT_TRUE(C.findFrame("map"));
  truth.delFrame("bottle");
  observer.observe(C);
  EXPECT_EQ(map.state({-.2, .065, .8}), CellState::free);
}

TEST(SceneObserver, AnErrorLeavesTheLastResultAndTheSceneAsTheyWere) {
  Config C = observedScene();
  const Config truth = observedScene();
  OccupancyMap map(C, {-.4, -.3, .66}, {.4, .4, 1.1}, .02);
  bool is_broken = false;
  const auto take = [&] {
    DepthView view = imageOf(truth);
    if (is_broken) view.width = 7;
    return std::vector{view};
  };
  SceneObserver observer(take, {"cube"}, {.support = "table"}, &map);
  observer.observe(C);
  const std::string before = map.str();
  const MatrixXd poses = C.getFrameState();
  is_broken = true;
  EXPECT_THROW(observer.observe(C), ValueError);
  EXPECT_EQ(observer.seen().frames.at("cube").status, SeenStatus::seen);
  EXPECT_EQ(map.str(), before);
  EXPECT_EQ(C.getFrameState(), poses);
}

TEST(SceneObserver, AThingWithAnUnknownPlaceKeepsItsRotationAndIsFoundAgain) {
  Config C = observedScene(), truth = observedScene();
  truth.getFrame("cube").setPosition({.13, .02, .68});
  C.getFrame("cube").setPosition({2., 2., .68});
  SceneObserver observer([&] { return std::vector{imageOf(truth)}; }, {"cube"},
                         {.support = "table", .prior = Prior::anywhere});
  ASSERT_TRUE(observer.observe(C).at("cube"));
  const Quaterniond quarter(Eigen::AngleAxisd(1.5707963267948966, Vector3d::UnitZ()));
  const Quaterniond turned = quarter * C.getFrame("cube").getQuaternion();  // looks the same
  C.getFrame("cube").setQuaternion(turned);
  ASSERT_TRUE(observer.observe(C).at("cube"));
  EXPECT_LT(C.getFrame("cube").getQuaternion().angularDistance(turned), .02);
  truth.getFrame("cube").setPosition({-.25, .2, .68});
  ASSERT_TRUE(observer.observe(C).at("cube")) << observer.seen().str();
  EXPECT_LT((C.getFrame("cube").getPosition() - Vector3d(-.25, .2, .68)).norm(), .002);
}

TEST(SceneObserver, WithoutAMapOnlyThingsMove) {
  Config C = observedScene(), truth = observedScene();
  truth.getFrame("cube").setPosition({.13, .02, .68});
  SceneObserver observer([&] { return std::vector{imageOf(truth)}; }, {"cube"}, {.support = "table"});
  EXPECT_TRUE(observer.observe(C).at("cube"));
  EXPECT_FALSE(C.findFrame("map"));
  EXPECT_THROW(SceneObserver(nullptr, {"cube"}), ValueError);
  SceneObserver unknown([&] { return std::vector{imageOf(truth)}; }, {"nothing"});
  EXPECT_THROW(unknown.observe(C), FrameNotFound);
}

}  // namespace
}  // namespace kinegraph
