#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace kinegraph {

/// A text as a picture: how much of each pixel its letters cover, 0 to 255. Rows run from top to bottom.
struct Letters {
  int width = 0, height = 0;
  std::vector<std::uint8_t> cover;  ///< height x width
};

/// The lines of a text, none of them wider than `width`: those that are go on in the next line, where there is a space
/// if possible. `width_of` is that of an ASCII character. What is not ASCII becomes a question mark.
std::vector<std::string> brokenLines(const std::string& text, int width, const int* width_of);

/// Puts letters on a picture with `width` columns, whose `rgb` are rows from top to bottom: in the top left corner,
/// dark on a light panel, as pages show messages. What is outside is cut off.
void drawLetters(std::vector<std::uint8_t>& rgb, int width, const Letters& letters);

}  // namespace kinegraph
