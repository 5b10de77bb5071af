#pragma once

#include <string>
#include <vector>

#include "kinegraph/geometry/shapes/geometry.h"
#include "kinegraph/math/pose.h"
#include "kinegraph/viewer/messages/messages.h"
#include "kinegraph/viewer/messages/shown.h"

namespace kinegraph::inline viewer_internal {

/// Encoders of binary messages to the page: 4-byte numbers, beginning with a BinaryKind.

template <class T>
void appendBytes(std::string& data, const T& value) {
  data.append(reinterpret_cast<const char*>(&value), sizeof value);
}

/// Appends float32 position, then w x y z.
void appendPose(std::string& data, const Pose& pose);

/// Encodes a surface without images as `packMesh` does, and other meshes as kind, number, vertices, triangles, colors
/// (0, 1 or one per vertex), texture coordinates (0 or one per vertex) and textured ranges of triangles; then float32
/// positions, uint32 indices, float32 texture coordinates, for each range uint32 first, count and image number, and
/// rgba bytes. `images` are the numbers of the images.
std::string encodeMesh(int number, const Mesh& mesh, const std::vector<int>& images, double cell = 0.);

/// Encodes kind, slices, frames, dofs, then poses and joint values, slice after slice: the bits of float32 numbers, as
/// differences from the previous slice in planes of bytes.
std::string encodeMotion(const ShownMotion& motion);

/// Encodes kind, id, columns, rows, then float32 x, y, height, zoom, then rgb bytes.
std::string encodeQuad(const Quad& quad);

/// Encodes kind, dofs, then the joint values as float64.
std::string encodeJoints(const VectorXd& q);

}  // namespace kinegraph::inline viewer_internal
