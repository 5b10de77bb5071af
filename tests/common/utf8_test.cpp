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
