#include "kinegraph/viewer/page_content.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "kinegraph/common/errors.h"
#include "kinegraph/viewer/config_viewer.h"
#include "kinegraph/viewer/messages/commands.h"

using namespace kinegraph;

namespace {

/// A viewer without a server: browsers are replaced by commands to its content.
struct PageContentTest : ::testing::Test {
  ConfigViewer viewer;

  void send(int id, double number, const std::string& text = "") { viewer.content()->apply({id, number, text}); }
  std::string messages(PageContent::Seen& seen) const {
    std::vector<Outgoing> out;
    viewer.content()->addMessages(seen, out);
    std::string all;
    for (const Outgoing& message : out) all += message.binary ? "<binary>" : *message.data;
    return all;
  }
};

}  // namespace

TEST_F(PageContentTest, AButtonCountsClicksAndCallsInTheThreadThatPolls) {
  ViewerButton button = viewer.button("plan", {.folder = "grasp", .key = 'p'});
  int calls = 0;
  button.onClick([&] { ++calls; });
  send(1, 0);
  send(1, 0);
  EXPECT_EQ(calls, 0);
  viewer.poll();
  EXPECT_EQ(calls, 2);
  EXPECT_TRUE(button.clicked());
  EXPECT_FALSE(button.clicked());
}

TEST_F(PageContentTest, AValueOfTheProgramUpdatesThePagesAtOnce) {
  ViewerValue<double> width = viewer.slider("width", {0., .08}, .04);
  int updates = 0;
  viewer.content()->onChange([&] { ++updates; });
  width.set(.02);
  EXPECT_EQ(updates, 1);
  EXPECT_THROW(width.set(.09), ValueError);
  EXPECT_EQ(updates, 1);
}

TEST_F(PageContentTest, AControlOutlivesItsViewer) {
  auto other = std::make_unique<ConfigViewer>();
  ViewerValue<double> width = other->slider("width", {0., .08}, .04);
  other.reset();
  width.set(.02);
  EXPECT_EQ(width.value(), .02);
}

TEST_F(PageContentTest, AFloodOfClicksCallsAHundredTimes) {
  int calls = 0;
  viewer.button("plan").onClick([&] { ++calls; });
  for (int i = 0; i < 10000; ++i) send(1, 0);
  viewer.poll();
  EXPECT_EQ(calls, 100);
}

TEST_F(PageContentTest, ValuesOfBrowsersStayInTheirRange) {
  ViewerValue<double> width = viewer.slider("width", {0., .08}, .04, {.unit = "m"});
  ViewerValue<std::string> hand = viewer.choice("hand", {"left", "right"});
  ViewerValue<bool> slow = viewer.check("slow");
  double seen = 0.;
  width.onChange([&](double value) { seen = value; });
  send(1, .09);
  send(2, 0., "third");
  EXPECT_FALSE(width.changed() || hand.changed());
  send(1, .05);
  send(1, .06);
  send(2, 0., "right");
  send(3, 1.);
  viewer.poll();
  EXPECT_EQ(seen, .06);
  EXPECT_EQ(width.value(), .06);
  EXPECT_EQ(hand.value(), "right");
  EXPECT_TRUE(slow.value());
  EXPECT_TRUE(width.changed());
  EXPECT_FALSE(width.changed());
  EXPECT_THROW(width.set(1.), ValueError);
  EXPECT_THROW(hand.set("third"), ValueError);
}

TEST_F(PageContentTest, ACallbackMayRemoveItsControl) {
  viewer.button("plan").onClick([&] { viewer.remove("plan"); });
  send(1, 0);
  viewer.poll();
  EXPECT_THROW(viewer.remove("plan"), ValueError);
}

TEST_F(PageContentTest, BrowsersGetDifferencesAndLaterOnesGetTheLastState) {
  PageContent::Seen seen;
  viewer.line("path", {{0, 0, 0}, {1, 0, 0}});
  viewer.log("cost", 1.);
  EXPECT_NE(messages(seen).find("\"path\""), std::string::npos);
  EXPECT_EQ(messages(seen), "");
  viewer.log("cost", 2.);
  EXPECT_EQ(messages(seen), "<binary>");
  viewer.remove("path");
  EXPECT_NE(messages(seen).find("undraw"), std::string::npos);
  PageContent::Seen later;
  EXPECT_EQ(messages(later).find("path"), std::string::npos);
}

TEST_F(PageContentTest, DrawingsAndSamplesThatAreNotFiniteAreRefused) {
  const double nan = std::nan("");
  EXPECT_THROW(viewer.line("path", {{0, 0, 0}, {nan, 0, 0}}), ValueError);
  EXPECT_THROW(viewer.arrow("force", {0, 0, 0}, {0, 0, 1}, {.size = nan}), ValueError);
  EXPECT_THROW(viewer.image("picture", {2, 2, {1, 2, 3}}, Pose()), ValueError);
  EXPECT_THROW(viewer.points("cloud", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {.colors = {{}, {}}}), ValueError);
  EXPECT_THROW(viewer.log("cost", 1., nan), ValueError);
}
