#pragma once

#include <vector>

#include "kinegraph/perception/occupancy_map.h"

namespace kinegraph {

/// A depth image of half the size. A pixel has the nearest depth of four, if the others are more than `jump` (m)
/// farther, else that of the first one, so that thin things stay and noise does not make others thicker.
DepthView nearestOfFour(const DepthView& view, double jump);

/// Up to which depth a camera looked through space, for cells of one size.
///
/// The image of a cell covers several pixels. The cell is free if its farthest corner is before the nearest depth of
/// all of them. Pixels without a measurement have the nearest depth within 7 pixels, if there is one; otherwise cells
/// in their direction stay as they are. Surfaces of known shapes end the view only beyond the cells that touch them.
class FreeDepth {
 public:
  enum class Answer {
    outside,    ///< of the image
    free,       ///< the camera looked through it
    undecided,  ///< in part
    behind,     ///< a surface
  };

  FreeDepth(const ObservedView& view, double cell);

  /// For the middle of a cell, in the camera's frame.
  Answer ask(const Vector3d& middle) const {
    if (middle.z() < kNearest) return Answer::outside;
    const double scale = 1. / middle.z(), u = fx_ * middle.x() * scale + cx_, v = fy_ * middle.y() * scale + cy_;
    if (!(u >= 0. && v >= 0. && u < width_ && v < height_)) return Answer::outside;
    const std::size_t pixel = std::size_t(v) * std::size_t(width_) + std::size_t(u);
    const double far = middle.z() + radius_;
    if (double(free_[0][pixel]) >= far) {
      const std::size_t level = levelFor(reach_ * scale);
      if (level < free_.size() && double(free_[level][pixel]) >= far) return Answer::free;
    }
    return middle.z() - radius_ > double(surface_[pixel]) ? Answer::behind : Answer::undecided;
  }

  /// Number of points measured in a cell at a depth (m) that make it occupied.
  int neededHits(double depth) const { return fx_ * cell_ > 2. * depth ? 2 : 1; }

 private:
  static constexpr double kNearest = .05;  // m

  std::size_t levelFor(double pixels) const;

  double fx_, fy_, cx_, cy_, cell_, radius_, reach_;
  int width_, height_;
  std::vector<float> surface_;            ///< m; infinite without a measurement
  std::vector<std::vector<float>> free_;  ///< per level: the least free depth in a square of pixels, m
  std::vector<std::uint8_t> level_;       ///< per number of pixels from the middle of the square
};

}  // namespace kinegraph
