#pragma once

#include <nanobind/ndarray.h>

#include <initializer_list>
#include <memory>
#include <vector>

#include "bindings.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph::python {

/// An array of whatever numbers an image is made of.
using AnyArray = nb::typed<nb::object, nb::any>;

/// A numpy array that owns these values.
template <class T>
AnyArray toImage(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* data = kept->data();
  const nb::capsule owner(kept.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return nb::cast(nb::ndarray<nb::numpy, T>(data, shape, owner));
}

inline AnyArray rgbOf(CameraImage& image) {
  return toImage(std::move(image.rgb), {std::size_t(image.height), std::size_t(image.width), 3});
}

inline AnyArray depthOf(CameraImage& image) {
  return toImage(std::move(image.depth), {std::size_t(image.height), std::size_t(image.width)});
}

inline Array fxycxyOf(const Camera& camera) { return toNumpy(VectorXd(camera.fxycxy())); }

}  // namespace kinegraph::python
