#pragma once

#include "kinegraph/gfile/value.h"

namespace kinegraph::inline gfile_internal {

/// Decodes `["float64", [2, 2], "base64..."]`, the form of long arrays in exported files, to numbers; the data may also
/// be plain numbers. Leaves other values unchanged. Throws ValueError if the data do not fit the dimensions.
void decodeTypedArray(Value& value);

}  // namespace kinegraph::inline gfile_internal
