#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cstring>
#include <unordered_map>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/geometry/files/mesh_file.h"

namespace kinegraph::inline geometry_internal {

namespace {

constexpr std::size_t kStlHeader = 84, kStlTriangle = 50;  // bytes

using StlPoint = std::array<float, 3>;

/// Collects triangles and joins vertices at equal positions.
class StlBuilder {
 public:
  void addCorner(StlPoint p) {
    for (float& x : p) x += 0.f;  // -0 equals 0
    std::array<std::uint32_t, 3> bits;
    std::memcpy(bits.data(), p.data(), sizeof(bits));
    const auto [place, is_new] = places_.try_emplace(bits, std::uint32_t(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.emplace_back(p[0], p[1], p[2]);
    corners_[std::size_t(count_++)] = place->second;
    if (count_ < 3) return;
    mesh_.triangles.push_back(corners_);
    count_ = 0;
  }

  void reserve(std::size_t triangles) {
    places_.reserve(triangles / 2 + 1);
    mesh_.triangles.reserve(triangles);
  }

  Mesh take() { return std::move(mesh_); }

 private:
  struct Hash {
    std::size_t operator()(const std::array<std::uint32_t, 3>& bits) const {
      std::uint64_t h = bits[0];
      for (const std::uint32_t next : {bits[1], bits[2]}) h = (h ^ (h >> 29)) * 0x9E3779B97F4A7C15u + next;
      return std::size_t(h ^ (h >> 32));
    }
  };

  Mesh mesh_;
  std::unordered_map<std::array<std::uint32_t, 3>, std::uint32_t, Hash> places_;
  std::array<std::uint32_t, 3> corners_ = {};
  int count_ = 0;
};

bool startsWithWord(std::string_view text, std::string_view lower) {
  if (text.size() < lower.size()) return false;
  return std::equal(lower.begin(), lower.end(), text.begin(),
                    [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); });
}

bool isStlText(std::string_view bytes) {
  const std::string_view head = bytes.substr(0, 1024);
  const std::size_t first = std::min(head.find_first_not_of(" \t\r\n"), head.size());
  const auto is_text = [](char c) { return c != '\0' && (static_cast<unsigned char>(c) >= 32 || std::isspace(c)); };
  return startsWithWord(head.substr(first), "solid") && std::all_of(head.begin(), head.end(), is_text);
}

Mesh readStlText(std::string_view text, const std::string& path) {
  StlBuilder builder;
  const char* at = text.data();
  const char* const end = at + text.size();
  const auto skipBlanks = [&] {
    while (at != end && std::isspace(static_cast<unsigned char>(*at))) ++at;
  };
  int corners = 0, facets = 0;
  for (;;) {
    skipBlanks();
    if (at == end) break;
    const char* const word = at;
    while (at != end && !std::isspace(static_cast<unsigned char>(*at))) ++at;
    const std::string_view token(word, std::size_t(at - word));
    if (token.size() == 6 && startsWithWord(token, "vertex")) {
      StlPoint p;
      for (float& x : p) {
        skipBlanks();
        if (at != end && *at == '+') ++at;
        const auto [behind, error] = std::from_chars(at, end, x);
        if (error == std::errc::result_out_of_range) {
          x = 0.f;  // a denormal number; a huge one has no use
        } else if (error != std::errc()) {
          throw FileError(cat("mesh file '", path, "': vertex ", corners, " is not 3 numbers"));
        }
        at = behind;
      }
      builder.addCorner(p);
      ++corners;
    } else if (token.size() == 5 && startsWithWord(token, "facet")) {
      ++facets;
    } else if (token.size() == 5 && startsWithWord(token, "solid")) {
      while (at != end && *at != '\n') ++at;  // the name
    }
  }
  if (corners % 3 != 0 || corners < 3 * facets)
    throw FileError(cat("mesh file '", path, "' is truncated: its last triangle is incomplete"));
  return builder.take();
}

}  // namespace

Mesh readStlMesh(std::string_view bytes, const std::string& path) {
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHeader) std::memcpy(&count, bytes.data() + 80, sizeof(count));
  const double needed = double(kStlHeader) + double(kStlTriangle) * count;
  if (double(bytes.size()) != needed && isStlText(bytes)) return readStlText(bytes, path);
  if (bytes.size() < kStlHeader) throw FileError(cat("mesh file '", path, "' of ", bytes.size(), " bytes is no STL"));
  if (double(bytes.size()) < needed) {
    throw FileError(cat("mesh file '", path, "' is truncated: it announces ", count, " triangles and contains ",
                        (bytes.size() - kStlHeader) / kStlTriangle));
  }
  StlBuilder builder;
  builder.reserve(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    std::array<StlPoint, 3> corners;
    std::memcpy(corners.data(), bytes.data() + kStlHeader + kStlTriangle * i + 12, sizeof(corners));  // behind a normal
    for (const StlPoint& corner : corners) builder.addCorner(corner);
  }
  return builder.take();
}

}  // namespace kinegraph::inline geometry_internal
