#include "kinegraph/viewer/gzip.h"

#include <boost/beast/zlib/deflate_stream.hpp>
#include <boost/crc.hpp>
#include <cstdint>

namespace kinegraph::inline viewer_internal {

namespace {

void appendNumber(std::string& text, std::uint32_t number) {
  for (int shift = 0; shift < 32; shift += 8) text += char(number >> shift & 0xff);
}

}  // namespace

std::string gzipped(std::string_view data) {
  namespace zlib = boost::beast::zlib;
  constexpr char kHeader[] = {'\x1f', '\x8b', 8, 0, 0, 0, 0, 0, 0, '\xff'};  // deflated; no name, time and system
  std::string text(kHeader, sizeof kHeader);
  const std::size_t begin = text.size();
  text.resize(begin + zlib::deflate_upper_bound(data.size()));
  zlib::deflate_stream stream;
  zlib::z_params range;
  range.next_in = data.data();
  range.avail_in = data.size();
  range.next_out = text.data() + begin;
  range.avail_out = text.size() - begin;
  boost::beast::error_code error;
  stream.write(range, zlib::Flush::finish, error);  // fits: ends with end_of_stream
  text.resize(text.size() - range.avail_out);
  boost::crc_32_type checksum;
  checksum.process_bytes(data.data(), data.size());
  appendNumber(text, checksum.checksum());
  appendNumber(text, std::uint32_t(data.size()));
  return text;
}

}  // namespace kinegraph::inline viewer_internal
