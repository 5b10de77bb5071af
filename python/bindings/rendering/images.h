#pragma once

#include <nanobind/ndarray.h>

#include <initializer_list>
#include <memory>
#include <vector>

#include "bindings.h"
#include "kinegraph/rendering/camera_renderer.h"

namespace kinegraph::python {

/// Returns a numpy array that owns these values; `ImageArray` defines its dtype.
template <class ImageArray, class T>
ImageArray toImage(std::vector<T> values, std::initializer_list<std::size_t> shape) {
  auto kept = std::make_unique<std::vector<T>>(std::move(values));
  T* data = kept->data();
  const nb::capsule owner(kept.release(), [](void* p) noexcept { delete static_cast<std::vector<T>*>(p); });
  return ImageArray(nb::cast(nb::ndarray<nb::numpy, T>(data, shape, owner)));
}

inline ByteArray rgbOf(CameraImage& image) {
  return toImage<ByteArray>(std::move(image.rgb), {std::size_t(image.height), std::size_t(image.width), 3});
}

inline FloatArray depthOf(CameraImage& image) {
  return toImage<FloatArray>(std::move(image.depth), {std::size_t(image.height), std::size_t(image.width)});
}

inline Array fxycxyOf(const Camera& camera) { return toNumpy(VectorXd(camera.fxycxy())); }

}  // namespace kinegraph::python
