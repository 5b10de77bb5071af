#include "kinegraph/common/text.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(Text, EditDistanceCountsASwapOfNeighborsAsOne) {
  EXPECT_EQ(editDistance("gripper", "gripepr"), 1.);
  EXPECT_EQ(editDistance("abc", ""), 3.);
  EXPECT_EQ(editDistance("box", "box"), 0.);
}

TEST(Text, SimilarWordsFindsTypingMistakesAndParts) {
  const std::vector<std::string> names = {"l_gripper", "l_palm", "target", "table"};
  EXPECT_EQ(similarNames("l_griper", names).front(), "l_gripper");
  EXPECT_EQ(similarNames("gripper", names).front(), "l_gripper");
  EXPECT_TRUE(similarNames("zzz", names).empty());
  EXPECT_EQ(similarHint("Table", names), "; similar names: table");
  EXPECT_EQ(similarNames("target" + std::string(10000, '_'), names), std::vector<std::string>{"target"});
}

TEST(Text, ExactNumbersReadBackUnchanged) {
  for (double value : {.1, 1. / 3., -2.5e-300, 1e22, 0.}) EXPECT_EQ(std::stod(exact(value)), value);
}

TEST(Text, IsWithinEditDistanceAgreesWithTheDistance) {
  const char* words[] = {"",       "a",     "shape", "shpae", "Shape",  "shapes", "joint",
                         "joints", "jiont", "mesh",  "hinge", "hingeX", "ab",     "ba"};
  for (const char* a : words) {
    for (const char* b : words) {
      for (double limit : {0., .5, 1., 1.2, 2., 3.}) {
        EXPECT_EQ(isWithinEditDistance(a, b, limit), editDistance(a, b) <= limit) << a << " " << b << " " << limit;
      }
    }
  }
}
