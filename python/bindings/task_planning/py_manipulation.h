#pragma once

#include <memory>

#include "kinegraph/task_planning/manipulation_helper.h"
#include "komo/py_komo.h"

namespace kinegraph::python {

/// A ManipulationHelper whose problems are KOMOs as Python knows them.
struct PyManipulation : ManipulationHelper {
  std::shared_ptr<PyKomo> pyKomo() const { return std::static_pointer_cast<PyKomo>(komo); }

 protected:
  std::shared_ptr<Komo> newKomo(const Config& C, double phases, int slices, int order) const override {
    return std::make_shared<PyKomo>(PyKomo{Komo(C, phases, slices, order), nullptr});
  }
};

}  // namespace kinegraph::python
