#include "kinegraph/parsers/xml/xml.h"

#include <gtest/gtest.h>

using namespace kinegraph;

namespace {

std::string messageOf(const char* text) {
  try {
    parseXml(text, "a.xml");
  } catch (const ParseError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST(ParseXml, KnowsLineAndColumnOfElementsAndAttributes) {
  const XmlElement root = parseXml(
      "<?xml version=\"1.0\"?>\n"
      "<!-- <not an='element'/> -->\n"
      "<a x='1'\n"
      "   y=\"2 > 1\"><b/><c z='3'/>\n"
      "  <b w='&lt;'/>\n"
      "</a>",
      "a.xml");
  EXPECT_EQ(root.where.str(), "a.xml:3:1");
  EXPECT_EQ(root.attribute("x")->where.str(), "a.xml:3:4");
  EXPECT_EQ(root.attribute("y")->where.str(), "a.xml:4:4");
  EXPECT_EQ(root.attribute("y")->value, "2 > 1");
  EXPECT_EQ(root.child("c")->where.str(), "a.xml:4:18");
  EXPECT_EQ(root.child("c")->attribute("z")->where.str(), "a.xml:4:21");
  ASSERT_EQ(root.all("b").size(), 2u);
  EXPECT_EQ(root.all("b")[1]->where.str(), "a.xml:5:3");
  EXPECT_EQ(root.all("b")[1]->attribute("w")->value, "<");
  EXPECT_EQ(root.child("d"), nullptr);
}

TEST(ParseXml, SaysWhatIsNotWellFormedAndWhere) {
  EXPECT_EQ(messageOf("<a>\n  <b>\n</a>"), "a.xml:2:3: the element is not closed by a tag of the same name");
  EXPECT_NE(messageOf("<a x=1/>").find("a.xml:1:1: an attribute is not of the form name=\"value\""), std::string::npos);
  EXPECT_NE(messageOf("").find("no XML element"), std::string::npos);
}

TEST(XmlEscaped, ReadsBackAsTheSameText) {
  const std::string text = "a<b> & \"c\" 'd'";
  EXPECT_EQ(parseXml("<a x=\"" + xmlEscaped(text) + "\"/>", "").attribute("x")->value, text);
}
