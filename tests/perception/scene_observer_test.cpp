#include "kinegraph/perception/scene_observer.h"

#include <gtest/gtest.h>

#include "kinegraph/common/errors.h"
#include "kinegraph/rendering/camera_renderer.h"

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
  const Vector3d eye(0., -.8, 1.3), z = (Vector3d(0., .05, .65) - eye).normalized();
  const Vector3d x = z.cross(Vector3d::UnitZ()).normalized();
  Matrix3d R;
  R << x, z.cross(x), z;
  C.getFrame("cam").setPose(Pose(eye, Quaterniond(R)));
  return C;
}

std::vector<DepthView> viewsOf(const Config& C) {
  CameraRenderer renderer;
  const Camera from = cameraOf(C.getFrame("cam"));
  DepthView view;
  view.depth = renderer.render(*C.scene(), from, true).depth;
  view.width = from.width;
  view.height = from.height;
  view.fxycxy = from.fxycxy();
  view.camera = "cam";
  return {view};
}

TEST(SceneObserver, MovesTheThingsThatItSeesAndAttachesAllElse) {
  Config C = observedScene(), truth = observedScene();
  truth.getFrame("cube").setPosition({.13, .02, .68});
  truth.addText("bottle: { shape: box, size: [.07, .07, .2], pose: [-.2, .1, .75], contact: 1 }");
  OccupancyMap map(C, {-.4, -.3, .66}, {.4, .4, 1.1}, .02);
  SceneObserver observer([&] { return viewsOf(truth); }, {"cube", "held"}, {.support = "table"}, &map);
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

TEST(SceneObserver, WithoutAMapOnlyThingsMove) {
  Config C = observedScene(), truth = observedScene();
  truth.getFrame("cube").setPosition({.13, .02, .68});
  SceneObserver observer([&] { return viewsOf(truth); }, {"cube"}, {.support = "table"});
  EXPECT_TRUE(observer.observe(C).at("cube"));
  EXPECT_FALSE(C.findFrame("map"));
  EXPECT_THROW(SceneObserver(nullptr, {"cube"}), ValueError);
  SceneObserver unknown([&] { return viewsOf(truth); }, {"nothing"});
  EXPECT_THROW(unknown.observe(C), FrameNotFound);
}

}  // namespace
}  // namespace kinegraph
