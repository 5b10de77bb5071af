#pragma once

namespace kinegraph::inline rendering_internal {

/// An image in the memory of the graphics card that is drawn to. Its colors and depths are textures. Its context must
/// be in use for all calls.
class GlFrame {
 public:
  /// Contents of a pixel in addition to a depth: nothing, a color, or two integers.
  enum class Colors { none, rgba, integers };

  explicit GlFrame(Colors colors);
  /// Has the depths of another frame of the same size, which must exist longer.
  GlFrame(Colors colors, const GlFrame& depths_of);
  ~GlFrame();
  GlFrame(const GlFrame&) = delete;
  GlFrame& operator=(const GlFrame&) = delete;

  /// Makes it at least that large, and draws to its first columns and rows from now on. Throws Error if the driver
  /// cannot make it.
  void use(int width, int height);

  unsigned color() const { return color_; }  ///< texture
  unsigned depth() const { return depth_; }  ///< texture

 private:
  Colors colors_;
  bool owns_depth_;
  unsigned frame_ = 0, color_ = 0, depth_ = 0;
  int width_ = 0, height_ = 0;
};

}  // namespace kinegraph::inline rendering_internal
