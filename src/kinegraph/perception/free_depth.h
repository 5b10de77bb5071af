#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph::inline perception_internal {

/// A depth image of half the size. A pixel has the nearest depth of four, if the others are more than `jump` (m)
/// farther, else that of the first one, so that thin things stay and noise does not make others thicker.
DepthView nearestOfFour(const DepthView& view, double jump);

/// Up to which depth a camera looked through space, for cells of one size.
///
/// The image of a cell covers several pixels. The cell is free if its farthest corner is before the nearest depth of
/// all of them. If not, its eight parts are asked, and theirs in turn, since the square of pixels around a small part
/// reaches less far beyond it. Pixels without a measurement have the nearest depth within 7 pixels, if there is one;
/// otherwise cells in their direction stay as they are. Surfaces of known shapes end the view only beyond the cells
/// that touch them.
class FreeDepth {
 public:
  enum class Answer {
    outside,    ///< of the image
    free,       ///< the camera looked through it
    undecided,  ///< in part
    behind,     ///< a surface
  };

  static constexpr int kBlock = 4;  ///< cells along a side of a block

  /// `nearest`: a depth (m) before which no cell is.
  FreeDepth(const ObservedView& view, double cell, double nearest);

  /// For the middle of a cell, in the camera's frame. `undecided` cells may be free in their parts.
  Answer ask(const Vector3d& middle) const {
    const Pixel at = pixelOf(middle);
    if (at.index < 0) return Answer::outside;
    if (isFree(middle, at, 1.)) return Answer::free;
    return middle.z() - half_.z() > double(surface_[std::size_t(at.index)]) ? Answer::behind : Answer::undecided;
  }

  /// Whether all parts of a cube of `size` cells are free.
  bool isFreeInParts(const Vector3d& middle, double size = 1.) const;

  /// Whether all cells of a block around a point are free. False says nothing.
  bool isFreeBlock(const Vector3d& middle) const {
    const Pixel at = pixelOf(middle);
    return at.index >= 0 && isFree(middle, at, kBlock);
  }

  /// Number of points measured in a cell at a depth (m) that make it occupied.
  int neededHits(double depth) const { return fx_ * cell_ > 2. * depth ? 2 : 1; }

 private:
  static constexpr double kNearest = .05;  // m

  /// Where a point is in the image; an index of -1 outside.
  struct Pixel {
    double u = 0., v = 0.;
    int index = -1;
  };

  Pixel pixelOf(const Vector3d& point) const {
    if (point.z() < kNearest) return {};
    const double scale = 1. / point.z(), u = fx_ * point.x() * scale + cx_, v = fy_ * point.y() * scale + cy_;
    return {u, v, u >= 0. && v >= 0. && u < width_ && v < height_ ? int(v) * width_ + int(u) : -1};
  }

  /// Whether a cube of `size` cells is in the image and was looked through, by one comparison.
  bool isFree(const Vector3d& middle, const Pixel& at, double size) const {
    const double far = middle.z() + size * half_.z(), near = middle.z() - size * half_.z();
    if (double(free_[0][std::size_t(at.index)]) < far || near <= 0.) return false;
    const double across = size / near, along = across * half_.z();
    const double x = fx_ * across * half_.x() + std::abs(at.u - cx_) * along,
                 y = fy_ * across * half_.y() + std::abs(at.v - cy_) * along;
    if (at.u < x || at.u + x > width_ || at.v < y || at.v + y > height_) return false;
    const std::size_t level = levelFor(std::max(x, y));
    return level < free_.size() && double(free_[level][std::size_t(at.index)]) >= far;
  }

  std::size_t levelFor(double pixels) const;

  double fx_, fy_, cx_, cy_, cell_;
  int width_, height_;
  Vector3d half_;                         ///< half of the extents of a cell along the axes of the camera, m
  std::array<Vector3d, 8> corners_;       ///< of a cell, in the camera's frame, from its middle
  std::vector<float> surface_;            ///< m; infinite without a measurement
  std::vector<std::vector<float>> free_;  ///< per level: the least free depth in a square of pixels, m
  std::vector<std::uint8_t> level_;       ///< per number of pixels from the middle of the square
};

}  // namespace kinegraph::inline perception_internal
