#pragma once

#include "kinegraph/gfile/value.h"

namespace kinegraph {

/// Turns `["float64", [2, 2], "base64..."]`, as exporters write long arrays, into numbers; the data may also be
/// numbers. Any other value is left as it is. Throws ValueError if the data do not fit the dimensions.
void decodeTypedArray(Value& value);

}  // namespace kinegraph
