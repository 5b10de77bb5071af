#include "scene/point_arguments.h"

#include <cmath>

#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"

namespace kinegraph::python {

std::vector<Vector3d> pointList(const Numbers& numbers, const char* what) {
  if (numbers.values.size() % 3 != 0) throw ValueError(cat(what, " are n x 3 numbers, got ", numbers.values.size()));
  if (!numbers.values.allFinite()) throw ValueError(cat(what, " have numbers that are not finite"));
  std::vector<Vector3d> list(numbers.values.size() / 3);
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = numbers.values.segment<3>(3 * Eigen::Index(i));
  return list;
}

PointColors colorsOf(const std::optional<Numbers>& numbers, std::size_t n) {
  if (!numbers || numbers->values.size() == 0) return {};
  const std::size_t size = std::size_t(numbers->values.size());
  std::size_t columns = numbers->rank == 2 ? numbers->columns() : size;
  if (numbers->rank < 2 && size == 3 * n && n > 1) columns = 3;
  if (numbers->rank > 2 && n > 0 && size % n == 0) columns = size / n;
  if ((columns != 3 && columns != 4) || (size != columns && size != columns * n)) {
    throw ValueError(cat("got ", size, " color numbers for ", n,
                         " points; expected 3 (rgb) or 4 (rgba) per point, or one color, in 0..255"));
  }
  const VectorXd& given = numbers->values;
  if (given.minCoeff() >= 0. && given.maxCoeff() <= 1. && given != VectorXd(given.array().round()))
    throw ValueError("the color numbers are fractions in 0..1; expected 0 to 255, so did you mean 255 times these?");
  PointColors colors(size / columns, {0, 0, 0, 255});
  for (std::size_t i = 0; i < size; ++i) {
    const double x = numbers->values[Eigen::Index(i)];
    if (!(x >= 0. && x <= 255.)) throw ValueError(cat("color number ", x, " is not in 0..255"));
    colors[i / columns][i % columns] = std::uint8_t(std::lround(x));
  }
  return colors;
}

}  // namespace kinegraph::python
