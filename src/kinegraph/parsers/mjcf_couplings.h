#pragma once

#include <map>
#include <string>

#include "kinegraph/parsers/mjcf_document.h"
#include "kinegraph/parsers/mjcf_values.h"

namespace kinegraph {

/// value of a joint = offset + factor * value of `source`; constant without a source.
struct MjcfCoupling {
  std::string source;
  double offset = 0., factor = 0.;
  SourcePosition where;
};

/// The joints that <equality> makes follow another one, by name, each with a source that follows none. `joints` are all
/// joints that have names. What cannot be said so is left out with a warning.
std::map<std::string, MjcfCoupling> mjcfCouplings(const MjcfDocument& document,
                                                  const std::map<std::string, MjcfElement>& joints, MjcfValues& values,
                                                  Findings& findings);

/// The value of a joint that stands at the place where the file has it: `ref`, in rad or m.
double mjcfReference(const MjcfElement& joint, MjcfValues& values);

}  // namespace kinegraph
