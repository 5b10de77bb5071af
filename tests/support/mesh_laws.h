#pragma once

#include <map>
#include <utility>

#include "kinegraph/geometry/shapes/geometry.h"

namespace kinegraph::testing {

constexpr double kMergeGrid = 1e-9;  ///< vertices of surfaces merge at this grid
constexpr double kFacets = .03;      ///< relative loss of volume by cutting a quarter turn into six

/// Edges that are not run through exactly once in each direction: 0 for a closed surface of one orientation.
inline int openEdges(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> count;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) ++count[{triangle[i], triangle[(i + 1) % 3]}];
  }
  int open = 0;
  for (const auto& [edge, times] : count) {
    const auto back = count.find({edge.second, edge.first});
    if (times != 1 || back == count.end() || back->second != 1) ++open;
  }
  return open;
}

/// Positive for a closed mesh whose triangles look outward, m^3.
inline double volume(const Mesh& mesh) {
  double sum = 0.;
  for (const auto& [i, j, k] : mesh.triangles) {
    sum += mesh.vertices[i].dot(mesh.vertices[j].cross(mesh.vertices[k])) / 6.;
  }
  return sum;
}

}  // namespace kinegraph::testing
