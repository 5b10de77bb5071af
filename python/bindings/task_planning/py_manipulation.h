#pragma once

#include <memory>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "komo/py_komo.h"

namespace kinegraph::python {

/// The name of a frame, from a text or a Frame.
struct FrameName {
  std::string name;
  operator const std::string&() const { return name; }
};

/// A ManipulationHelper whose problems are KOMOs as Python knows them.
struct PyManipulation : ManipulationHelper {
  std::shared_ptr<PyKomo> pyKomo() const { return std::static_pointer_cast<PyKomo>(komo); }

 protected:
  std::shared_ptr<Komo> newKomo(const Config& C, double phases, int slices, int order) const override {
    return std::make_shared<PyKomo>(PyKomo{Komo(C, phases, slices, order), nullptr});
  }
};

}  // namespace kinegraph::python

namespace nanobind::detail {

template <>
struct type_caster<kinegraph::python::FrameName> {
  NB_TYPE_CASTER(kinegraph::python::FrameName, const_name("str | Frame"))

  bool from_python(handle source, uint8_t, cleanup_list*) noexcept {
    kinegraph::Frame* frame = nullptr;
    try {
      if (try_cast(source, value.name)) return true;
      if (!try_cast(source, frame) || !frame) return false;
      value.name = frame->getName();
      return true;
    } catch (...) {
      return false;
    }
  }
};

}  // namespace nanobind::detail
