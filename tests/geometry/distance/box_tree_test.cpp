#include "kinegraph/geometry/distance/closed_form/box_tree.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "kinegraph/common/random.h"

using namespace kinegraph;

namespace {

WorldBox randomBox(Rng& rng) {
  const Vector3d center(rng.normal(), rng.normal(), rng.normal());
  const Vector3d half(rng.uniform(0., .2), rng.uniform(0., .2), rng.uniform(0., .2));
  return {center - half, center + half};
}

void expectMeetings(const BoxTree& tree, const std::vector<WorldBox>& boxes, Rng& rng) {
  for (int question = 0; question < 20; ++question) {
    const WorldBox box = randomBox(rng);
    const double reach = question % 2 == 0 ? 0. : .3;
    std::vector<int> expected, found;
    for (int i = 0; i < int(boxes.size()); ++i) {
      if (boxes[std::size_t(i)].meets(box, reach)) expected.push_back(i);
    }
    tree.forMeeting(box, reach, [&](int i) { found.push_back(i); });
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, expected);
  }
}

}  // namespace

TEST(BoxTree, FindsAllBoxesThatMeetOneAndNoOthersAlsoAfterTheyMoved) {
  Rng rng(1);
  for (const int count : {1, 2, 3, 100, 500}) {
    std::vector<WorldBox> boxes;
    for (int i = 0; i < count; ++i) boxes.push_back(randomBox(rng));
    BoxTree tree;
    tree.build(boxes);
    EXPECT_EQ(tree.spread(), 1.);
    expectMeetings(tree, boxes, rng);
    for (int i = 0; i < count; i += 3) {
      boxes[std::size_t(i)] = randomBox(rng);
      tree.move(i, boxes[std::size_t(i)]);
    }
    expectMeetings(tree, boxes, rng);
  }
}

TEST(BoxTree, OfNothingFindsNothing) {
  BoxTree tree;
  tree.build({});
  tree.forMeeting({Vector3d::Constant(-1.), Vector3d::Constant(1.)}, 1., [](int) { FAIL(); });
}

TEST(BoxTree, SpreadsWhereNeighborsTravelApart) {
  Rng rng(2);
  std::vector<WorldBox> boxes;
  for (int i = 0; i < 200; ++i) boxes.push_back(randomBox(rng));
  BoxTree tree;
  tree.build(boxes);
  for (int i = 0; i < 200; ++i) tree.move(i, randomBox(rng));
  EXPECT_GT(tree.spread(), 1.5);
}
