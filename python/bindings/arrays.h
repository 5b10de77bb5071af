#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::python {

namespace nb = nanobind;

/// Numeric argument: a number, a list, a nested list, or a numpy array of any dtype. Values are row-major.
struct Numbers {
  VectorXd values;
  int rank = 0;          ///< 0: a single number
  std::size_t rows = 0;  ///< first extent

  std::vector<double> list() const { return {values.begin(), values.end()}; }
  std::size_t columns() const {
    return rank < 2 || rows == 0 ? std::size_t(values.size()) : std::size_t(values.size()) / rows;
  }
  MatrixXd matrix() const;  ///< rank 2 unchanged; lower ranks as one row
};

/// Numeric argument for calls that only read it: an array of doubles is used without a copy. Valid while the argument
/// lives.
struct NumbersView {
  Eigen::Map<const VectorXd> values{nullptr, 0};
  int rank = 0;
  Numbers copy;
};

namespace numpy {
inline bool isArray(PyObject*) noexcept { return true; }  // only created here
}  // namespace numpy

/// A numpy array of float64. The name appears in type annotations.
class Array : public nb::object {
  NB_OBJECT_DEFAULT(Array, nb::object, "numpy.typing.NDArray[numpy.float64]", numpy::isArray)
  explicit Array(nb::object array) : nb::object(std::move(array)) {}
};

/// Numpy arrays of other number types.
class IndexArray : public nb::object {
  NB_OBJECT_DEFAULT(IndexArray, nb::object, "numpy.typing.NDArray[numpy.uint32]", numpy::isArray)
  explicit IndexArray(nb::object array) : nb::object(std::move(array)) {}
};
class FlagArray : public nb::object {
  NB_OBJECT_DEFAULT(FlagArray, nb::object, "numpy.typing.NDArray[numpy.bool_]", numpy::isArray)
  explicit FlagArray(nb::object array) : nb::object(std::move(array)) {}
};
class ByteArray : public nb::object {
  NB_OBJECT_DEFAULT(ByteArray, nb::object, "numpy.typing.NDArray[numpy.uint8]", numpy::isArray)
  explicit ByteArray(nb::object array) : nb::object(std::move(array)) {}
};
class IdArray : public nb::object {
  NB_OBJECT_DEFAULT(IdArray, nb::object, "numpy.typing.NDArray[numpy.int32]", numpy::isArray)
  explicit IdArray(nb::object array) : nb::object(std::move(array)) {}
};
class CountArray : public nb::object {
  NB_OBJECT_DEFAULT(CountArray, nb::object, "numpy.typing.NDArray[numpy.int64]", numpy::isArray)
  explicit CountArray(nb::object array) : nb::object(std::move(array)) {}
};
class FloatArray : public nb::object {
  NB_OBJECT_DEFAULT(FloatArray, nb::object, "numpy.typing.NDArray[numpy.float32]", numpy::isArray)
  explicit FloatArray(nb::object array) : nb::object(std::move(array)) {}
};

/// A new numpy array (float64, C order) with these contents.
Array toNumpy(const double* values, std::size_t size);
Array toNumpy(const VectorXd& vector);
Array toNumpy(const MatrixXd& matrix);
Array toNumpy(const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& matrix);

/// A new, uninitialized numpy array of that size or shape (rows, columns), and a pointer to its numbers.
struct NewArray {
  Array array;
  double* data;
};
NewArray newArray(std::size_t size);
NewArray newArray(std::size_t rows, std::size_t columns);
NewArray newArray(std::size_t layers, std::size_t rows, std::size_t columns);
NewArray newArray(std::size_t blocks, std::size_t layers, std::size_t rows, std::size_t columns);

/// A cache of numpy arrays of one shape (rank 1 or 2): an array without other owners is handed out again, which takes a
/// fraction of the time of creating one. Requires the GIL.
class ReusedArrays {
 public:
  ReusedArrays() = default;
  ReusedArrays(ReusedArrays&&) = default;
  ReusedArrays& operator=(ReusedArrays&&) = default;

  /// The array contains old numbers.
  NewArray get(std::size_t size);
  NewArray get(std::size_t rows, std::size_t columns);

 private:
  struct Kept {
    nb::object array;
    int flags = 0;               ///< numpy's flags at creation
    const void* type = nullptr;  ///< dtype at creation
  };
  NewArray get(int rank, const std::ptrdiff_t* shape);

  Kept kept_[2];  ///< two, because `y, J = f()` in a loop releases the last result only after the next call
  std::size_t next_ = 0;
};

/// A new numpy array of booleans, and a pointer to its values.
struct NewFlags {
  FlagArray array;
  bool* data;
};
NewFlags newFlags(std::size_t size);

/// Reads numbers; returns false if `source` is not numeric.
bool readNumbers(nb::handle source, Numbers& target);
bool readNumbers(nb::handle source, NumbersView& target);

}  // namespace kinegraph::python

namespace nanobind::detail {

template <>
struct type_caster<kinegraph::python::Numbers> {
  NB_TYPE_CASTER(kinegraph::python::Numbers, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    return kinegraph::python::readNumbers(source, value);
  }
};

template <>
struct type_caster<kinegraph::python::NumbersView> {
  NB_TYPE_CASTER(kinegraph::python::NumbersView, const_name("numpy.typing.ArrayLike"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    return kinegraph::python::readNumbers(source, value);
  }
};

}  // namespace nanobind::detail
