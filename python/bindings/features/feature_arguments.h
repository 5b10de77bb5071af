#pragma once

#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "arrays.h"
#include "kinds.h"
#include "kinegraph/features/feature_source.h"

namespace kinegraph::python {

/// A feature argument: a symbol of FS, or a function of frames.
struct FeatureArgument {
  FeatureSymbol symbol = FeatureSymbol::position;
  nb::object function;  ///< null for a symbol

  FeatureSource source() const;
};

/// Makes a feature from a Python function.
FeatureSource customFeature(nb::object function);

/// Returns the function; None for a symbol.
nb::object functionOf(const FeatureSource& source);

/// Frames argument: a name or a list of names.
using FrameNames = std::variant<std::vector<std::string>, std::string>;

/// An argument that is inspected before its conversion to a T.
template <class T>
struct Unread {
  nb::handle object;

  /// Converts it, or throws the exception that leads to a TypeError.
  T read() const {
    T value;
    if (!nb::try_cast(object, value)) throw nb::next_overload();
    return value;
  }
};

std::vector<std::string> toNames(const FrameNames& frames);
MatrixXd toScale(const std::optional<Numbers>& scale);
VectorXd toTarget(const std::optional<Numbers>& target);

}  // namespace kinegraph::python

namespace nanobind::detail {

template <>
struct type_caster<kinegraph::python::FeatureArgument> {
  NB_TYPE_CASTER(kinegraph::python::FeatureArgument, const_name("FS | collections.abc.Callable"))

  bool from_python(handle source, uint8_t flags, cleanup_list* cleanup) noexcept {
    make_caster<kinegraph::FeatureSymbol> symbol;
    if (symbol.from_python(source, flags, cleanup)) {
      value.symbol = symbol.operator cast_t<kinegraph::FeatureSymbol>();
      return true;
    }
    PyErr_Clear();
    if (!PyCallable_Check(source.ptr())) return false;
    value.function = borrow(source);
    return true;
  }
};

template <class T>
struct type_caster<kinegraph::python::Unread<T>> {
  NB_TYPE_CASTER(kinegraph::python::Unread<T>, make_caster<T>::Name)

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    value.object = source;
    return true;
  }
};

}  // namespace nanobind::detail
