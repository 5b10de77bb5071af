#include "kinegraph/scene/frame.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "kinegraph/scene/config.h"
#include "tests/support/expect_error.h"

using namespace kinegraph;

namespace {

/// Two branches with joints, one of which is free, and a root of its own.
Config tree() {
  Config config;
  config.addText(R"(
base: { pose: [.1 .2 .3 .9 .1 .2 .3], shape: ssBox, size: [.4 .4 .1 .01], contact: 1 }
turn(base): { pre: [0 0 .1], joint: hingeZ, q: .4 }
link(turn): { Q: [.2 0 .1 .8 .6 0 0], shape: capsule, size: [.3 .05] }
tip(link): { Q: [0 .1 .2] }
ball(base): { joint: quatBall }
free(ball): { joint: free, shape: sphere, size: [.05] }
other: { pose: [1 0 0] }
)");
  return config;
}

Pose randomPose(Rng& rng) {
  const Vector3d p(rng.normal(), rng.normal(), rng.normal());
  return Pose(p, Quaterniond(rng.normal(), rng.normal(), rng.normal(), rng.normal()).normalized());
}

bool isNear(const Pose& a, const Pose& b) { return (a.inverse() * b).isIdentity(1e-12); }

std::vector<std::string> namesOf(const std::vector<Frame>& frames) {
  std::vector<std::string> names;
  for (const Frame& frame : frames) names.push_back(frame.getName());
  return names;
}

}  // namespace

TEST(Frame, TheWorldPoseIsTheParentsTimesTheRelativeOne) {
  Config config = tree();
  Rng rng(1);
  for (int sample = 0; sample < 10; ++sample) {
    config.getFrame("link").setRelativePose(randomPose(rng));
    config.getFrame("base").setPose(randomPose(rng));
    config.getFrame("turn").setJointState(VectorXd::Constant(1, rng.normal()));
    for (const Frame& frame : config.getFrames()) {
      const std::optional<Frame> parent = frame.getParent();
      const Pose above = parent ? parent->getPose() : Pose();
      if (parent) EXPECT_TRUE(isNear(above * frame.getRelativePose(), frame.getPose())) << frame.getName();
      for (const Frame& other : config.getFrames()) {
        EXPECT_TRUE(isNear(other.getPose() * frame.getPose(other), frame.getPose()));
      }
    }
  }
}

TEST(Frame, ASetPoseIsReturnedAndFramesBelowFollow) {
  Config config = tree();
  Rng rng(2);
  for (const char* name : {"base", "link", "tip", "free", "other"}) {  // a root, fixed frames, a free joint
    Frame frame = config.getFrame(name);
    const Pose X = randomPose(rng);
    std::vector<Pose> below;
    for (const Frame& child : frame.getSubtree()) below.push_back(child.getPose(frame));
    EXPECT_TRUE(isNear(frame.setPose(X).getPose(), X)) << name;
    const std::vector<Frame> subtree = frame.getSubtree();
    for (std::size_t i = 0; i < subtree.size(); ++i) EXPECT_TRUE(isNear(subtree[i].getPose(frame), below[i]));
    frame.setPosition({1., 2., 3.});
    EXPECT_TRUE(isNear(frame.getPose(), Pose(Vector3d(1., 2., 3.), X.q))) << name;
    frame.setQuaternion(Quaterniond(0., 5., 0., 0.));  // of any length
    EXPECT_TRUE(isNear(frame.getPose(), Pose(Vector3d(1., 2., 3.), Quaterniond(0., 1., 0., 0.)))) << name;
  }
}

TEST(Frame, AJointTakesTheNearestPoseThatItReaches) {
  Config config = tree();
  Frame turn = config.getFrame("turn");
  turn.setRelativePose(Pose(Vector3d::Zero(), Quaterniond(Eigen::AngleAxisd(1.1, Vector3d::UnitZ()))));
  EXPECT_NEAR(turn.getJointState()[0], 1.1, 1e-12);
  const Pose before = config.getFrame("ball").getPose();
  config.getFrame("ball").setPose(Pose(before.p + Vector3d(1., 0., 0.), before.q));
  EXPECT_TRUE(isNear(config.getFrame("ball").getPose(), before)) << "a ball joint cannot slide";
}

TEST(Frame, TheSubtreeIsWhatHasTheFrameAboveItDepthFirst) {
  const Config config = tree();
  EXPECT_EQ(namesOf(config.getFrame("base").getSubtree()),
            (std::vector<std::string>{"ball", "free", "turn_origin", "turn", "link", "tip"}));
  EXPECT_EQ(namesOf(config.getFrame("base").getChildren()), (std::vector<std::string>{"ball", "turn_origin"}));
  EXPECT_TRUE(config.getFrame("other").getSubtree().empty());
  EXPECT_FALSE(config.getFrame("other").getParent());
  EXPECT_EQ(config.getFrame("tip").getParent(), config.getFrame("link"));
}

TEST(Frame, AJointIsGivenAndTakenWithoutMovingTheFrame) {
  Config config = tree();
  Frame tip = config.getFrame("tip");
  const Pose before = tip.getPose();
  for (const JointType type : {JointType::free, JointType::rigid, JointType::none}) {
    tip.setJoint(type);
    EXPECT_EQ(tip.getJointType(), type);
    EXPECT_TRUE(isNear(tip.getPose(), before)) << jointTypeName(type);
  }
  const int dofs = config.getJointDimension();
  tip.setJoint(JointType::hingeX, {-1., 2.});
  EXPECT_EQ(config.getJointDimension(), dofs + 1);
  EXPECT_EQ(config.getFrame("other").getJointType(), JointType::none);
  expectError<ValueError>([&] { config.getFrame("other").getJointState(); }, {"other"});
}

TEST(Frame, ShapesOfCopiesAreTheirOwn) {
  Config config = tree();
  const Config copy = config;
  config.getFrame("base").setShape(ShapeType::sphere, {.3}).setContact(0).setColor({1., 0., 0.});
  EXPECT_EQ(config.getFrame("base").getShapeType(), ShapeType::sphere);
  EXPECT_EQ(config.getFrame("base").getSize().back(), .3);
  EXPECT_EQ(copy.getFrame("base").getShapeType(), ShapeType::ssBox);
  EXPECT_EQ(copy.getFrame("base").data().shape->contact, 1);
  EXPECT_EQ(config.getFrame("tip").getShapeType(), ShapeType::none);
  EXPECT_TRUE(config.getFrame("tip").getSize().empty());
}

TEST(Frame, NamesAreThoseOfOneFrameOnly) {
  Config config = tree();
  Frame tip = config.getFrame("tip");
  tip.setName("end");
  EXPECT_EQ(config.getFrame("end"), tip);
  EXPECT_FALSE(config.findFrame("tip"));
  expectError<ValueError>([&] { tip.setName("base"); }, {"base"});
  EXPECT_EQ(tip.getName(), "end");
  tip.setName("end");  // its own
}

TEST(Frame, HandlesOfDeletedFramesThrow) {
  Config config = tree();
  Frame tip = config.getFrame("tip");
  config.delFrame("tip");
  EXPECT_THROW(tip.getPose(), FrameDeleted);
  Frame base = config.getFrame("base");
  config.clear();
  EXPECT_THROW(base.setPosition({0, 0, 0}), FrameDeleted);
  std::optional<Frame> orphan;
  {
    Config short_lived = tree();
    orphan = short_lived.getFrame("link");
  }
  EXPECT_EQ(orphan->getName(), "link");
}

TEST(Frame, MistakesAreExplained) {
  Config config = tree();
  expectError([&] { config.getFrame("base").setParent(config.getFrame("link")); }, {"one of its descendants"});
  expectError([&] { config.getFrame("base").setRelativePosition({0, 0, 0}); }, {"has no parent"});
  expectError([&] { config.getFrame("base").setJoint(JointType::hingeX); },
              {"cannot have a joint", "call setParent first", "a new frame 'world'"});
  expectError([&] { config.getFrame("ball").setContact(1); }, {"has no shape"});
}

TEST(Frame, ARootGetsAJointOnceItHasAParentAsTheErrorAdvises) {
  Config config;
  config.addFrame("box").setPosition({1., 0., 0.});
  config.getFrame("box").setParent(config.addFrame("world"), true).setJoint(JointType::transX, {-1., 4.});
  EXPECT_EQ(config.getJointDimension(), 1);
  EXPECT_TRUE(config.getFrame("box").getPosition().isApprox(Vector3d(1., 0., 0.), 1e-12));
}

TEST(Frame, ReattachingKeepsTheRelativeOrTheWorldPose) {
  Config config;
  config.addText("a: { X: [1 0 0] }  b: { X: [0 1 0] }");
  config.getFrame("b").setParent(config.getFrame("a"), true);
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(0, 1, 0)).norm(), 1e-15);
  config.getFrame("b").unLink();
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(0, 1, 0)).norm(), 1e-15);
  config.getFrame("b").setParent(config.getFrame("a"));
  EXPECT_LT((config.getFrame("b").getPose().p - Vector3d(1, 0, 0)).norm(), 1e-15);
}

TEST(Frame, MassesAreThoseOfTheSurface) {
  Config config;
  config.addText("a: { shape: box, size: [1 2 3], mass: 1 }  b: { shape: sphere, size: [.5], mass: 1 }");
  EXPECT_LT((config.getFrame("a").getInertia()->matrix.diagonal() - Vector3d(1.537879, 1.196970, .689394)).norm(),
            2e-6);
  EXPECT_NEAR(config.getFrame("b").getInertia()->matrix(0, 0), 1. / 6., 1e-12);
}

TEST(Frame, GeometriesThatContradictThemselvesAreRefused) {
  Config config;
  const auto refused = [&](const Geometry& geometry, const char* reason) {
    expectError<ValueError>([&] { config.addFrame("a").setGeometry(geometry); }, {"frame 'a': ", reason});
  };
  refused({ShapeType::box, {}, nullptr}, "a box has 3 sizes, got 0");
  refused({ShapeType::sphere, {std::nan("")}, nullptr}, "its sizes are not finite");
  Mesh mesh;
  mesh.vertices = {Vector3d::Zero(), Vector3d::UnitX(), Vector3d::UnitY()};
  const auto with = [&](auto change) {
    Mesh changed = mesh;
    change(changed);
    return Geometry{ShapeType::mesh, {}, std::make_shared<const Mesh>(changed)};
  };
  refused(with([](Mesh& m) { m.triangles = {{0, 1, 9}}; }), "triangle 0 has the vertex 9 of 3");
  refused(with([](Mesh& m) { m.vertices[1].x() = INFINITY; }), "vertex 1 is not finite");
  refused(with([](Mesh& m) { m.colors.resize(2); }), "it has 2 colors for 3 vertices");
  refused(with([](Mesh& m) { m.texcoords.resize(2); }), "it has 2 texture coordinates for 3 vertices");
  refused(with([](Mesh& m) { m.parts = {0, 2, 1}; }), "its parts do not ascend within its 3 vertices");
  Geometry grid{ShapeType::sdf, {1., 1., 1.}, nullptr};
  for (const int cells : {0, -5, 1, 5}) {
    grid.grid = std::make_shared<const Grid>(Grid{{cells, 5, 5}, {}});
    refused(grid, "5 x 5 has 0 values");
  }
  grid.grid = std::make_shared<const Grid>(Grid{{1, 2, 2}, std::vector<float>(4)});
  refused(grid, "1 x 2 x 2 has 4 values; expected at least 2 x 2 x 2");
  grid.grid = std::make_shared<const Grid>(Grid{{2, 2, 2}, std::vector<float>(8, NAN)});
  refused(grid, "its grid has values that are not finite");
  EXPECT_NO_THROW(config.addFrame("a").setGeometry(with([](Mesh& m) { m.triangles = {{0, 1, 2}}; })));
}
