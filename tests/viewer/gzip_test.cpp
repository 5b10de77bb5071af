#include "kinegraph/viewer/gzip.h"

#include <gtest/gtest.h>

#include <boost/beast/zlib/inflate_stream.hpp>

namespace kinegraph {
namespace {

/// Returns the deflated part of a gzip text, inflated by an independent call.
std::string inflated(const std::string& text, std::size_t size) {
  namespace zlib = boost::beast::zlib;
  std::string out(size + 1, '\0');
  zlib::inflate_stream stream;
  zlib::z_params range;
  range.next_in = text.data() + 10;
  range.avail_in = text.size() - 18;
  range.next_out = out.data();
  range.avail_out = out.size();
  boost::beast::error_code error;
  stream.write(range, zlib::Flush::finish, error);
  EXPECT_EQ(error, zlib::error::end_of_stream);
  out.resize(out.size() - range.avail_out);
  return out;
}

TEST(Gzip, IsReadBack) {
  std::string noise(100000, ' ');
  std::uint32_t number = 1;
  for (char& c : noise) c = char((number = 1664525 * number + 1013904223) >> 24);
  for (const std::string& data : {std::string(), std::string("a"), std::string(50000, 'x'), noise}) {
    const std::string text = gzipped(data);
    EXPECT_EQ(inflated(text, data.size()), data);
    EXPECT_LT(text.size(), data.size() + data.size() / 100 + 40);
  }
  EXPECT_LT(gzipped(std::string(50000, 'x')).size(), 200u);
}

TEST(Gzip, HasTheChecksumOfItsFormat) {  // the check value of CRC-32 for 123456789 is cbf43926
  const std::string text = gzipped("123456789");
  EXPECT_EQ(text.substr(0, 3), "\x1f\x8b\x08");
  EXPECT_EQ(text.substr(text.size() - 8), std::string("\x26\x39\xf4\xcb\x09\0\0\0", 8));
}

}  // namespace
}  // namespace kinegraph
