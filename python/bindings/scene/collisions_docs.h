#pragma once

/// The manual of what bind_collisions.cpp binds.
namespace kinegraph::python::docs::collisions {

inline constexpr char getCollidablePairs[] =
    R"(Names of the frames that may collide, two by two: a1 b1 a2 b2 ... Shapes with `contact` 0 are in no pair.

A flag -k leaves out links up to k joints above, `contact_exclude` the frames that it names. Shapes of URDF files have -2;
where an SRDF file names pairs, only those are left out.)";

inline constexpr char getCollisions[] =
    R"(All collidable pairs nearer than a margin, at the present q, also those that no joint moves apart. What judges a
posture or a motion (`isValid`, `solveIk`, `planMotion`, KOMO) leaves these out, as no q mends them.

Args:
    belowMargin: The margin, m; 0 gives the pairs that overlap.
Returns:
    A tuple per pair: two names and their distance, m; negative: penetration depth.)";

inline constexpr char ignoreCollisionsNow[] =
    R"(Lets the pairs that overlap at the present q never collide from now on, as `contact_exclude` of a scene file does: for
models of which parts overlap where they are joined. Of a frame that carries shapes of frames fixed to it, these are meant,
too.

Args:
    margin: Pairs that are nearer than that count as overlapping, m.
Returns:
    A tuple per pair that is left out: two names and their distance, m; negative: penetration depth.)";

inline constexpr char selfCollisionMatrix[] =
    R"(Which parts of a robot can collide with one another, found in random postures within the limits, as MoveIt's setup
assistant does. All shapes that one frame carries are taken together.

A pair that collides in a share p of all postures is missed with the probability (1 - p)^samples: of 10000 samples 37 % for
p = 1e-4. The same answer for a seed, with any number of threads.

Args:
    samples: Postures that are drawn.
    seed: Of the postures.
    margin: Shapes nearer than that count as colliding, m; above 0 fewer pairs count as never colliding.
    always: Share of the postures from which on a pair counts as always colliding, which is how it is modeled.
    root: The robot's first frame: it counts with all that hangs on it. "": all that joints move, and so no base.
    threads: How many share the postures.
    apply: Lets all pairs never collide from now on but those that do so sometimes. They are in what is written, too: as
        `contact_exclude` in a scene file, as `disable_collisions` in asSRDF.
Returns:
    A SelfCollisionMatrix; `pairs` has a tuple per pair.
Raises:
    FrameNotFound: There is no frame `root`.
    ArgumentError: No shapes that may collide and that joints move apart, or a setting that makes no sense.)";

inline constexpr char pairs[] =
    R"(A tuple per pair of frames that carry shapes and may collide: two names, the reason, the share of postures in which they
collide. "adjacent": one joint connects them; "always": in nearly all postures; "never": in none; "sometimes": all others, and
those with a joint cancellation them that slides without limits.)";

inline constexpr char coll_totalViolation[] = R"(How deep all collidable pairs overlap, at the present q.

Args:
    return_maximal: The largest depth in place of the sum.
Returns:
    The sum of all penetration depths, or the largest, m.)";

inline constexpr char contactWarnings[] =
    R"(What one may not expect about which shapes collide. Calls that ask whether something is free warn of it,
once per scene.

Returns:
    Sentences: of shapes that overlap and that no joint moves apart, and of shapes without `contact` near what moves.)";

inline constexpr char checkMotion[] =
    R"(Where a straight motion of q first brings two frames too near, or a joint beyond its limits. All times of the motion count,
not only samples of it. Pairs that no joint moves apart do not count: they say nothing about q. A joint may be 1e-5 rad or m
beyond a limit.

Args:
    start: q at the start, shape (n,), rad or m.
    end: q at the end, shape (n,), rad or m.
    margin: Distance that all pairs keep that joints move apart, m.
    tolerance: A pair that comes within margin + tolerance (m) may be reported as well.
Returns:
    The first MotionContact, or None where the motion is free.
Raises:
    ArgumentError: start or end have another size; the margin is not a distance, or the tolerance not positive.)";

}  // namespace kinegraph::python::docs::collisions
