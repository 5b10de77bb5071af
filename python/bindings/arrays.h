#pragma once

#include <nanobind/nanobind.h>

#include <string>
#include <vector>

#include "kinegraph/math/pose.h"

namespace kinegraph::python {

namespace nb = nanobind;

/// Numbers as a user passes them: a number, a list, a nested list, a numpy array of any dtype. Values are row-major.
struct Numbers {
  VectorXd values;
  int rank = 0;          ///< 0: a single number
  std::size_t rows = 0;  ///< first extent

  std::vector<double> list() const { return {values.begin(), values.end()}; }
  std::size_t columns() const {
    return rank < 2 || rows == 0 ? std::size_t(values.size()) : std::size_t(values.size()) / rows;
  }
  MatrixXd matrix() const;  ///< rank 2 as it is, less as one row
};

/// The same for a call that only reads them: an array of doubles is looked at where it is. Valid while the argument
/// lives.
struct NumbersView {
  Eigen::Map<const VectorXd> values{nullptr, 0};
  int rank = 0;
  Numbers copy;
};

namespace numpy {
inline bool isArray(PyObject*) noexcept { return true; }  // only ever made here
}  // namespace numpy

/// A numpy array of float64. The name is what type checkers see.
class Array : public nb::object {
  NB_OBJECT_DEFAULT(Array, nb::object, "numpy.typing.NDArray[numpy.float64]", numpy::isArray)
  explicit Array(nb::object array) : nb::object(std::move(array)) {}
};

/// Numpy arrays of other numbers.
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

/// A numpy array of that size or shape (rows, columns) that nobody else has, and where its numbers are. It is not
/// filled.
struct NewArray {
  Array array;
  double* data;
};
NewArray newArray(std::size_t size);
NewArray newArray(std::size_t rows, std::size_t columns);
NewArray newArray(std::size_t layers, std::size_t rows, std::size_t columns);
NewArray newArray(std::size_t blocks, std::size_t layers, std::size_t rows, std::size_t columns);

/// Numpy arrays of one shape (rank 1 or 2), each handed out again once nobody else holds it: that takes a fraction of
/// the time of making one. Needs the interpreter lock.
class ReusedArrays {
 public:
  ReusedArrays() = default;
  ReusedArrays(ReusedArrays&&) = default;
  ReusedArrays& operator=(ReusedArrays&&) = default;

  /// With numbers that are left over from before.
  NewArray get(std::size_t size);
  NewArray get(std::size_t rows, std::size_t columns);

 private:
  struct Kept {
    nb::object array;
    int flags = 0;               ///< numpy's, as they were when it was made
    const void* type = nullptr;  ///< and its dtype
  };
  NewArray get(int rank, const std::ptrdiff_t* shape);

  Kept kept_[2];  ///< two, as `y, J = f()` in a loop lets go of the last result after it has the next one
  std::size_t next_ = 0;
};

/// A new numpy array of truth values, and where they are.
struct NewFlags {
  FlagArray array;
  bool* data;
};
NewFlags newFlags(std::size_t size);

/// Reads numbers; false if `source` is none.
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
