#include "kinegraph/common/utf8.h"

#include <gtest/gtest.h>

using namespace kinegraph;

TEST(ValidUtf8, CharactersOfAllLengthsStay) {
  const std::string text = "a \xC3\xA4 \xE2\x82\xAC \xF0\x9F\x98\x80";  // a, a umlaut, euro sign, a face
  std::size_t replaced = 7;
  EXPECT_EQ(validUtf8(text, &replaced), text);
  EXPECT_EQ(replaced, 0u);
}

TEST(ValidUtf8, BytesThatAreNoCharacterBecomeQuestionMarks) {
  std::size_t replaced = 0;
  EXPECT_EQ(validUtf8("Jos\xE9\n\xFF\xC3", &replaced), "Jos?\n??");
  EXPECT_EQ(replaced, 3u);
  EXPECT_EQ(validUtf8("\xC0\x80 \xED\xA0\x80 \xF4\x90\x80\x80"),
            "?? ??? ????");  // overlong, surrogate, beyond the last
}

TEST(Utf8, OtherEncodingsOfXmlAreRecognized) {
  const std::string text = "<a name=\"\u00e9\U0001F600\"/>";
  std::string little, big;
  for (const char16_t unit : std::u16string(u"<a name=\"\u00e9\U0001F600\"/>")) {
    little += {char(unit & 255), char(unit >> 8)};
    big += {char(unit >> 8), char(unit & 255)};
  }
  EXPECT_EQ(toUtf8(little), text);
  EXPECT_EQ(toUtf8("\xFE\xFF" + big), text);
  EXPECT_EQ(toUtf8("\xEF\xBB\xBF" + text), text);
  EXPECT_EQ(toUtf8("<?xml version='1.0' encoding='ISO-8859-1'?>\xE9"),
            "<?xml version='1.0' encoding='ISO-8859-1'?>\u00e9");
  EXPECT_EQ(toUtf8("\xE9"), "\xE9");
}
