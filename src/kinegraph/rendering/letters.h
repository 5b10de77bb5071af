#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kinegraph::inline rendering_internal {

/// A rendered text: the coverage of each pixel by letters, 0 to 255. Rows run from top to bottom.
struct Letters {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cover;  ///< height x width
};

/// Breaks a text into lines of at most `width` pixels, at spaces if possible. `width_of` gives the width of each ASCII
/// character. Other characters become question marks.
std::vector<std::string> brokenLines(const std::string& text, int width, const int* width_of);

/// Draws letters in the top left corner of a picture with `width` columns, dark on a light panel like messages on
/// pages. `rgb` has rows from top to bottom. Parts outside are clipped.
void drawLetters(std::vector<std::uint8_t>& rgb, int width, const Letters& letters);

/// Draws letters with their center at a pixel, dark on a light panel like labels on pages. Parts outside are clipped.
void drawLabel(std::vector<std::uint8_t>& rgb, int width, const Letters& letters, int column, int row);

}  // namespace kinegraph::inline rendering_internal
