#include "kinegraph/geometry/files/jpeg_entropy.h"

#include "kinegraph/common/errors.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr int kMaxMissing = 16;  // bytes read as zeros beyond the end of a scan

std::int16_t shifted(int amplitude, int bits) { return std::int16_t(amplitude * (1 << bits)); }

}  // namespace

std::size_t JpegCode::read(std::string_view data) {
  if (data.size() < 16) throw FileError("it ends too early");
  int code = 0, count = 0;
  for (std::size_t length = 1; length <= 16; ++length) {
    const int of_length = static_cast<unsigned char>(data[length - 1]);
    offset_[length] = count - code;
    end_[length] = code + of_length;
    if (end_[length] > 1 << length) throw FileError("an invalid code");
    count += of_length;
    code = end_[length] << 1;
  }
  if (count > 256 || data.size() < 16 + std::size_t(count)) throw FileError("it ends too early");
  symbols_.assign(data.begin() + 16, data.begin() + 16 + count);
  return 16 + std::size_t(count);
}

int JpegCode::next(JpegEntropyReader& reader) const {
  const int ahead = int(reader.look16());
  for (std::size_t length = 1; length <= 16; ++length) {
    const int code = ahead >> (16 - length);
    if (code >= end_[length]) continue;
    reader.skip(int(length));
    return symbols_[std::size_t(offset_[length] + code)];
  }
  throw FileError("its data contain an undefined code word");
}

std::uint32_t JpegEntropyReader::look16() {
  while (held_ < 16) {
    int next = 0;
    if (at_ < bytes_.size()) next = static_cast<unsigned char>(bytes_[at_]);
    const bool is_marker = next == 0xff && (at_ + 1 >= bytes_.size() || bytes_[at_ + 1] != 0);
    if (at_ >= bytes_.size() || is_marker) {
      next = 0;
      if (++missing_ > kMaxMissing) throw FileError("its data end too early");
    } else {
      at_ += next == 0xff ? 2 : 1;
    }
    bits_ = bits_ << 8 | std::uint64_t(next);
    held_ += 8;
  }
  return std::uint32_t(bits_ >> (held_ - 16) & 0xffff);
}

int JpegEntropyReader::take(int count) {
  if (count == 0) return 0;
  const int value = int(look16() >> (16 - count));
  skip(count);
  return value;
}

int JpegEntropyReader::amplitude(int bits) {
  const int value = take(bits);
  return bits > 0 && value < 1 << (bits - 1) ? value - (1 << bits) + 1 : value;
}

void JpegEntropyReader::restart() {
  bits_ = 0;
  held_ = missing_ = empty_blocks_ = 0;
  for (; at_ + 1 < bytes_.size(); ++at_) {
    const int code = static_cast<unsigned char>(bytes_[at_ + 1]);
    if (bytes_[at_] != '\xff' || code == 0 || code == 0xff) continue;
    if (code >= 0xd0 && code <= 0xd7) at_ += 2;
    return;
  }
}

void JpegEntropyReader::block(const JpegCode& dc, const JpegCode& ac, int& predicted, JpegBlock& block) {
  if (!scan_.progressive) {
    all(dc, ac, predicted, block);
  } else if (scan_.first > 0) {
    scan_.high == 0 ? firstWaves(ac, block) : refineWaves(ac, block);
  } else if (scan_.high == 0) {
    predicted = std::int16_t(predicted + amplitude(dc.next(*this) & 15));
    block[0] = shifted(predicted, scan_.low);
  } else if (take(1)) {
    block[0] = std::int16_t(block[0] | 1 << scan_.low);
  }
}

void JpegEntropyReader::all(const JpegCode& dc, const JpegCode& ac, int& predicted, JpegBlock& block) {
  predicted = std::int16_t(predicted + amplitude(dc.next(*this) & 15));
  block[0] = std::int16_t(predicted);
  for (int k = 1; k < 64; ++k) {
    const int word = ac.next(*this), zeros = word >> 4, bits = word & 15;
    if (bits == 0 && zeros < 15) return;
    k += zeros;
    if (k > 63) throw FileError("its data are damaged");
    if (bits > 0) block[std::size_t(kZigzag[std::size_t(k)])] = std::int16_t(amplitude(bits));
  }
}

void JpegEntropyReader::firstWaves(const JpegCode& ac, JpegBlock& block) {
  if (empty_blocks_ > 0) {
    --empty_blocks_;
    return;
  }
  for (int k = scan_.first; k <= scan_.last; ++k) {
    const int word = ac.next(*this), zeros = word >> 4, bits = word & 15;
    if (bits == 0 && zeros < 15) {
      empty_blocks_ = (1 << zeros) - 1 + take(zeros);
      return;
    }
    k += zeros;
    if (k > 63) throw FileError("its data are damaged");
    if (bits > 0) block[std::size_t(kZigzag[std::size_t(k)])] = shifted(amplitude(bits), scan_.low);
  }
}

/// Reads one more bit of an amplitude known to be nonzero.
void JpegEntropyReader::refine(std::int16_t& amplitude) {
  if (!take(1)) return;
  const int bit = 1 << scan_.low;
  if ((amplitude & bit) == 0) amplitude = std::int16_t(amplitude + (amplitude > 0 ? bit : -bit));
}

void JpegEntropyReader::refineWaves(const JpegCode& ac, JpegBlock& block) {
  int k = scan_.first;
  const auto at = [&](int i) -> std::int16_t& { return block[std::size_t(kZigzag[std::size_t(i)])]; };
  for (; empty_blocks_ == 0 && k <= scan_.last; ++k) {
    const int word = ac.next(*this), bits = word & 15;
    int zeros = word >> 4;
    if (bits == 0 && zeros < 15) {
      empty_blocks_ = (1 << zeros) + take(zeros);
      break;
    }
    const int fresh = bits == 0 ? 0 : take(1) ? 1 << scan_.low : -(1 << scan_.low);
    for (; k <= scan_.last; ++k) {
      if (at(k) != 0) {
        refine(at(k));
      } else if (zeros-- == 0) {
        break;
      }
    }
    if (fresh != 0 && k <= scan_.last) at(k) = std::int16_t(fresh);
  }
  if (empty_blocks_ == 0) return;
  for (; k <= scan_.last; ++k) {
    if (at(k) != 0) refine(at(k));
  }
  --empty_blocks_;
}

}  // namespace kinegraph::inline geometry_internal
