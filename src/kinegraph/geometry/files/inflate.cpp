#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "kinegraph/base/errors.h"
#include "kinegraph/geometry/files/image_decoders.h"

namespace kinegraph {

namespace {

constexpr int kLongestCode = 15;

class Bits {  // the lowest bit of a byte comes first
 public:
  explicit Bits(std::string_view bytes) : bytes_(bytes) {}

  std::uint32_t take(int count) {
    const std::uint32_t bits = look(count);
    skip(count);
    return bits;
  }
  /// The next bits; zeros behind the end.
  std::uint32_t look(int count) {
    while (held_ < count) {
      held_bits_ |= std::uint64_t(at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_]) : 0) << held_;
      ++at_;
      held_ += 8;
    }
    return std::uint32_t(held_bits_ & ((1u << count) - 1));
  }
  void skip(int count) {
    held_bits_ >>= count;
    held_ -= count;
    if (at_ > bytes_.size() + 8) throw FileError("its packed data end too early");
  }
  void skipToByte() { skip(held_ % 8); }

 private:
  std::string_view bytes_;
  std::size_t at_ = 0;
  std::uint64_t held_bits_ = 0;
  int held_ = 0;
};

/// A prefix code, as a table of what the next 15 bits begin with.
class Code {
 public:
  explicit Code(const std::vector<std::uint8_t>& lengths) : table_(1u << kLongestCode) {
    std::array<int, kLongestCode + 2> first{};
    for (const int length : lengths) ++first[std::size_t(length) + 1];
    first[1] = 0;  // length 0: not in use
    int code = 0;
    for (int length = 1; length <= kLongestCode; ++length) {
      const int count = first[std::size_t(length) + 1];
      first[std::size_t(length)] = code;
      code = (code + count) << 1;
      if (code > 2 << length) throw FileError("its packed data have an impossible code");
    }
    for (std::size_t symbol = 0; symbol < lengths.size(); ++symbol) {
      const int length = lengths[symbol];
      if (length == 0) continue;
      const int forward = first[std::size_t(length)]++;
      int reversed = 0;
      for (int bit = 0; bit < length; ++bit) reversed |= (forward >> bit & 1) << (length - 1 - bit);
      for (int rest = reversed; rest < 1 << kLongestCode; rest += 1 << length)
        table_[std::size_t(rest)] = {std::uint16_t(symbol), std::uint8_t(length)};
    }
  }

  int next(Bits& bits) const {
    const Entry& entry = table_[bits.look(kLongestCode)];
    if (entry.length == 0) throw FileError("its packed data hold a word that no code has");
    bits.skip(entry.length);
    return entry.symbol;
  }

 private:
  struct Entry {
    std::uint16_t symbol = 0;
    std::uint8_t length = 0;
  };
  std::vector<Entry> table_;
};

struct Codes {
  Code literals, distances;
};

Codes fixedCodes() {
  std::vector<std::uint8_t> lengths(288, 8);
  std::fill(lengths.begin() + 144, lengths.begin() + 256, std::uint8_t(9));
  std::fill(lengths.begin() + 256, lengths.begin() + 280, std::uint8_t(7));
  return {Code(lengths), Code(std::vector<std::uint8_t>(30, 5))};
}

Codes readCodes(Bits& bits) {
  constexpr int kOrder[] = {16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};
  const std::size_t literals = bits.take(5) + 257, distances = bits.take(5) + 1, count = bits.take(4) + 4;
  std::vector<std::uint8_t> of_lengths(19);
  for (std::size_t i = 0; i < count; ++i) of_lengths[std::size_t(kOrder[i])] = std::uint8_t(bits.take(3));
  const Code code(of_lengths);
  std::vector<std::uint8_t> lengths;
  while (lengths.size() < literals + distances) {
    const int symbol = code.next(bits);
    if (symbol < 16) {
      lengths.push_back(std::uint8_t(symbol));
    } else if (symbol == 16) {
      if (lengths.empty()) throw FileError("its packed data repeat nothing");
      lengths.insert(lengths.end(), 3 + bits.take(2), std::uint8_t(lengths.back()));
    } else {
      lengths.insert(lengths.end(), symbol == 17 ? 3 + bits.take(3) : 11 + bits.take(7), std::uint8_t(0));
    }
  }
  lengths.resize(literals + distances);
  const auto middle = lengths.begin() + std::ptrdiff_t(literals);
  return {Code({lengths.begin(), middle}), Code({middle, lengths.end()})};
}

void unpackBlock(Bits& bits, const Codes& codes, std::size_t limit, std::string& out) {
  constexpr int kLength[] = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                             31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
  constexpr int kLengthBits[] = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2, 2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
  constexpr int kDistance[] = {1,   2,   3,   4,   5,   7,    9,    13,   17,   25,   33,   49,   65,    97,    129,
                               193, 257, 385, 513, 769, 1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
  while (out.size() < limit) {
    const int symbol = codes.literals.next(bits);
    if (symbol == 256) return;
    if (symbol < 256) {
      out += char(symbol);
      continue;
    }
    if (symbol > 285) throw FileError("its packed data hold an impossible length");
    const std::size_t length = std::size_t(kLength[symbol - 257]) + bits.take(kLengthBits[symbol - 257]);
    const int place = codes.distances.next(bits);
    if (place > 29) throw FileError("its packed data hold an impossible distance");
    const std::size_t distance = std::size_t(kDistance[place]) + bits.take(place < 2 ? 0 : place / 2 - 1);
    if (distance > out.size()) throw FileError("its packed data point before their beginning");
    for (std::size_t i = 0; i < length; ++i) out += out[out.size() - distance];
  }
}

}  // namespace

std::string unpack(std::string_view bytes, std::size_t limit) {
  if (bytes.size() < 2 || (bytes[0] & 15) != 8 || (bytes[1] & 32))
    throw FileError("its packed data are not a zlib stream");
  Bits bits(bytes.substr(2));
  std::string out;
  out.reserve(limit);
  for (bool last = false; !last && out.size() < limit;) {
    last = bits.take(1);
    switch (bits.take(2)) {
      case 0: {
        bits.skipToByte();
        const std::uint32_t size = bits.take(16);
        if ((bits.take(16) ^ size) != 0xffff) throw FileError("its packed data hold a damaged block");
        for (std::uint32_t i = 0; i < size && out.size() < limit; ++i) out += char(bits.take(8));
        break;
      }
      case 1:
        unpackBlock(bits, fixedCodes(), limit, out);
        break;
      case 2:
        unpackBlock(bits, readCodes(bits), limit, out);
        break;
      default:
        throw FileError("its packed data hold a block of no known kind");
    }
  }
  if (out.size() > limit) out.resize(limit);
  return out;
}

}  // namespace kinegraph
