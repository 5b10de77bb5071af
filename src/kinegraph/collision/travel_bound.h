#pragma once

#include "kinegraph/kinematics/state.h"

namespace kinegraph {

/// How far any point of a collidable body moves, at most, where every dof changes by so much, m: at all postures whose dofs
/// are within `spread` of this one.
///
/// A point's velocity by a joint turns with joints nearer to the world and keeps its size; by a joint nearer to the point
/// that moves it by d relative to the first, it changes by |w| d. Joint after joint, from the point to the world, that bounds
/// how fast each moves the point. Where quaternions or circles move a body, that is no proof, and 5 % are added.
double travelOf(const State& state, const VectorXd& change, const VectorXd& spread);

}  // namespace kinegraph
