#pragma once

#include <functional>
#include <map>
#include <string>

#include "kinegraph/gfile/value.h"
#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_expansion.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"

namespace kinegraph::inline parsers_internal {

/// value of a joint = offset + factor * value of `source`; constant without a source.
struct MjcfCoupling {
  std::string source;
  double offset = 0., factor = 0.;
  SourcePosition where;
};

/// Returns the couplings of <equality> by joint name, each with an independent source. `joints` are all named joints.
/// Unsupported couplings are skipped with a warning.
std::map<std::string, MjcfCoupling> mjcfCouplings(const MjcfDocument& document,
                                                  const std::map<std::string, MjcfElement>& joints, MjcfValues& values,
                                                  Findings& findings);

/// The joint value at the pose in the file: `ref`, in rad or m.
double mjcfReference(const MjcfElement& joint, MjcfValues& values);

/// Adds an attribute `actuators` to the frames that <actuator> drives, as information for people: per name the type,
/// the target, and the gear, ranges and gains as written. `frameOf` returns the frame of an element of that kind
/// ("joint", "site", "body") and name, or "" for none; the frame `world` lists the actuators of tendons and of unknown
/// targets.
void addActuators(const MjcfDocument& document, const std::function<std::string(const MjcfName&)>& frameOf,
                  Graph& graph);

}  // namespace kinegraph::inline parsers_internal
