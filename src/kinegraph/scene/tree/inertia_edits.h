#pragma once

#include "kinegraph/scene/tree/scene_tree.h"

namespace kinegraph {

/// Surface density of things whose mass nobody gave, kg/m^2.
constexpr double kSurfaceDensity = 5.;

/// Gathers the inertias of a frame and of all frames that are fixed to it from below (no joint in between) in the
/// frame; the others have none afterwards. Without any mass nothing changes.
void gatherInertia(FrameData& frame);

/// Moves the frame to the center of mass of its inertia and turns it to the principal axes, so that the matrix is
/// diagonal. Everything below it stays where it is in the world. `X` is the new frame in the old one. A mesh, point
/// cloud or convex hull of the frame stays where it is if `transform_mesh`. Throws ValueError for a frame without
/// inertia, with dofs, or with a shape that cannot stay where it is (a marker may move).
Pose moveToPrincipalAxes(SceneTree& scene, FrameData& frame, bool transform_mesh);

struct InertiaOptions {
  bool recompute = true;        ///< first, every opaque shape gets the mass of its surface, and transparent ones none
  bool principal_axes = false;  ///< finally, the frames of links move to the principal axes
};

/// Gathers the inertia of every link in the frame of its joint, or in the root for links without one. With
/// `principal_axes` a link frame that cannot move, because of its shape or dofs, gets a child `<name>_inertia` that
/// holds the inertia instead.
void processInertias(SceneTree& scene, const InertiaOptions& options = {});

}  // namespace kinegraph
