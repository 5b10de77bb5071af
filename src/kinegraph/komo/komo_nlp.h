#pragma once

#include "kinegraph/komo/komo.h"

namespace kinegraph {

/// The problem of a Komo, which has slices, with these objectives in place of its own.
std::shared_ptr<Nlp> makeNlp(std::shared_ptr<Komo> komo, std::vector<Objective> objectives);

}  // namespace kinegraph
