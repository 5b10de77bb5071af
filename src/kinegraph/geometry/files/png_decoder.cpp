#include <algorithm>
#include <array>
#include <cstdlib>
#include <optional>
#include <utility>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_decoders.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::uint32_t kMaxPixelsAcross = 1u << 15;
constexpr double kBestPacking = 1032.;  // maximum expansion factor of deflate

std::uint32_t bigEndian(std::string_view bytes, std::size_t at) {
  if (at + 4 > bytes.size()) throw FileError("it ends too early");
  std::uint32_t word = 0;
  for (std::size_t i = 0; i < 4; ++i) word = word << 8 | static_cast<unsigned char>(bytes[at + i]);
  return word;
}

struct Header {
  std::uint32_t width = 0, height = 0;
  int depth = 0, color = 0;
  bool interlaced = false;

  int channels() const { return color == 2 ? 3 : color == 4 ? 2 : color == 6 ? 4 : 1; }
  std::size_t bitsPerPixel() const { return std::size_t(channels() * depth); }
};

Header readHeader(std::string_view data) {
  Header header;
  header.width = bigEndian(data, 0);
  header.height = bigEndian(data, 4);
  if (data.size() < 13) throw FileError("its header is too short");
  header.depth = data[8];
  header.color = data[9];
  header.interlaced = data[12] != 0;
  if (header.width == 0 || header.height == 0 || header.width > kMaxPixelsAcross || header.height > kMaxPixelsAcross) {
    throw FileError(cat("it has ", header.width, " x ", header.height, " pixels; expected 1 to ", kMaxPixelsAcross,
                        " across and down"));
  }
  const bool small = header.depth == 1 || header.depth == 2 || header.depth == 4;
  const bool good = header.color == 0   ? small || header.depth == 8 || header.depth == 16
                    : header.color == 3 ? small || header.depth == 8
                                        : header.depth == 8 || header.depth == 16;
  if (!good || header.color == 1 || header.color == 5 || header.color > 6 || header.color < 0) {
    throw FileError(cat("colors of type ", header.color, " with ", header.depth, " bits are not valid"));
  }
  return header;
}

/// The pixels x0, x0 + dx, ... of the rows y0, y0 + dy, ...
struct Pass {
  std::uint32_t x0, y0, dx, dy;
  std::uint32_t columns(const Header& h) const { return h.width > x0 ? (h.width - x0 + dx - 1) / dx : 0; }
  std::uint32_t rows(const Header& h) const { return h.height > y0 ? (h.height - y0 + dy - 1) / dy : 0; }
  std::size_t rowBytes(const Header& h) const { return (columns(h) * h.bitsPerPixel() + 7) / 8; }
};

std::vector<Pass> passesOf(const Header& header) {
  if (!header.interlaced) return {{0, 0, 1, 1}};
  return {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4}, {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}};
}

/// Undoes the filter of a row, given the row above.
void unfilter(int filter, std::size_t step, const std::vector<std::uint8_t>& above, std::vector<std::uint8_t>& row) {
  for (std::size_t i = 0; i < row.size(); ++i) {
    const int left = i >= step ? row[i - step] : 0, up = above[i], corner = i >= step ? above[i - step] : 0;
    int guess = 0;
    if (filter == 1) guess = left;
    if (filter == 2) guess = up;
    if (filter == 3) guess = (left + up) / 2;
    if (filter == 4) {
      const int a = std::abs(up - corner), b = std::abs(left - corner), c = std::abs(left + up - 2 * corner);
      guess = a <= b && a <= c ? left : b <= c ? up : corner;
    }
    row[i] = std::uint8_t(row[i] + guess);
  }
}

class PngDecoder {
 public:
  PngDecoder(const Header& header, std::string_view palette) : header_(header), palette_(palette) {
    pixels_.width = int(header.width);
    pixels_.height = int(header.height);
    pixels_.rgb.resize(3 * std::size_t(header.width) * header.height);
  }

  Pixels decode(std::string_view packed) {
    std::size_t total = 0;
    for (const Pass& pass : passesOf(header_))
      total += pass.columns(header_) ? pass.rows(header_) * (1 + pass.rowBytes(header_)) : 0;
    const std::string data = unpack(packed, total);
    if (data.size() < total) throw FileError("it contains fewer pixels than its header announces");
    std::size_t at = 0;
    for (const Pass& pass : passesOf(header_)) {
      if (pass.columns(header_) == 0) continue;
      std::vector<std::uint8_t> above(pass.rowBytes(header_)), row(above.size());
      for (std::uint32_t i = 0; i < pass.rows(header_); ++i) {
        const int filter = data[at++];
        if (filter < 0 || filter > 4) throw FileError(cat("a row with unknown filter ", filter, ""));
        std::copy_n(data.begin() + std::ptrdiff_t(at), row.size(), row.begin());
        at += row.size();
        unfilter(filter, std::max<std::size_t>(1, header_.bitsPerPixel() / 8), above, row);
        place(pass, i, row);
        std::swap(above, row);
      }
    }
    return std::move(pixels_);
  }

 private:
  /// One stored number of a row.
  int sample(const std::vector<std::uint8_t>& row, std::size_t i) const {
    if (header_.depth == 16) return row[2 * i];
    if (header_.depth == 8) return row[i];
    const std::size_t bit = i * std::size_t(header_.depth);
    return row[bit / 8] >> (8 - header_.depth - int(bit % 8)) & ((1 << header_.depth) - 1);
  }

  void place(const Pass& pass, std::uint32_t i, const std::vector<std::uint8_t>& row) {
    const int channels = header_.channels();
    const int highest = header_.depth >= 8 ? 255 : (1 << header_.depth) - 1;
    for (std::uint32_t column = 0; column < pass.columns(header_); ++column) {
      const std::size_t first = std::size_t(column) * std::size_t(channels);
      std::uint8_t* out =
          &pixels_.rgb[3 * ((pass.y0 + std::size_t(i) * pass.dy) * header_.width + pass.x0 + column * pass.dx)];
      if (header_.color == 3) {
        const std::size_t entry = 3 * std::size_t(sample(row, first));
        if (entry + 3 > palette_.size()) throw FileError("a pixel has a color that is not in the palette");
        for (std::size_t k = 0; k < 3; ++k) out[k] = std::uint8_t(palette_[entry + k]);
      } else {
        for (int k = 0; k < 3; ++k)
          out[k] = std::uint8_t(sample(row, first + std::size_t(channels >= 3 ? k : 0)) * 255 / highest);
      }
    }
  }

  const Header& header_;
  std::string_view palette_;
  Pixels pixels_;
};

}  // namespace

Pixels decodePng(std::string_view bytes) {
  std::optional<Header> header;
  std::string_view palette;
  std::string packed;
  for (std::size_t at = 8; at < bytes.size();) {
    const std::size_t size = bigEndian(bytes, at);
    if (size > bytes.size() || at + 12 + size > bytes.size()) throw FileError("it ends too early");
    const std::string_view kind = bytes.substr(at + 4, 4), data = bytes.substr(at + 8, size);
    if (kind == "IHDR") header = readHeader(data);
    if (kind == "PLTE") palette = data;
    if (kind == "IDAT") packed += data;
    if (kind == "IEND") break;
    at += 12 + size;
  }
  if (!header) throw FileError("it has no header");
  const double promised = double(header->width) * header->height * double(header->bitsPerPixel()) / 8.;
  if (promised > 1e5 + kBestPacking * double(packed.size())) {
    throw FileError(
        cat("its header announces ", header->width, " x ", header->height, " pixels, more than its bytes can hold"));
  }
  return PngDecoder(*header, palette).decode(packed);
}

}  // namespace kinegraph::inline geometry_internal
