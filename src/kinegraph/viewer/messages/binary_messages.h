#pragma once

#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/viewer/messages/look.h"
#include "kinegraph/viewer/messages/messages.h"
#include "kinegraph/viewer/messages/shown_motion.h"

namespace kinegraph {

/// Binary messages to the page: numbers of 4 bytes one after another, the first a BinaryKind.

template <class T>
void appendBytes(std::string& data, const T& value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// float32: position, then w x y z.
void appendPose(std::string& data, const Pose& pose);

/// kind, number, vertices, triangles, colors (0, 1 or as many as vertices), texture coordinates (0 or as many),
/// textured ranges of triangles; then float32 positions, uint32 indices, float32 texture coordinates, uint32 first,
/// count, number of the picture for each range, rgba bytes. `images`: the numbers of the pictures.
std::string encodeMesh(int number, const Mesh& mesh, const std::vector<int>& images);

/// kind, slices, frames, dofs, then float32 poses and joint values, slice after slice.
std::string encodeMotion(const ShownMotion& motion);

/// kind, id, columns, rows, then float32 x, y, height, zoom, then rgb bytes.
std::string encodeQuad(const Quad& quad);

/// kind, dofs, then their values as float64.
std::string encodeJoints(const VectorXd& q);

}  // namespace kinegraph
