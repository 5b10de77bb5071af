#include <zlib.h>

#include <algorithm>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_decoders.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::size_t kChunk = 1 << 16;  ///< initial buffer size, bytes: `limit` comes from an untrusted header

class Inflater {
 public:
  explicit Inflater(std::string_view bytes) {
    stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    stream_.avail_in = uInt(bytes.size());
    if (inflateInit(&stream_) != Z_OK) throw FileError("its compressed data cannot be read: out of memory");
  }
  ~Inflater() { inflateEnd(&stream_); }
  Inflater(const Inflater&) = delete;

  /// Fills `out` from `begin`; returns the end, which is before the end of `out` only at the end of the data.
  std::size_t fill(std::string& out, std::size_t begin) {
    stream_.next_out = reinterpret_cast<Bytef*>(out.data() + begin);
    stream_.avail_out = uInt(out.size() - begin);
    const int status = inflate(&stream_, Z_NO_FLUSH);
    const std::size_t end = out.size() - stream_.avail_out;
    if (end == out.size() || status == Z_STREAM_END) return end;
    if (status == Z_DATA_ERROR) throw FileError(cat("its compressed data are damaged: ", stream_.msg));
    throw FileError("its compressed data end too early");
  }

 private:
  z_stream stream_{};
};

}  // namespace

std::string unpack(std::string_view bytes, std::size_t limit) {
  Inflater inflater(bytes);
  std::string out;
  std::size_t end = 0;
  while (end == out.size() && end < limit) {
    out.resize(std::min(limit, std::max(kChunk, 2 * out.size())));
    end = inflater.fill(out, end);
  }
  out.resize(end);
  return out;
}

}  // namespace kinegraph::inline geometry_internal
