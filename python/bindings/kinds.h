#pragma once

#include <nanobind/nanobind.h>

namespace kinegraph {
enum class ControlMode : int;
enum class FeatureSymbol : int;
enum class JointType : int;
enum class ObjectiveType : int;
enum class OptMethod : int;
enum class ShapeType : int;
enum class SimulationEngine : int;
enum class SwitchMode : int;
}  // namespace kinegraph

namespace kinegraph::python {

/// Returns whether an object is a member of an enumeration; such members are integers, too.
inline bool isMember(nanobind::handle object) noexcept {
  return PyLong_Check(object.ptr()) && !PyLong_CheckExact(object.ptr()) && !PyBool_Check(object.ptr()) &&
         PyObject_HasAttrString(reinterpret_cast<PyObject*>(Py_TYPE(object.ptr())), "__members__");
}

}  // namespace kinegraph::python

namespace nanobind::detail {

/// Casts a member of one enumeration, or its number. Rejects members of other enumerations: OT.eq is not a feature.
template <class T>
struct KindCaster {
  NB_TYPE_CASTER(T, const_name<T>())

  bool from_python(handle source, std::uint32_t flags, cleanup_list* cleanup) noexcept {
    constexpr std::uint32_t convert = std::uint32_t(cast_flags::convert);
    std::int64_t number;
    const auto take = [&](std::uint32_t how) {
      return NB_CALL(enum_from_python)(NB_CTX_C(cleanup), &typeid(T), source.ptr(), &number, how);
    };
    if (!take(flags & ~convert)) {  // not a member of this enumeration, the most common case
      if (!(flags & convert) || kinegraph::python::isMember(source) || !take(flags)) return false;
    }
    value = T(number);
    return true;
  }

  static handle from_cpp(T member, rv_policy, cleanup_list* cleanup) noexcept {
    return NB_CALL(enum_from_cpp)(NB_CTX_C(cleanup), &typeid(T), std::int64_t(member));
  }
};

template <>
struct type_caster<kinegraph::ControlMode> : KindCaster<kinegraph::ControlMode> {};
template <>
struct type_caster<kinegraph::FeatureSymbol> : KindCaster<kinegraph::FeatureSymbol> {};
template <>
struct type_caster<kinegraph::JointType> : KindCaster<kinegraph::JointType> {};
template <>
struct type_caster<kinegraph::ObjectiveType> : KindCaster<kinegraph::ObjectiveType> {};
template <>
struct type_caster<kinegraph::OptMethod> : KindCaster<kinegraph::OptMethod> {};
template <>
struct type_caster<kinegraph::ShapeType> : KindCaster<kinegraph::ShapeType> {};
template <>
struct type_caster<kinegraph::SimulationEngine> : KindCaster<kinegraph::SimulationEngine> {};
template <>
struct type_caster<kinegraph::SwitchMode> : KindCaster<kinegraph::SwitchMode> {};

}  // namespace nanobind::detail
