#include "kinegraph/viewer/messages/messages.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>

using namespace kinegraph;

namespace {

std::string quoted(const std::string& title) {
  const std::string text = jsonText(TextMessage{title, "", ""}), before = R"({"kind":"text","title":)",
                    after = R"(,"message":"","error":""})";
  EXPECT_TRUE(text.starts_with(before) && text.ends_with(after)) << text;
  return text.substr(before.size(), text.size() - before.size() - after.size());
}

}  // namespace

TEST(Messages, NestObjectsAndLists) {
  SceneMessage scene;
  scene.count = 2;
  scene.frames = {{0, "world", -1, 0, "", std::nullopt},
                  {1, "box", 0, 1, "contact: 1", ShapeMessage{"box", {1., .25}, {}, -1}}};
  EXPECT_EQ(
      jsonText(scene),
      R"({"kind":"scene","count":2,"frames":[{"id":0,"name":"world","parent":-1,"collides":0,"details":"","shape":null},)"
      R"({"id":1,"name":"box","parent":0,"collides":1,"details":"contact: 1","shape":{"type":"box","size":[1,2.5E-1],"color":[],"mesh":-1}}]})");
}

TEST(Messages, NumbersThatAreNotFiniteAreNull) {
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(
      jsonText(CameraMessage{{infinity, std::nan(""), 1e-300}, -0.5, 1e300, 0., 1., 0., 5.}),
      R"({"kind":"camera","pose":[null,null,1E-300],"distance":-5E-1,"focal":1E300,"ortho":0,"aspect":1,"near":0,"far":5})");
}

TEST(Messages, EscapeQuotesBackslashesAndControlCharacters) {
  EXPECT_EQ(quoted("a \"b\" \\c\n\t\x01"), R"("a \"b\" \\c\n\t\u0001")");
  EXPECT_EQ(quoted(std::string("\0", 1)), R"("\u0000")");
}

TEST(Messages, KeepUtf8AndReplaceBytesThatAreNot) {
  for (const std::string text : {"gr\u00fcn", "\u20ac", "\U0001F916", "\uffff", "\U0010ffff"})
    EXPECT_EQ(quoted(text), '"' + text + '"');
  EXPECT_EQ(quoted("gr\xfcn"), "\"gr\ufffdn\"");                            // Latin-1
  EXPECT_EQ(quoted("\xe2\x82"), "\"\ufffd\ufffd\"");                        // cut off
  EXPECT_EQ(quoted("\xc0\xaf"), "\"\ufffd\ufffd\"");                        // longer than needed
  EXPECT_EQ(quoted("\xed\xa0\x80"), "\"\ufffd\ufffd\ufffd\"");              // half of a surrogate pair
  EXPECT_EQ(quoted("\xf4\x90\x80\x80x"), "\"\ufffd\ufffd\ufffd\ufffdx\"");  // beyond the last character
}

TEST(Messages, NumbersReadBackExactly) {
  for (const double number : {.1, -1. / 3., 1e-300, 1e300, 3., -1e15, 9007199254740994.}) {
    const std::string text = jsonText(CameraMessage{{}, number, 0., 0., 0., 0., 0.}), key = "\"distance\":";
    EXPECT_EQ(std::strtod(text.c_str() + text.find(key) + key.size(), nullptr), number) << text;
  }
}
