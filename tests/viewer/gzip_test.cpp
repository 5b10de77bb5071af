#include "kinegraph/viewer/gzip.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace kinegraph {
namespace {

TEST(Gzip, IsSmallForRepeatedTextAndHardlyLargerForNoise) {  // test_first_view.py reads it back
  std::string noise(100000, ' ');
  std::uint32_t number = 1;
  for (char& c : noise) c = char((number = 1664525 * number + 1013904223) >> 24);
  for (const std::string& data : {std::string(), std::string("a"), noise})
    EXPECT_LT(gzipped(data).size(), data.size() + data.size() / 100 + 40);
  EXPECT_LT(gzipped(std::string(50000, 'x')).size(), 200u);
}

TEST(Gzip, HasTheChecksumOfItsFormat) {  // the check value of CRC-32 for 123456789 is cbf43926
  const std::string text = gzipped("123456789");
  EXPECT_EQ(text.substr(0, 3), "\x1f\x8b\x08");
  EXPECT_EQ(text.substr(text.size() - 8), std::string("\x26\x39\xf4\xcb\x09\0\0\0", 8));
}

}  // namespace
}  // namespace kinegraph
