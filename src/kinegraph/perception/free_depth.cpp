#include "kinegraph/perception/free_depth.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "kinegraph/perception/measured_depth.h"

namespace kinegraph::inline perception_internal {

namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();
constexpr double kFinest = .25;                                                    // cells: smaller parts are not asked
constexpr int kHoleRadius = 3;                                                     // pixels at half resolution
constexpr std::array<int, 12> kRadii = {0, 1, 2, 3, 4, 6, 8, 11, 15, 20, 27, 36};  // of the squares of the levels

/// The least value of each pixel and its eight neighbors.
std::vector<float> leastOfNeighbors(const std::vector<float>& image, int width, int height) {
  const auto columns = std::size_t(width);
  std::vector<float> rows(image.size()), out(image.size());
  for (int y = 0; y < height; ++y) {
    const float* from = image.data() + std::size_t(y) * columns;
    float* to = rows.data() + std::size_t(y) * columns;
    to[0] = std::min(from[0], from[std::min(1, width - 1)]);
    for (std::size_t x = 1; x + 1 < columns; ++x) to[x] = std::min(std::min(from[x - 1], from[x]), from[x + 1]);
    to[columns - 1] = std::min(from[std::size_t(std::max(width - 2, 0))], from[columns - 1]);
  }
  for (int y = 0; y < height; ++y) {
    const float* middle = rows.data() + std::size_t(y) * columns;
    const float* above = y > 0 ? middle - columns : middle;
    const float* below = y + 1 < height ? middle + columns : middle;
    float* to = out.data() + std::size_t(y) * columns;
    for (std::size_t x = 0; x < columns; ++x) to[x] = std::min(std::min(above[x], middle[x]), below[x]);
  }
  return out;
}

}  // namespace

DepthView nearestOfFour(const DepthView& view, double jump) {
  DepthView half;
  half.width = (view.width + 1) / 2;
  half.height = (view.height + 1) / 2;
  half.fxycxy = .5 * view.fxycxy;
  half.noise = view.noise;
  half.bias = view.bias;
  half.depth.resize(std::size_t(half.width) * std::size_t(half.height));
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x) {
      const auto at = [&](int row, int column) {
        row = std::min(row, view.height - 1);
        column = std::min(column, view.width - 1);
        const float d = view.depth[std::size_t(row) * std::size_t(view.width) + std::size_t(column)];
        return isMeasured(d) ? d : kNothing;
      };
      const float first = at(2 * y, 2 * x);
      const float least =
          std::min(std::min(first, at(2 * y, 2 * x + 1)), std::min(at(2 * y + 1, 2 * x), at(2 * y + 1, 2 * x + 1)));
      const float d = least + float(jump) < first ? least : first;
      half.depth[std::size_t(y) * std::size_t(half.width) + std::size_t(x)] = d == kNothing ? 0.f : d;
    }
  }
  return half;
}

FreeDepth::FreeDepth(const ObservedView& view, double cell, double nearest)
    : fx_(view.fx),
      fy_(view.fy),
      cx_(view.cx),
      cy_(view.cy),
      cell_(cell),
      width_(view.width),
      height_(view.height),
      half_(.5 * cell * view.X_WC.R.transpose().cwiseAbs().rowwise().sum()) {
  using Kind = ObservedView::Pixel;
  for (std::size_t i = 0; i < 8; ++i)
    corners_[i] =
        view.X_WC.R.transpose() * Vector3d(.5 * cell * Vector3d(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  std::vector<float> free(view.depth.size());
  surface_.resize(view.depth.size());
  for (std::size_t i = 0; i < view.depth.size(); ++i) {
    const float d = view.depth[i];
    const bool measured = view.pixels[i] != Kind::none;
    surface_[i] = measured ? d : kNothing;
    const double error = 3. * view.noise * double(d) * double(d);
    const bool known = view.pixels[i] == Kind::known || view.pixels[i] == Kind::background;
    free[i] = measured ? float(known ? double(d) + error + 2. * half_.z() : double(d) - error) : kNothing;
  }
  std::vector<float> around = free, around_surface = surface_;
  for (int n = 0; n < kHoleRadius; ++n) {
    around = leastOfNeighbors(around, width_, height_);
    around_surface = leastOfNeighbors(around_surface, width_, height_);
  }
  for (std::size_t i = 0; i < free.size(); ++i) {
    if (view.pixels[i] != Kind::none) continue;
    free[i] = std::isfinite(around[i]) ? around[i] : 0.f;
    surface_[i] = around_surface[i];
  }
  free_.push_back(std::move(free));
  const double largest = std::max(fx_, fy_) * kBlock * std::sqrt(3.) * cell / std::max(nearest, kNearest);
  int radius = 0;
  for (std::size_t level = 1; level < kRadii.size() && radius < largest; ++level) {
    std::vector<float> next = free_.back();
    for (; radius < kRadii[level]; ++radius) next = leastOfNeighbors(next, width_, height_);
    free_.push_back(std::move(next));
  }
  for (std::size_t level = 0; level < free_.size(); ++level) {
    while (int(level_.size()) <= kRadii[level]) level_.push_back(std::uint8_t(level));
  }
}

bool FreeDepth::isFreeInParts(const Vector3d& middle, double size) const {
  const Pixel at = pixelOf(middle);
  if (at.index < 0 || double(free_[0][std::size_t(at.index)]) < middle.z()) return false;
  if (isFree(middle, at, size)) return true;
  return size > kFinest && std::all_of(corners_.begin(), corners_.end(), [&](const Vector3d& corner) {
           return isFreeInParts(middle + .5 * size * corner, .5 * size);
         });
}

std::size_t FreeDepth::levelFor(double pixels) const {
  const auto radius = std::size_t(std::ceil(pixels));
  return radius < level_.size() ? level_[radius] : free_.size();
}

}  // namespace kinegraph::inline perception_internal
