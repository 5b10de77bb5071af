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
  std::size_t columns() const { return rank < 2 || rows == 0 ? std::size_t(values.size()) : std::size_t(values.size()) / rows; }
  MatrixXd matrix() const;  ///< rank 2 as it is, less as one row
};

/// A new numpy array (float64, C order) with these contents.
nb::object toNumpy(const double* values, std::size_t size);
nb::object toNumpy(const VectorXd& vector);
nb::object toNumpy(const MatrixXd& matrix);
nb::object toNumpy(const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& matrix);

/// A new numpy array of that size or shape (rows, columns), and where its numbers are.
struct NewArray {
  nb::object array;
  double* data;
};
NewArray newArray(std::size_t size);
NewArray newArray(std::size_t rows, std::size_t columns);
NewArray newArray(std::size_t layers, std::size_t rows, std::size_t columns);

/// A new numpy array of truth values, and where they are.
struct NewFlags {
  nb::object array;
  bool* data;
};
NewFlags newFlags(std::size_t size);

/// Reads numbers; false if `source` is none.
bool readNumbers(nb::handle source, Numbers& target);

}  // namespace kinegraph::python

namespace nanobind::detail {

template <>
struct type_caster<kinegraph::python::Numbers> {
  NB_TYPE_CASTER(kinegraph::python::Numbers, const_name("float | collections.abc.Sequence | numpy.typing.ArrayLike"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    return kinegraph::python::readNumbers(source, value);
  }
};

}  // namespace nanobind::detail
