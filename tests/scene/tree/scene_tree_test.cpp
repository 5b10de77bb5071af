#include "kinegraph/scene/tree/scene_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/random.h"
#include "kinegraph/common/text.h"
#include "tests/support/expect_error.h"

namespace kinegraph {
namespace {

Pose randomPose(Rng& rng) {
  const Vector3d p(rng.normal(), rng.normal(), rng.normal());
  return Pose(p, Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized());
}

FrameData& randomFrame(SceneTree& scene, Rng& rng) {
  return *scene.frames()[std::size_t(rng.uniform(0., double(scene.frames().size()) - 1e-9))];
}

/// A tree of `count` frames, a third of them with joints.
void grow(SceneTree& scene, int count, Rng& rng) {
  for (int i = 0; i < count; ++i) {
    FrameData* parent = scene.frames().empty() || rng.uniform() < .1 ? nullptr : &randomFrame(scene, rng);
    FrameData& frame = scene.add(cat("f", i), parent);
    frame.pose = randomPose(rng);
    if (parent && i % 3 == 0) frame.joint = Joint(i % 2 == 0 ? JointType::hingeY : JointType::transXYPhi);
    if (frame.joint) {
      for (double& x : frame.joint->q) x = rng.normal();
    }
  }
  scene.structureChanged();
}

/// Ids are places, and parents and children agree.
void expectConsistent(const SceneTree& scene) {
  std::size_t children = 0, parents = 0;
  for (std::size_t i = 0; i < scene.frames().size(); ++i) {
    const FrameData& frame = *scene.frames()[i];
    EXPECT_EQ(std::size_t(frame.id), i);
    EXPECT_EQ(frame.tree, &scene);
    parents += frame.parent != nullptr;
    children += frame.children.size();
    for (const FrameData* child : frame.children) {
      EXPECT_EQ(child->parent, &frame);
      EXPECT_EQ(child->tree, &scene);
    }
  }
  EXPECT_EQ(children, parents);
}

std::vector<Pose> worldPoses(const SceneTree& scene) {
  std::vector<Pose> poses;
  for (const auto& frame : scene.frames()) poses.push_back(frame->worldPose());
  return poses;
}

bool isNear(const Pose& a, const Pose& b) { return (a.inverse() * b).isIdentity(1e-12); }

TEST(SceneTree, IdsArePlacesAndParentsKnowTheirChildrenAfterEveryEdit) {
  SceneTree scene;
  Rng rng(1);
  grow(scene, 40, rng);
  for (int edit = 0; edit < 200; ++edit) {
    FrameData &frame = randomFrame(scene, rng), &other = randomFrame(scene, rng);
    const double what = rng.uniform();
    try {
      if (what < .3)
        scene.add(cat("g", edit), &other);
      else if (what < .5)
        scene.remove(frame);
      else if (what < .8)
        scene.link(frame, other);
      else if (what < .9)
        scene.sortByDepth();
      else if (frame.parent)
        scene.unlink(frame);
    } catch (const ValueError&) {  // a loop: nothing may have changed
    }
    expectConsistent(scene);
  }
}

TEST(SceneTree, RemovingAFrameLeavesAllOthersWhereTheyAre) {
  Rng rng(2);
  for (int sample = 0; sample < 20; ++sample) {
    SceneTree scene;
    grow(scene, 20, rng);
    FrameData& removed = randomFrame(scene, rng);
    std::vector<Pose> before = worldPoses(scene);
    before.erase(before.begin() + removed.id);
    scene.remove(removed);
    const std::vector<Pose> after = worldPoses(scene);
    ASSERT_EQ(after.size(), before.size());
    for (std::size_t i = 0; i < after.size(); ++i) EXPECT_TRUE(isNear(after[i], before[i]));
  }
}

TEST(SceneTree, JointsThatMimickedARemovedFrameKeepItsValuesAsTheirOwn) {
  SceneTree scene;
  FrameData& root = scene.add("root", nullptr);
  FrameData &leader = scene.add("leader", &root), &follower = scene.add("follower", &root);
  leader.joint = Joint(JointType::hingeX);
  leader.joint->q[0] = .7;
  follower.joint = Joint(JointType::hingeX);
  follower.joint->mimic = &leader;
  scene.structureChanged();
  EXPECT_EQ(scene.jointState().size(), 1);
  scene.remove(leader);
  EXPECT_EQ(follower.joint->mimic, nullptr);
  ASSERT_EQ(scene.jointState().size(), 1);
  EXPECT_EQ(scene.jointState()[0], .7);
}

TEST(SceneTree, LoopsAreRefusedByName) {
  SceneTree scene;
  FrameData& a = scene.add("a", nullptr);
  FrameData& b = scene.add("b", &a);
  FrameData& c = scene.add("c", &b);
  expectError<ValueError>([&] { scene.link(a, c); }, {"'a'", "'c'", "descendants"});
  expectError<ValueError>([&] { scene.link(b, b); }, {"'b'", "the same frame"});
  expectError<FrameNotFound>([&] { scene.get("d", "asked"); }, {"asked", "'d'"});
  EXPECT_EQ(a.parent, nullptr);
}

TEST(SceneTree, SortingPutsParentsFirstAndKeepsPosesAndTheOrderOfOneDepth) {
  SceneTree scene;
  Rng rng(3);
  grow(scene, 15, rng);
  for (int i = 0; i < 30; ++i) {
    try {
      scene.link(randomFrame(scene, rng), randomFrame(scene, rng));
    } catch (const ValueError&) {
    }
  }
  std::vector<const FrameData*> order;
  std::vector<Pose> poses = worldPoses(scene);
  for (const auto& frame : scene.frames()) order.push_back(frame.get());
  scene.sortByDepth();
  const auto depth = [](const FrameData* frame) {
    int steps = 0;
    for (; frame->parent; frame = frame->parent) ++steps;
    return steps;
  };
  const auto place = [&](const FrameData* frame) { return std::ranges::find(order, frame) - order.begin(); };
  for (std::size_t i = 0; i < scene.frames().size(); ++i) {
    const FrameData* frame = scene.frames()[i].get();
    EXPECT_TRUE(isNear(frame->worldPose(), poses[std::size_t(place(frame))]));
    if (i == 0) continue;
    const FrameData* before = scene.frames()[i - 1].get();
    EXPECT_LE(depth(before), depth(frame));
    if (depth(before) == depth(frame)) EXPECT_LT(place(before), place(frame)) << frame->name;
  }
  expectConsistent(scene);
}

TEST(SceneTree, AppendedCopiesAreDeepAndShareWhatTheOriginalsShare) {
  SceneTree scene, target;
  Rng rng(4);
  grow(scene, 12, rng);
  const auto shape = std::make_shared<Shape>();
  scene.frames()[1]->shape = scene.frames()[2]->shape = shape;
  target.add("first", nullptr);
  FrameData* copy = target.append(scene, "copy_");
  ASSERT_EQ(target.frames().size(), 13u);
  EXPECT_EQ(copy->name, "copy_f0");
  expectConsistent(target);
  for (std::size_t i = 0; i < scene.frames().size(); ++i) {
    EXPECT_TRUE(isNear(target.frames()[i + 1]->worldPose(), scene.frames()[i]->worldPose()));
  }
  EXPECT_EQ(target.frames()[2]->shape, target.frames()[3]->shape);
  EXPECT_NE(target.frames()[2]->shape, shape);
  const Pose before = copy->worldPose();
  scene.frames()[0]->pose = randomPose(rng);
  EXPECT_TRUE(isNear(copy->worldPose(), before));
  EXPECT_EQ(target.append(SceneTree(), "none_"), nullptr);
}

TEST(SceneTree, TheStateFollowsAnyNumberOfEditsOfPosesAndJoints) {
  SceneTree scene;
  Rng rng(5);
  grow(scene, 30, rng);
  const std::shared_ptr<const KinematicModel> model = scene.model();
  for (int round = 0; round < 20; ++round) {
    for (int edits = round; edits > 0; --edits) {  // few, which are taken over one by one, and many
      FrameData& frame = randomFrame(scene, rng);
      if (frame.moves()) {
        for (double& x : frame.joint->q) x = rng.normal();
        scene.jointsChanged();
      } else {
        frame.pose = randomPose(rng);
        scene.poseChanged(frame);
      }
    }
    const State& state = scene.state();
    for (const auto& frame : scene.frames()) {
      const RigidTransform X = state.pose(frame->id);
      EXPECT_TRUE(isNear(Pose(X.p, Quaterniond(X.R)), frame->worldPose())) << frame->name << " in round " << round;
      EXPECT_TRUE(isNear(scene.worldPose(*frame), frame->worldPose()));
    }
  }
  EXPECT_EQ(scene.model(), model) << "values do not change the structure";
  scene.add("more", nullptr);
  EXPECT_NE(scene.model(), model);
}

TEST(SceneTree, JointStatesAreThoseOfTheActiveJointsInTheOrderOfTheFrames) {
  SceneTree scene;
  Rng rng(6);
  grow(scene, 30, rng);
  VectorXd q(scene.model()->dofs);
  for (double& x : q) x = rng.normal();
  scene.setJointState(q.data());
  EXPECT_EQ(scene.jointState(), q);
  int dof = 0;
  for (const auto& frame : scene.frames()) {
    if (!frame->moves()) continue;
    EXPECT_EQ(frame->joint->q, q.segment(dof, frame->joint->dofs()));
    dof += frame->joint->dofs();
  }
  EXPECT_EQ(dof, q.size());
}

/// In scenes of few frames as in scenes of many, and where several have one name.
TEST(SceneTree, ANameFindsTheFirstAndTheLastFrameAfterAnyEdit) {
  SceneTree scene;
  Rng rng(8);
  const auto name = [&] { return cat("n", int(rng.uniform(0., 30.))); };
  for (int round = 0; round < 600; ++round) {
    const double what = rng.uniform();
    if (what < .6 || scene.frames().size() < 2) {
      scene.add(name(), scene.frames().empty() || rng.uniform() < .3 ? nullptr : &randomFrame(scene, rng));
    } else if (what < .8) {
      scene.remove(randomFrame(scene, rng));
    } else if (what < .95) {
      scene.rename(randomFrame(scene, rng), name());
    } else {
      scene.sortByDepth();
    }
    const std::string wanted = name();
    FrameData *first = nullptr, *last = nullptr;
    for (const auto& frame : scene.frames()) {
      if (frame->name != wanted) continue;
      if (!first) first = frame.get();
      last = frame.get();
    }
    EXPECT_EQ(scene.find(wanted), first);
    EXPECT_EQ(std::as_const(scene).find(wanted), first);
    EXPECT_EQ(scene.findLast(wanted), last);
  }
  EXPECT_GT(scene.frames().size(), 32u);
}

TEST(SceneTree, ABuiltSceneIsNotCompiledAtEveryQuestion) {
  SceneTree scene;
  FrameData& world = scene.add("world", nullptr);
  int compiled = 0;
  const KinematicModel* last = nullptr;
  for (int i = 0; i < 1000; ++i) {
    FrameData& frame = scene.add(cat("f", i), &world);
    frame.pose.p.x() = i;
    scene.posesChanged();
    for (int k = 0; k < 3; ++k) EXPECT_DOUBLE_EQ(scene.worldPose(frame).p.x(), i);
    if (scene.compiled() != last) ++compiled;
    last = scene.compiled();
  }
  EXPECT_LT(compiled, 20);
}

TEST(SceneTree, TheJointStateOfASceneThatIsBeingBuiltNeedsNoCompiling) {
  SceneTree scene;
  FrameData& world = scene.add("world", nullptr);
  for (int i = 0; i < 100; ++i) {
    FrameData& frame = scene.add(cat("f", i), &world);
    frame.joint = Joint(i % 3 == 0 ? JointType::transXY : i % 3 == 1 ? JointType::hingeX : JointType::rigid);
    if (i % 3 < 2) frame.joint->q.setConstant(i);
    frame.joint->active = i % 5 != 0;
    if (i % 7 == 4)
      frame.joint->mimic = scene.frames()[std::size_t(i) - 2].get();  // three earlier, as the world is the first
    scene.structureChanged();
    const VectorXd q = scene.jointState();
    EXPECT_EQ(scene.compiled(), nullptr);
    if (i > 0 && i % 3 == 1 && i % 5 != 0 && i % 7 != 4) EXPECT_EQ(q[q.size() - 1], i);
  }
  const VectorXd before = scene.jointState();
  EXPECT_EQ(before.size(), scene.model()->dofs);
  EXPECT_EQ(scene.jointState(), before);
}

}  // namespace
}  // namespace kinegraph
