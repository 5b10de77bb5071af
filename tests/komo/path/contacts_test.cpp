#include "kinegraph/komo/path/contacts.h"

#include <gtest/gtest.h>

#include "kinegraph/komo/contact_forces.h"

using namespace kinegraph;

TEST(Contacts, TellTheForcesOfEachSliceInTheOrderOfTime) {
  Config config;
  config.addText(R"(
    world: {}
    box (world): { Q: [.1, .2, .65], joint: free, shape: ssBox, size: [.2, .2, .2, .01] }
    left (world): { Q: [-.06, .2, .65], joint: free, shape: sphere, size: [.05] }
    right (world): { Q: [.26, .2, .65], joint: free, shape: sphere, size: [.05] }
  )");
  MotionProblem motion;
  motion.path.setScene(config);
  motion.path.setGrid(TimeGrid(3., 1, 1., 0));
  EXPECT_TRUE(motion.contacts.interactions(motion.path).empty());
  addContactForce(motion, {{1., 2.}, "box", "left", .5, 2.});
  addContactForce(motion, {{2., 3.}, "box", "right", .5, 2.});
  const std::vector<Interaction> list = motion.contacts.interactions(motion.path);
  std::vector<std::pair<int, std::string>> who;
  for (const Interaction& one : list) who.emplace_back(one.slice, one.from);
  EXPECT_EQ(who, (std::vector<std::pair<int, std::string>>{{0, "left"}, {1, "left"}, {1, "right"}, {2, "right"}}));
  for (const Interaction& one : list) {
    const double side = one.from == "left" ? 1. : -1.;
    EXPECT_EQ(one.object, "box");
    EXPECT_NEAR((one.force - Vector3d(side * 2. * 9.81, 0., 0.)).norm(), 0., 1e-9);
    EXPECT_NEAR((one.point - Vector3d(.1 - side * .1, .2, .65)).norm(), 0., 1e-6);
  }
}
