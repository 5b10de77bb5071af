#include "kinegraph/scene/collisions.h"

#include <gtest/gtest.h>

namespace kinegraph {

TEST(IgnoredContacts, ArePairsThatOverlapNowAndNoOthers) {
  Config scene;
  scene.addText(R"g(
    world: {}
    base (world): { shape: sphere, size: [.1], contact: 1 }
    a (base): { joint: transX, shape: sphere, size: [.1], contact: 1 }
    wall (world): { Q: [.5 0 0], shape: box, size: [.1 1 1], contact: 1 }
  )g");
  const int base = scene.getFrame("base").id(), a = scene.getFrame("a").id();
  const std::vector<Config::NearPair> ignored = ignoreCollisionsNow(scene);
  ASSERT_EQ(ignored.size(), 1u);
  EXPECT_EQ(std::pair(ignored[0].a, ignored[0].b), std::pair(base, a));
  EXPECT_NEAR(ignored[0].distance, -.2, 1e-9);
  EXPECT_TRUE(scene.getCollisions().empty());
  EXPECT_TRUE(ignoreCollisionsNow(scene).empty()) << "they are ignored already";
  scene.setJointState(VectorXd::Constant(1, .45));
  EXPECT_EQ(scene.getCollisions().size(), 1u) << "the wall counts";
  EXPECT_TRUE(Config(scene).getCollisions().size() == 1u) << "and so it is in copies";
  scene.setJointState(VectorXd::Constant(1, .34));
  EXPECT_EQ(ignoreCollisionsNow(scene, .02).size(), 1u) << "10 mm from the wall";
}

}  // namespace kinegraph
