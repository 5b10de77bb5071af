#include "solvers/explanation_dicts.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/vector.h>

#include <cmath>

#include "python_names.h"

namespace kinegraph::python {

namespace {

nb::object orNone(double value) { return std::isnan(value) ? nb::none() : nb::object(nb::float_(value)); }

}  // namespace

std::string textOf(const Explanation& explanation) {
  std::vector<std::string> names;
  for (const Conflict& conflict : explanation.conflicts) {
    names.push_back(conflict.name);
    names.insert(names.end(), conflict.details.begin(), conflict.details.end());
  }
  return inPython(explanation.str(), names);
}

Conflicts toDicts(const Explanation& explanation) {
  Conflicts list;
  for (std::size_t i = 0; i < explanation.conflicts.size(); ++i) {
    const Conflict& conflict = explanation.conflicts[i];
    nb::dict d;
    d["name"] = conflict.name;
    d["type"] = conflict.is_bound ? std::string("bound") : objectiveTypeName(conflict.type);
    d["frames"] = conflict.frames;
    d["slices"] = conflict.slices;
    d["rows"] = conflict.rows;
    d["meters"] = orNone(conflict.violation.meters);
    d["radians"] = orNone(conflict.violation.radians);
    d["scaled"] = conflict.violation.scaled;
    d["time_order"] = conflict.violation.time_order;
    d["details"] = conflict.details;
    d["pull"] = conflict.pull;
    d["suffices"] = conflict.suffices;
    d["by_meters"] = orNone(conflict.relaxation.meters);
    d["by_radians"] = orNone(conflict.relaxation.radians);
    d["by_scaled"] = conflict.relaxation.scaled;
    d["remaining"] = conflict.remaining;
    d["best"] = int(i) == explanation.best;
    list.append(d);
  }
  return list;
}

}  // namespace kinegraph::python
