#include "kinegraph/rendering/letters.h"

#include <algorithm>

#include "kinegraph/common/utf8.h"

namespace kinegraph::inline rendering_internal {

namespace {

constexpr int kMargin = 12, kBesides = 12,
              kAbove = 7;  // pixels: margin around the panel, and between panel and letters
constexpr int kBesidesLabel = 4;
constexpr int kPanel = 255, kInk = 36;  // gray values
constexpr double kSolid = .93;          // opacity of the panel

/// Converts to one byte per character.
std::string ascii(const std::string& text) {
  std::string out;
  for (const char c : validUtf8(text)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte >= 0xc0)
      out += '?';  // start of a multi-byte character; its other bytes are skipped
    else if (byte == '\t')
      out += ' ';
    else if (byte == '\n' || (byte >= 32 && byte < 127))
      out += c;
  }
  return out;
}

/// A panel around letters.
struct Panel {
  int left, top;       ///< pixels of the picture
  int besides, above;  ///< pixels between its border and the letters
};

void drawPanel(std::vector<std::uint8_t>& rgb, int width, const Letters& letters, const Panel& panel) {
  const int height = int(rgb.size() / 3) / width;
  const int right = std::min(width, panel.left + letters.width + 2 * panel.besides);
  const int bottom = std::min(height, panel.top + letters.height + 2 * panel.above);
  for (int row = std::max(panel.top, 0); row < bottom; ++row) {
    for (int column = std::max(panel.left, 0); column < right; ++column) {
      const int y = row - panel.top - panel.above, x = column - panel.left - panel.besides;
      const bool inside = x >= 0 && x < letters.width && y >= 0 && y < letters.height;
      const double ink =
          inside ? letters.cover[std::size_t(y) * std::size_t(letters.width) + std::size_t(x)] / 255. : 0.;
      const double shown = ink * kInk + (1. - ink) * kPanel, solid = std::max(kSolid, ink);
      std::uint8_t* pixel = &rgb[3 * (std::size_t(row) * std::size_t(width) + std::size_t(column))];
      for (int k = 0; k < 3; ++k) pixel[k] = std::uint8_t(solid * shown + (1. - solid) * pixel[k] + .5);
    }
  }
}

}  // namespace

std::vector<std::string> brokenLines(const std::string& text, int width, const int* width_of) {
  std::vector<std::string> lines(1);
  int used = 0;
  const auto widthOf = [&](char c) { return width_of[static_cast<unsigned char>(c)]; };
  for (const char c : ascii(text)) {
    if (c == '\n') {
      lines.emplace_back();
      used = 0;
      continue;
    }
    if (used + widthOf(c) > width && !lines.back().empty()) {
      std::string& line = lines.back();
      const std::size_t space = c == ' ' ? line.size() : line.rfind(' ');
      const bool has_space = space != std::string::npos && space > 0;
      std::string rest = has_space && space < line.size() ? line.substr(space + 1) : "";
      if (has_space) line.resize(space);
      used = 0;
      for (const char moved : rest) used += widthOf(moved);
      lines.push_back(std::move(rest));
      if (c == ' ') continue;
    }
    lines.back() += c;
    used += widthOf(c);
  }
  return lines;
}

void drawLetters(std::vector<std::uint8_t>& rgb, int width, const Letters& letters) {
  drawPanel(rgb, width, letters, {.left = kMargin, .top = kMargin, .besides = kBesides, .above = kAbove});
}

void drawLabel(std::vector<std::uint8_t>& rgb, int width, const Letters& letters, int column, int row) {
  const int left = column - letters.width / 2 - kBesidesLabel, top = row - letters.height / 2;
  drawPanel(rgb, width, letters, {.left = left, .top = top, .besides = kBesidesLabel, .above = 0});
}

}  // namespace kinegraph::inline rendering_internal
