#pragma once

#include <nanobind/ndarray.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "bindings.h"
#include "kinegraph/common/errors.h"
#include "kinegraph/common/text.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::python {

/// Images: rows and columns, or rows, columns and rgb.
template <class T>
using Image = nb::ndarray<const T, nb::c_contig, nb::device::cpu>;

/// Converts an image to a quad of rgb bytes: clips numbers to 0..255, and shows one number per pixel as gray.
template <class T>
Quad quadOf(const Image<T>& image, const char* who) {
  const bool gray = image.ndim() == 2;
  if (!gray && (image.ndim() != 3 || image.shape(2) != 3)) {
    std::string shape;
    for (std::size_t i = 0; i < image.ndim(); ++i) shape += cat(i ? ", " : "", image.shape(i));
    throw ValueError(
        cat(who, ": the image has shape (", shape, "); expected (height, width, 3), or (height, width) for gray"));
  }
  if (image.size() == 0) throw ValueError(cat(who, ": the image has no pixels"));
  Quad quad;
  quad.rows = int(image.shape(0));
  quad.columns = int(image.shape(1));
  quad.rgb.reserve(3 * image.shape(0) * image.shape(1));
  for (std::size_t i = 0; i < image.size(); ++i) {
    const double value = double(image.data()[i]);
    const auto byte = std::uint8_t(std::isnan(value) ? 0. : std::clamp(value, 0., 255.));
    quad.rgb.insert(quad.rgb.end(), gray ? 3 : 1, byte);
  }
  return quad;
}

}  // namespace kinegraph::python
