#pragma once

#include <optional>
#include <vector>

#include "kinegraph/parsers/mjcf/mjcf_document.h"
#include "kinegraph/parsers/mjcf/mjcf_values.h"

namespace kinegraph::inline parsers_internal {

/// A height field as a mesh of convex parts, as attributes of a frame.
struct HeightFieldMesh {
  std::vector<double> vertices, triangles;  ///< n x 3
  std::vector<double> parts;                ///< first vertex of each part
};

/// Converts an <hfield> of MJCF: heights from `elevation`, a PNG file, or MuJoCo's binary format, normalized to 0..1,
/// over the rectangle of `size`. Each cell is two prisms, as in MuJoCo. A field of more than 2500 cells is divided into
/// larger parts, with a warning: their hulls fill its valleys. Returns nullopt after a warning.
std::optional<HeightFieldMesh> readHeightField(const MjcfElement& asset, const MjcfDocument& document,
                                               MjcfValues& values, Findings& findings);

}  // namespace kinegraph::inline parsers_internal
