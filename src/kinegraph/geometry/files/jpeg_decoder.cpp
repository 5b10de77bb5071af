#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <optional>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/image_decoders.h"
#include "kinegraph/geometry/files/jpeg_entropy.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr double kMaxPixelsPerByte = 1024.;
constexpr int kMaxScans = 100;

struct Component {
  int id = 0, across = 1, down = 1, quantization = 0;  // `across` and `down`: blocks of it in a unit
  int columns = 0, rows = 0;                           // blocks that the picture needs
  int stride = 0;                                      // blocks in a row, up to full units
  std::vector<JpegBlock> blocks;
  std::vector<std::uint8_t> samples;  // 8 stride per row
};

class JpegDecoder {
 public:
  explicit JpegDecoder(std::string_view bytes) : bytes_(bytes) {}

  Pixels decode() {
    std::size_t at = 2;
    for (int scans = 0;;) {
      const int marker = nextMarker(at);
      if (marker == 0xd9) break;
      if (marker == 0x01 || (marker >= 0xd0 && marker <= 0xd7)) continue;
      const std::size_t size = word(at);
      if (size < 2 || at + size > bytes_.size()) throw FileError("it ends too early");
      const std::string_view data = bytes_.substr(at + 2, size - 2);
      at += size;
      if (marker == 0xc4)
        readCodes(data);
      else if (marker == 0xdb)
        readQuantization(data);
      else if (marker == 0xdd)
        restart_ = data.size() < 2 ? 0 : byte(data, 0) << 8 | byte(data, 1);
      else if (marker == 0xee && data.starts_with("Adobe") && data.size() >= 12)
        adobe_ = byte(data, 11);
      else if (marker == 0xc0 || marker == 0xc1 || marker == 0xc2)
        readFrame(data, marker == 0xc2);
      else if (marker >= 0xc3 && marker <= 0xcf && marker != 0xc8 && marker != 0xcc)
        throw FileError("it is of a rare kind (lossless or arithmetic)");
      if (marker != 0xda) continue;
      if (++scans > kMaxScans) throw FileError(cat("it has more than ", kMaxScans, " scans"));
      readScan(data, at);
    }
    if (components_.empty()) throw FileError("it has no header");
    return colors();
  }

 private:
  static int byte(std::string_view data, std::size_t at) {
    if (at >= data.size()) throw FileError("it ends too early");
    return static_cast<unsigned char>(data[at]);
  }
  std::size_t word(std::size_t at) const { return std::size_t(byte(bytes_, at) << 8 | byte(bytes_, at + 1)); }

  /// Position of the next marker; the end if no data follow and at least one scan was read: many files lack the last
  /// one.
  int nextMarker(std::size_t& at) const {
    for (; at + 1 < bytes_.size(); ++at) {
      const int code = byte(bytes_, at + 1);
      if (byte(bytes_, at) != 0xff || code == 0 || code == 0xff) continue;
      at += 2;
      return code;
    }
    return 0xd9;
  }

  void readCodes(std::string_view data) {
    while (!data.empty()) {
      const int what = byte(data, 0);
      if ((what & 15) > 3 || what >> 4 > 1) throw FileError("a code table with an invalid number");
      const std::size_t used = codes_[std::size_t((what >> 4) * 4 + (what & 15))].read(data.substr(1));
      data.remove_prefix(1 + used);
    }
  }

  void readQuantization(std::string_view data) {
    while (!data.empty()) {
      const int what = byte(data, 0);
      const std::size_t size = what >> 4 ? 2 : 1;
      if ((what & 15) > 3) throw FileError("a quantization table with an invalid number");
      for (std::size_t i = 0; i < 64; ++i) {
        const std::size_t at = 1 + size * i;
        quantization_[std::size_t(what & 15)][std::size_t(kZigzag[i])] =
            size == 2 ? byte(data, at) << 8 | byte(data, at + 1) : byte(data, at);
      }
      data.remove_prefix(1 + 64 * size);
    }
  }

  void readFrame(std::string_view data, bool progressive) {
    if (!components_.empty()) throw FileError("it has two headers");
    progressive_ = progressive;
    height_ = byte(data, 1) << 8 | byte(data, 2);
    width_ = byte(data, 3) << 8 | byte(data, 4);
    const int count = byte(data, 5);
    if (byte(data, 0) != 8 || width_ == 0 || height_ == 0 || (count != 1 && count != 3)) {
      throw FileError(cat("it has ", width_, " x ", height_, " pixels of ", count, " colors with ", byte(data, 0),
                          " bits; expected 1 or 3 of 8 bits"));
    }
    if (double(width_) * height_ > 1e5 + kMaxPixelsPerByte * double(bytes_.size())) {
      throw FileError(cat("its header announces ", width_, " x ", height_, " pixels, more than its bytes can hold"));
    }
    std::vector<Component> components(static_cast<std::size_t>(count));
    for (std::size_t i = 0; i < components.size(); ++i) {
      Component& c = components[i];
      c.id = byte(data, 6 + 3 * i);
      c.across = byte(data, 7 + 3 * i) >> 4;
      c.down = byte(data, 7 + 3 * i) & 15;
      c.quantization = byte(data, 8 + 3 * i);
      if (c.across < 1 || c.across > 4 || c.down < 1 || c.down > 4 || c.quantization > 3)
        throw FileError("its header is damaged");
      if (count == 1) c.across = c.down = 1;
      across_ = std::max(across_, c.across);
      down_ = std::max(down_, c.down);
    }
    const auto parts = [](int whole, int part) { return (whole + part - 1) / part; };
    units_across_ = parts(width_, 8 * across_);
    units_down_ = parts(height_, 8 * down_);
    for (Component& c : components) {
      c.columns = parts(parts(width_ * c.across, across_), 8);
      c.rows = parts(parts(height_ * c.down, down_), 8);
      c.stride = units_across_ * c.across;
      c.blocks.resize(std::size_t(c.stride) * std::size_t(units_down_ * c.down));
    }
    components_ = std::move(components);
  }

  void readScan(std::string_view data, std::size_t& at) {
    const std::size_t count = std::size_t(byte(data, 0));
    JpegScan scan;
    scan.progressive = progressive_;
    scan.first = byte(data, 1 + 2 * count);
    scan.last = byte(data, 2 + 2 * count);
    scan.high = byte(data, 3 + 2 * count) >> 4;
    scan.low = byte(data, 3 + 2 * count) & 15;
    if (!progressive_) scan.first = 0, scan.last = 63, scan.high = scan.low = 0;
    if (scan.first > scan.last || scan.last > 63 || scan.low > 13 || (scan.first > 0 && count != 1) ||
        (progressive_ && scan.first == 0 && scan.last > 0)) {
      throw FileError("a scan with invalid bounds");
    }
    JpegEntropyReader reader(bytes_, at, scan);
    struct Part {
      Component* component;
      const JpegCode *dc, *ac;
      int predicted = 0;
    };
    std::vector<Part> parts;
    for (std::size_t i = 0; i < count; ++i) {
      const int id = byte(data, 1 + 2 * i), tables = byte(data, 2 + 2 * i);
      const auto component =
          std::find_if(components_.begin(), components_.end(), [&](const Component& c) { return c.id == id; });
      if (component == components_.end() || (tables & 15) > 3 || tables >> 4 > 3)
        throw FileError("a scan of a color that is not in the header");
      parts.push_back({&*component, &codes_[std::size_t(tables >> 4)], &codes_[std::size_t(4 + (tables & 15))]});
    }
    if (parts.empty() || parts.size() > components_.size()) throw FileError("a scan with an invalid number of colors");
    const bool alone = parts.size() == 1;
    const int columns = alone ? parts[0].component->columns : units_across_,
              rows = alone ? parts[0].component->rows : units_down_;
    for (int unit = 0; unit < columns * rows; ++unit) {
      if (restart_ > 0 && unit > 0 && unit % restart_ == 0) {
        reader.restart();
        for (Part& part : parts) part.predicted = 0;
      }
      const int column = unit % columns, row = unit / columns;
      for (Part& part : parts) {
        Component& c = *part.component;
        const int across = alone ? 1 : c.across, down = alone ? 1 : c.down;
        for (int i = 0; i < across * down; ++i) {
          const int x = column * across + i % across, y = row * down + i / across;
          reader.block(*part.dc, *part.ac, part.predicted,
                       c.blocks[std::size_t(y) * std::size_t(c.stride) + std::size_t(x)]);
        }
      }
    }
    at = reader.position();
  }

  /// Inverse cosine transform: the samples of a component from its amplitudes.
  void transform(Component& c) const {
    static const auto kWave = [] {
      std::array<std::array<float, 8>, 8> wave{};  // [place][frequency]
      for (int x = 0; x < 8; ++x) {
        for (int u = 0; u < 8; ++u) {
          wave[std::size_t(x)][std::size_t(u)] =
              float((u == 0 ? std::sqrt(.125) : .5) * std::cos((2 * x + 1) * u * std::numbers::pi / 16.));
        }
      }
      return wave;
    }();
    const auto& table = quantization_[std::size_t(c.quantization)];
    const std::size_t width = 8 * std::size_t(c.stride);
    c.samples.resize(64 * c.blocks.size());
    for (std::size_t b = 0; b < c.blocks.size(); ++b) {
      std::array<float, 64> half{}, scaled;
      for (std::size_t i = 0; i < 64; ++i) scaled[i] = float(c.blocks[b][i]) * float(table[i]);
      for (std::size_t v = 0; v < 8; ++v) {
        for (std::size_t x = 0; x < 8; ++x) {
          for (std::size_t u = 0; u < 8; ++u) half[8 * v + x] += kWave[x][u] * scaled[8 * v + u];
        }
      }
      const std::size_t stride = std::size_t(c.stride), corner = b / stride * 8 * width + b % stride * 8;
      for (std::size_t y = 0; y < 8; ++y) {
        for (std::size_t x = 0; x < 8; ++x) {
          float sum = 128.5f;
          for (std::size_t v = 0; v < 8; ++v) sum += kWave[y][v] * half[8 * v + x];
          c.samples[corner + y * width + x] = std::uint8_t(std::clamp(sum, 0.f, 255.f));
        }
      }
    }
    c.blocks = {};
  }

  Pixels colors() {
    for (Component& c : components_) transform(c);
    Pixels pixels{width_, height_, {}};
    pixels.rgb.resize(3 * std::size_t(width_) * std::size_t(height_));
    const auto byteOf = [](double x) { return std::uint8_t(std::clamp(x + .5, 0., 255.)); };
    std::uint8_t* out = pixels.rgb.data();
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x, out += 3) {
        std::array<double, 3> s{};
        for (std::size_t k = 0; k < components_.size(); ++k) {
          const Component& c = components_[k];
          s[k] = c.samples[std::size_t(y * c.down / down_) * 8 * std::size_t(c.stride) +
                           std::size_t(x * c.across / across_)];
        }
        if (components_.size() == 1) {
          std::fill_n(out, 3, std::uint8_t(s[0]));
        } else if (adobe_ == 0) {
          for (int k = 0; k < 3; ++k) out[k] = std::uint8_t(s[std::size_t(k)]);
        } else {
          const double blue = s[1] - 128., red = s[2] - 128.;
          out[0] = byteOf(s[0] + 1.402 * red);
          out[1] = byteOf(s[0] - .344136 * blue - .714136 * red);
          out[2] = byteOf(s[0] + 1.772 * blue);
        }
      }
    }
    return pixels;
  }

  std::string_view bytes_;
  std::vector<Component> components_;
  std::array<JpegCode, 8> codes_;  // four DC codes, four AC codes
  std::array<std::array<int, 64>, 4> quantization_{};
  int width_ = 0, height_ = 0, across_ = 1, down_ = 1, units_across_ = 0, units_down_ = 0, restart_ = 0;
  bool progressive_ = false;
  std::optional<int> adobe_;
};

}  // namespace

Pixels decodeJpeg(std::string_view bytes) { return JpegDecoder(bytes).decode(); }

}  // namespace kinegraph::inline geometry_internal
