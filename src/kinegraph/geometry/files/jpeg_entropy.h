#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

namespace kinegraph::inline geometry_internal {

/// Amplitudes of the cosine waves of a block of 8 x 8 pixels, row by row of frequencies.
using JpegBlock = std::array<std::int16_t, 64>;

/// Index in a block of each amplitude, in file order.
inline constexpr std::array<int, 64> kZigzag = {0,  1,  8,  16, 9,  2,  3,  10, 17, 24, 32, 25, 18, 11, 4,  5,
                                                12, 19, 26, 33, 40, 48, 41, 34, 27, 20, 13, 6,  7,  14, 21, 28,
                                                35, 42, 49, 56, 57, 50, 43, 36, 29, 22, 15, 23, 30, 37, 44, 51,
                                                58, 59, 52, 45, 38, 31, 39, 46, 53, 60, 61, 54, 47, 55, 62, 63};

class JpegEntropyReader;

/// A Huffman code.
class JpegCode {
 public:
  /// Reads the code from the front of `data`; returns the number of bytes read. Throws FileError.
  std::size_t read(std::string_view data);
  int next(JpegEntropyReader& reader) const;

 private:
  std::array<int, 17> end_{},
      offset_{};  ///< by length: one more than its last code; index of its first symbol minus its first code
  std::vector<std::uint8_t> symbols_;
};

/// The amplitudes of a scan: those from `first` to `last`, with all of their bits, the bits from `low`, or the bit
/// `low`.
struct JpegScan {
  bool progressive = false;
  int first = 0, last = 63;
  int high = 0;  ///< 0: the first bits of these amplitudes
  int low = 0;
};

/// Reads the blocks of a scan. Throws FileError.
class JpegEntropyReader {
 public:
  JpegEntropyReader(std::string_view bytes, std::size_t at, const JpegScan& scan)
      : bytes_(bytes), at_(at), scan_(scan) {}

  void block(const JpegCode& dc, const JpegCode& ac, int& predicted, JpegBlock& block);

  /// Continues after the next restart marker.
  void restart();

  std::uint32_t look16();
  void skip(int count) { held_ -= count; }

  /// Start of the search for the next marker.
  std::size_t position() const { return at_; }

 private:
  int take(int count);
  int amplitude(int bits);
  void all(const JpegCode& dc, const JpegCode& ac, int& predicted, JpegBlock& block);
  void firstWaves(const JpegCode& ac, JpegBlock& block);
  void refineWaves(const JpegCode& ac, JpegBlock& block);
  void refine(std::int16_t& amplitude);

  std::string_view bytes_;
  std::size_t at_;
  JpegScan scan_;
  std::uint64_t bits_ = 0;
  int held_ = 0, missing_ = 0;
  int empty_blocks_ = 0;  ///< number of following blocks without changes
};

}  // namespace kinegraph::inline geometry_internal
