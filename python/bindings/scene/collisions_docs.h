#pragma once

/// Docstrings for bind_collisions.cpp.
namespace kinegraph::python::docs::collisions {

inline constexpr char getCollidablePairs[] =
    R"(Returns the names of frames that may collide, two by two: a1 b1 a2 b2 ... Shapes with `contact` 0 are in no pair.

A flag -k excludes links up to k joints above; `contact_exclude` excludes the frames it names. Shapes of URDF files have
the flag -2; if an SRDF file lists pairs, only those are excluded.)";

inline constexpr char getCollisions[] =
    R"(Finds all collidable pairs closer than a margin at the current q, including pairs at a constant relative pose.

Checks of a configuration or a motion (`isValid`, `solveIk`, `planMotion`, KOMO) ignore pairs at a constant relative
pose, because they do not depend on q.

Args:
    belowMargin: The margin, m; 0 returns the overlapping pairs.
Returns:
    A tuple per pair: two names and their distance, m; negative: penetration depth.)";

inline constexpr char ignoreCollisionsNow[] =
    R"(Excludes the pairs that overlap at the current q from collision, as `contact_exclude` of a scene file does.

Useful for models with overlapping parts at their joints. A shape that is fixed to its parent excludes the parent's
shapes, too.

Args:
    margin: Pairs closer than this count as overlapping, m.
Returns:
    A tuple per excluded pair: two names and their distance, m; negative: penetration depth.)";

inline constexpr char selfCollisionMatrix[] =
    R"(Classifies the pairs of a robot by sampling random configurations within the limits, as MoveIt's setup
assistant does.

All shapes carried by one frame are taken together. A pair that collides with probability p is missed with probability
(1 - p)^samples: 37 % for p = 1e-4 and 10000 samples. A seed gives the same result for any number of threads.

Args:
    samples: Number of sampled configurations.
    seed: Seed of the samples.
    margin: Shapes closer than this count as colliding, m; a value above 0 yields fewer pairs of class "never".
    always: Fraction of samples from which a pair counts as always colliding: the model overlaps by design.
    root: First frame of the robot, checked with its subtree. "": all moving links, without a fixed base.
    threads: Number of threads.
    apply: Excludes all pairs except those of class "sometimes" from collision. Exports include the exclusions: as
        `contact_exclude` in a scene file, as `disable_collisions` in asSRDF.
Returns:
    A SelfCollisionMatrix; `pairs` has a tuple per pair.
Raises:
    FrameNotFound: `root` does not exist.
    ArgumentError: No collidable pair of shapes moves relative to each other, or a setting is invalid.)";

inline constexpr char pairs[] =
    R"(A tuple per collidable pair of frames: two names, the reason, and the fraction of samples in collision.

Reasons: "adjacent": one joint connects them; "always": they collide in nearly all samples; "never": in none;
"sometimes": all others, and pairs with an unlimited sliding joint between them.)";

inline constexpr char coll_totalViolation[] = R"(Sums the penetration depths of all collidable pairs at the current q.

Args:
    return_maximal: Returns the largest depth instead of the sum.
Returns:
    The sum of all penetration depths, or the largest one, m.)";

inline constexpr char contactWarnings[] =
    R"(Describes unexpected collision settings. Collision checks warn of them once per scene.

Returns:
    Sentences about overlapping shapes at a constant relative pose, and shapes without `contact` near moving links.)";

inline constexpr char checkMotion[] =
    R"(Finds the first obstruction of a straight motion of q: two frames too close, or a joint beyond its limits.

The check is continuous in time. Pairs at a constant relative pose are ignored because they do not depend on q. A joint
may be 1e-5 rad or m beyond a limit.

Args:
    start: q at the start, shape (n,), rad or m.
    end: q at the end, shape (n,), rad or m.
    margin: Minimum distance of all pairs that joints move apart, m.
    tolerance: A pair within margin + tolerance (m) may be reported as well.
Returns:
    The first MotionContact, or None for a collision-free motion.
Raises:
    ArgumentError: start or end has another size, the margin is not finite, or the tolerance is not positive.)";

}  // namespace kinegraph::python::docs::collisions
