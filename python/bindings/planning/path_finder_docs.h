#pragma once

namespace kinegraph::python::docs::path_finder {

inline constexpr char type[] =
    R"(Finds a path cancellation two joint vectors, free of collisions at all times, as older scripts ask for it.

    rrt = ry.RRT_PathFinder().setProblem(C)
    rrt.setStartGoal(q0, qT)
    ret = rrt.solve()
    if ret.feasible: C.view_path(ret.x)

planMotion does more: many goals, constraints, times.)";

inline constexpr char make[] = R"(Without a problem.)";

inline constexpr char setOptions[] = R"(Sets options by name.

Args:
    options: verbose, stepsize (rad or m cancellation postures of the path), maxIters (effort), collisionTolerance (m, how deep
        pairs may overlap); subsamples, p_connect and useBroadCollisions of older scripts have no effect.
Returns:
    This path finder.
Raises:
    ArgumentError: There is no such option, or it cannot have this value.)";

inline constexpr char setProblem[] = R"(Sets the scene, which is read when solve is called, and not changed.

Args:
    Configuration: The scene.
    q0: The start, as in setStartGoal, if given.
    qT: The goal, as in setStartGoal, if given.
Returns:
    This path finder.
Raises:
    ArgumentError: Of q0 and qT only one is given, or one is not a joint vector.)";

inline constexpr char setStartGoal[] = R"(Sets the two ends of the path.

Args:
    starts: One joint vector, shape (n,) or (1, n), rad or m.
    goals: One joint vector, shape (n,) or (1, n), rad or m.
Returns:
    This path finder.
Raises:
    ArgumentError: One of them is no joint vector, or several.)";

inline constexpr char setExplicitCollisionPairs[] = R"(Lets only these pairs of frames collide.

Args:
    collisionPairs: Names of frames, two by two: a1 b1 a2 b2 ...; none: the pairs of the scene again.
Returns:
    This path finder.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The number of names is odd.)";

inline constexpr char solve[] =
    R"(Searches a path. The same seed (rnd_seed) gives the same path. Ctrl-C ends the search.

Args:
    verbose: 0: silent; 1: prints a line; 2 and more: shows the path, too, and waits.
Returns:
    The outcome: x is the path, shape (K, n), start and goal included, postures at most stepsize apart; feasible, whether
    there is one. Where there is none, x is empty and message says why, as "the start collides: ...". evals is the number of
    random postures.
Raises:
    ArgumentError: There is no problem, or start and goal do not fit it; a joint has no limits.)";

inline constexpr char getResampledPath[] = R"(Postures of the path, evenly in its index.

Args:
    T: How many.
Returns:
    Shape (T, n), rad or m.
Raises:
    ArgumentError: There is no path, or T is less than 1.)";

inline constexpr char view[] = R"(Shows the path in the browser, with a time slider.

Args:
    pause: Waits for a key.
    message: A text in the corner.
    play: Plays it; else it can be played there.
Returns:
    The key, or 0.
Raises:
    ArgumentError: There is no path.)";

}  // namespace kinegraph::python::docs::path_finder
