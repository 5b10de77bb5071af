#include "kinegraph/task_planning/motions/start_contacts.h"

#include <gtest/gtest.h>

#include "tests/task_planning/task_scenes.h"

namespace kinegraph {
namespace {

/// Whether the scene reports a pair that is closer than 5 mm.
bool reports(const Config& C, const std::string& a, const std::string& b) {
  for (const Config::NearPair& pair : C.getCollisions(5e-3)) {
    const std::string first = C.getFrame(pair.a).getName(), second = C.getFrame(pair.b).getName();
    if ((first == a && second == b) || (first == b && second == a)) return true;
  }
  return false;
}

TEST(StartContacts, OfNeighborsThatAnActionSeparatesAreKept) {
  Config C = cubesOnATable(2);
  C.getFrame("b1").setRelativePosition({-.5 + .102, 0., .1});  // 2 mm beside b0
  C.getFrame("b0").setRelativePosition({-.5, 0., .101});       // 1 mm above the table
  const Config scene = withoutGivenContacts(C, 5e-3);
  EXPECT_TRUE(reports(scene, "b0", "b1"));
  EXPECT_TRUE(reports(scene, "b0", "table"));
}

TEST(StartContacts, OfABaseAndItsFloorAreLeftOut) {
  Config C = cubesOnATable(0);
  C.addFrame("pan", "base", "joint: hingeZ, pre: [.7 .7 0]");
  C.addFrame("post", "pan", "shape: cylinder, size: [.2 .05], contact: 1, rel: [0 0 .102]");
  ASSERT_TRUE(reports(C, "post", "table"));
  EXPECT_FALSE(reports(withoutGivenContacts(C, 5e-3), "post", "table"));
}

}  // namespace
}  // namespace kinegraph
