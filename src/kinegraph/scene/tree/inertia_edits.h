#pragma once

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph::inline scene_internal {

/// Surface density of shapes without a given mass, kg/m^2.
constexpr double kSurfaceDensity = 5.;

/// The sum of all masses, kg.
double totalMass(const SceneTree& scene);

/// Gathers the inertias of a frame and of all frames rigidly fixed below it in this frame, and clears the others.
/// Without any mass nothing changes.
void gatherInertia(FrameData& frame);

/// Moves the frame to its center of mass and rotates it to the principal axes of its inertia, which makes the matrix
/// diagonal. All frames below keep their world poses. Returns the new frame in the old one. A mesh, point cloud or
/// convex hull of the frame keeps its world pose if `transform_mesh`. Throws ValueError for a frame without inertia,
/// with dofs, or with a shape that cannot stay in place (a marker may move).
Pose moveToPrincipalAxes(SceneTree& scene, FrameData& frame, bool transform_mesh);

struct InertiaOptions {
  bool recompute = true;        ///< first, give every opaque shape the mass of its surface, and transparent ones none
  bool principal_axes = false;  ///< finally, move the link frames to the principal axes
};

/// Gathers the inertia of every link in the frame of its joint, or in the root for links without a joint. With
/// `principal_axes`, a link frame that cannot move because of its shape or dofs gets a child `<name>_inertia` with the
/// inertia instead.
void processInertias(SceneTree& scene, const InertiaOptions& options = {});

}  // namespace kinegraph::inline scene_internal
