#include "kinegraph/viewer/shown_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>

#include "kinegraph/viewer/scene_items.h"

using namespace kinegraph;

namespace {

std::shared_ptr<Geometry> box(double x) {
  auto geometry = std::make_shared<Geometry>();
  geometry->type = ShapeType::box;
  geometry->size = {x, .2, .3};
  return geometry;
}

/// A triangle whose first corner is (x, 0, 0).
std::shared_ptr<Geometry> triangle(double x) {
  auto mesh = std::make_shared<Mesh>();
  mesh->vertices = {{x, 0., 0.}, {0., 1., 0.}, {0., 0., 1.}};
  mesh->triangles = {{0, 1, 2}};
  auto geometry = std::make_shared<Geometry>();
  geometry->type = ShapeType::mesh;
  geometry->mesh = mesh;
  return geometry;
}

ViewItem item(const std::string& name, std::shared_ptr<const Geometry> geometry = nullptr,
              const Vector3d& position = Vector3d::Zero()) {
  ViewItem item;
  item.name = name;
  item.pose.p = position;
  item.geometry = std::move(geometry);
  return item;
}

template <class T>
T valueAt(const Outgoing& message, std::size_t at) {
  T value;
  std::memcpy(&value, message.data->data() + at, sizeof value);
  return value;
}

/// Summarizes the messages in order: "text", "camera", "scene", "mesh 3", "poses 2".
std::vector<std::string> kinds(const std::vector<Outgoing>& messages) {
  std::vector<std::string> out;
  for (const Outgoing& message : messages) {
    if (message.binary) {
      const auto kind = valueAt<std::uint32_t>(message, 0), number = valueAt<std::uint32_t>(message, 4);
      out.push_back((kind == 1 ? "poses " : kind == 2 || kind == 9 ? "mesh " : "unknown ") + std::to_string(number));
    } else {
      const std::string start = R"({"kind":")";
      EXPECT_TRUE(message.data->starts_with(start)) << *message.data;
      out.push_back(message.data->substr(start.size(), message.data->find('"', start.size()) - start.size()));
    }
  }
  return out;
}

using Kinds = std::vector<std::string>;

}  // namespace

TEST(ShownScene, ANewBrowserGetsTextsSceneMeshesAndPoses) {
  ShownScene scene;
  scene.update(std::vector{item("world"), item("box", box(.1)), item("rock", triangle(1.))});
  ShownScene::Seen seen;
  const auto messages = scene.messagesSince(seen);
  EXPECT_EQ(kinds(messages), (Kinds{"text", "mesh 0", "scene", "poses 3"}));
  EXPECT_EQ(
      *messages[2].data,
      R"({"kind":"scene","count":3,"frames":[{"id":0,"name":"world","parent":-1,"collides":0,"details":"","shape":null},)"
      R"({"id":1,"name":"box","parent":-1,"collides":0,"details":"","shape":{"type":"box","size":[1E-1,2E-1,3E-1],"color":[8E-1,8E-1,8E-1,1],"mesh":-1}},)"
      R"({"id":2,"name":"rock","parent":-1,"collides":0,"details":"","shape":{"type":"mesh","size":[],"color":[8E-1,8E-1,8E-1,1],"mesh":0}}]})");
}

TEST(ShownScene, AnUnchangedSceneSendsNothing) {
  ShownScene scene;
  const std::vector items{item("world"), item("box", box(.1)), item("rock", triangle(1.))};
  EXPECT_TRUE(scene.update(items));
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  EXPECT_FALSE(scene.update(items));
  EXPECT_FALSE(scene.setText(&ShownScene::message, ""));
  EXPECT_TRUE(scene.messagesSince(seen).empty());
}

TEST(ShownScene, AMovedFrameSendsItsPoseOnly) {
  ShownScene scene;
  std::vector items{item("world"), item("box", box(.1)), item("rock", triangle(1.))};
  scene.update(items);
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  items[1].pose = Pose(Vector3d(1., 2., 3.), Quaterniond(0., 1., 0., 0.));
  EXPECT_TRUE(scene.update(items));
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), Kinds{"poses 1"});
  EXPECT_EQ(messages[0].data->size(), 8u + 32u);
  EXPECT_EQ(valueAt<std::uint32_t>(messages[0], 8), 1u);
  const float expected[] = {1.f, 2.f, 3.f, 0.f, 1.f, 0.f, 0.f};
  for (int k = 0; k < 7; ++k) EXPECT_EQ(valueAt<float>(messages[0], 12 + 4 * k), expected[k]) << k;
}

TEST(ShownScene, AChangedColorOrShapeSendsThatFrameAgain) {
  ShownScene scene;
  std::vector items{item("world"), item("a", box(.1)), item("b", box(.1))};
  scene.update(items);
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  items[2].color = {1., 0., 0., .5};
  scene.update(items);
  const auto recolored = scene.messagesSince(seen);
  ASSERT_EQ(kinds(recolored), (Kinds{"scene", "poses 1"}));
  EXPECT_EQ(
      *recolored[0].data,
      R"({"kind":"scene","count":3,"frames":[{"id":2,"name":"b","parent":-1,"collides":0,"details":"","shape":{"type":"box",)"
      R"("size":[1E-1,2E-1,3E-1],"color":[1,0,0,5E-1],"mesh":-1}}]})");
  items[1].geometry = triangle(1.);
  scene.update(items);
  EXPECT_EQ(kinds(scene.messagesSince(seen)), (Kinds{"mesh 0", "scene", "poses 1"}));
}

TEST(ShownScene, RemovedFramesAreRemovedByTheCount) {
  ShownScene scene;
  std::vector items{item("world"), item("a", box(.1)), item("b", box(.2))};
  scene.update(items);
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  items.pop_back();
  EXPECT_TRUE(scene.update(items));
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(messages.size(), 1u);
  EXPECT_EQ(*messages[0].data, R"({"kind":"scene","count":2,"frames":[]})");
}

TEST(ShownScene, MissedRevisionsCostNothing) {
  ShownScene scene;
  std::vector items{item("world"), item("a", box(.1)), item("b", box(.2))};
  scene.update(items);
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  for (int i = 1; i <= 1000; ++i) {
    items[i % 2 + 1].pose.p.x() = i;
    scene.update(items);
  }
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), Kinds{"poses 2"});
  EXPECT_EQ(valueAt<float>(messages[0], 12), 1000.f);
  EXPECT_EQ(valueAt<float>(messages[0], 12 + 32), 999.f);
}

TEST(ShownScene, FramesThatShareAMeshSendItOnce) {
  ShownScene scene;
  const auto rock = triangle(1.);
  std::vector items{item("a", rock), item("b", rock)};
  scene.update(items);
  ShownScene::Seen seen;
  EXPECT_EQ(kinds(scene.messagesSince(seen)), (Kinds{"text", "mesh 0", "scene", "poses 2"}));
  items.push_back(item("c", rock));
  items.erase(items.begin());
  scene.update(items);
  EXPECT_EQ(kinds(scene.messagesSince(seen)), (Kinds{"scene", "poses 2"}));
}

TEST(ShownScene, MeshesThatNoFrameUsesAreDropped) {
  ShownScene scene;
  ShownScene::Seen seen;
  const auto rock = triangle(1.);
  std::weak_ptr<Geometry> dropped;
  for (int i = 2; i < 5; ++i) {
    auto stone = triangle(i);
    dropped = stone;
    scene.update(std::vector{item("rock", rock), item("stone", std::move(stone))});
    scene.messagesSince(seen);
    EXPECT_EQ(seen.meshes, (std::set<int>{0, i - 1}));
  }
  scene.update(std::vector{item("rock", rock)});
  EXPECT_TRUE(dropped.expired());
  scene.messagesSince(seen);
  EXPECT_EQ(seen.meshes, std::set<int>{0});
}

TEST(ShownScene, AMeshThatComesBackIsSentAgainUnderANewNumber) {
  ShownScene scene;
  ShownScene::Seen seen;
  const auto rock = triangle(1.);
  scene.update(std::vector{item("rock", rock)});
  scene.messagesSince(seen);
  scene.update(std::vector{item("rock", box(1.))});
  scene.messagesSince(seen);
  scene.update(std::vector{item("rock", rock)});
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), (Kinds{"mesh 1", "scene", "poses 1"}));
  EXPECT_NE(messages[1].data->find("\"mesh\":1}"), std::string::npos);
}

TEST(ShownScene, PointsAreSentAsTheirNumbersAndTrianglesPacked) {
  for (const bool is_surface : {false, true}) {
    auto colored = std::make_shared<Mesh>(*triangle(2.5)->mesh);
    colored->colors.assign(3, {10, 20, 30, 255});
    if (!is_surface) colored->triangles.clear();
    auto geometry = triangle(0.);
    geometry->mesh = colored;
    ShownScene scene;
    scene.update(std::vector{item("rock", geometry)});
    ShownScene::Seen seen;
    const auto messages = scene.messagesSince(seen);
    const Outgoing& mesh = messages[1];
    // kind, number, vertices, triangles, colors; no texture or: symbols (three vertices, three edges), references
    const std::vector<std::uint32_t> head =
        is_surface ? std::vector<std::uint32_t>{9, 0, 3, 1, 3, 6, 0} : std::vector<std::uint32_t>{2, 0, 3, 0, 3, 0, 0};
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(valueAt<std::uint32_t>(mesh, 4 * i), head[i]) << i;
    if (is_surface) {
      EXPECT_EQ(mesh.data->size(), 44u + 6 + 9 * 3 + 4 * 3);
    } else {
      ASSERT_EQ(mesh.data->size(), 28u + 3 * 12 + 12);
      EXPECT_EQ(valueAt<float>(mesh, 28), 2.5f);
      EXPECT_EQ(valueAt<std::uint8_t>(mesh, 28 + 36 + 5), 20);
    }
  }
}

TEST(ShownScene, TextsAndCameraAreSentWhenTheyChange) {
  ShownScene scene;
  scene.update(std::vector{item("world")});
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  EXPECT_TRUE(scene.setText(&ShownScene::error, "no such file"));
  scene.setCamera({{Vector3d(1., 2., 3.), Quaterniond::Identity()}, 1.5, .9, 0., 1.25, .5, 8.});
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), (Kinds{"text", "camera"}));
  EXPECT_EQ(*messages[0].data, R"({"kind":"text","title":"","message":"","error":"no such file"})");
  EXPECT_EQ(
      *messages[1].data,
      R"({"kind":"camera","pose":[1,2,3,1,0,0,0],"distance":1.5E0,"focal":9E-1,"ortho":0,"aspect":1.25E0,"near":5E-1,"far":8})");
}

TEST(ShownScene, ARunIsSentWithEachStepAndItsEndOnce) {
  ShownScene scene;
  scene.update(std::vector{item("world")});
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  EXPECT_FALSE(scene.endRun());
  ShownRun run{1.5, .25, true};
  run.contacts.push_back({Vector3d(1., 2., 3.), Vector3d(0., 0., 8.)});
  run.perturbation = {Vector3d(1., 0., 0.), Vector3d(0., 1., 0.), 7.};
  scene.setRun(run);
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), Kinds{"run"});
  EXPECT_EQ(
      *messages[0].data,
      R"({"kind":"run","shown":1,"steered":1,"time":1.5E0,"factor":2.5E-1,"paused":1,"contacts":[1,2,3,0,0,8],"perturbation":[1,0,0,0,1,0,7]})");
  EXPECT_TRUE(scene.messagesSince(seen).empty());
  EXPECT_TRUE(scene.endRun());
  const auto end = scene.messagesSince(seen);
  ASSERT_EQ(kinds(end), Kinds{"run"});
  EXPECT_TRUE(end[0].data->starts_with(R"({"kind":"run","shown":0,)"));
  EXPECT_FALSE(scene.endRun());
}

TEST(ShownScene, WarningsAreSentWhenTheyChangeAndGoWithTheirFrames) {
  ShownScene scene;
  scene.update(std::vector{item("world"), item("box")});
  scene.setJoints(1, {}, VectorXd());
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  const std::vector<SceneWarning> warnings{{"'box' is not an obstacle", {1}, true}};
  EXPECT_TRUE(scene.setWarnings(warnings));
  EXPECT_FALSE(scene.setWarnings(warnings));
  const auto messages = scene.messagesSince(seen);
  ASSERT_EQ(kinds(messages), Kinds{"warnings"});
  EXPECT_EQ(*messages[0].data,
            R"({"kind":"warnings","warnings":[{"text":"'box' is not an obstacle","frames":[1],"ignored":1}]})");
  scene.setJoints(2, {}, VectorXd());
  const auto others = scene.messagesSince(seen);
  ASSERT_EQ(kinds(others), (Kinds{"joints", "warnings"}));
  EXPECT_EQ(*others[1].data, R"({"kind":"warnings","warnings":[]})");
}

TEST(ShownScene, AMotionHasThePairsThatTouchInEachSlice) {
  ShownScene scene;
  scene.update(std::vector{item("world")});
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  ShownMotion motion;
  motion.poses.assign(2, {Pose()});
  motion.touching = {{}, {{Vector3d(1., 2., 3.), Vector3d(4., 5., 6.), -.5, "a - b"}}};
  scene.setMotion(motion);
  const auto messages = scene.messagesSince(seen);
  const std::string expected = R"("touching":[{"points":[],"distances":[],"names":[]},)"
                               R"({"points":[1,2,3,4,5,6],"distances":[-5E-1],"names":["a - b"]}])";
  EXPECT_NE(messages.at(0).data->find(expected), std::string::npos) << *messages.at(0).data;
}

TEST(ShownScene, OnlyItemsNamedAsChangedAreReadAgain) {
  ShownScene scene;
  std::vector<ViewItem> items{item("world"), item("a"), item("b")};
  scene.update(items, std::vector<int>{});  // the first update reads all
  ShownScene::Seen seen;
  scene.messagesSince(seen);
  items[1].pose.p.x() = 1.;
  items[2].pose.p.x() = 2.;
  EXPECT_TRUE(scene.update(items, std::vector{2}));
  const auto one = scene.messagesSince(seen);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].data->size(), 8u + 32u);  // b alone
  EXPECT_FALSE(scene.update(items, std::vector<int>{}));
  EXPECT_TRUE(scene.update(items));
  EXPECT_EQ(scene.messagesSince(seen).at(0).data->size(), 8u + 32u);  // a
}

TEST(ShownScene, AnEditThatTheProgramDoesNotTakeEndsWithTheNextUpdate) {
  ShownScene scene;
  const std::vector<ViewItem> items{item("world"), item("a")};
  scene.update(items);
  EditedScene edited{{Pose(), Pose()}, VectorXd(), {}};
  edited.poses[1].p.x() = 1.;
  scene.setEdited(edited);
  EXPECT_TRUE(scene.update(items, std::vector<int>{}));
  ShownScene::Seen seen;
  const auto messages = scene.messagesSince(seen);
  float x = 5.f;
  std::memcpy(&x, messages.at(2).data->data() + 8 + 32 + 4, sizeof x);
  EXPECT_EQ(x, 0.f);
}

TEST(SceneItems, OnlyChangesOfTheSceneAreListed) {
  Config config;
  config.addFrame("base");
  Frame arm = config.addFrame("arm", "base");
  arm.setJoint(JointType::hingeX);
  config.addFrame("tip", "arm").setRelativePosition({0., 0., 1.});
  SceneItems items;
  items.read(config);
  EXPECT_EQ(items.changed(), (std::vector{0, 1, 2}));
  items.read(config);
  EXPECT_TRUE(items.changed().empty());
  config.setJointState(VectorXd::Constant(1, .5));
  items.read(config);
  EXPECT_EQ(items.changed(), (std::vector{1, 2}));
  EXPECT_EQ(items.items()[2].pose.p, Pose(config.state().pose(2)).p);
  config.getFrame(0).setName("foot");
  items.read(config);
  EXPECT_TRUE(std::count(items.changed().begin(), items.changed().end(), 0));
}
