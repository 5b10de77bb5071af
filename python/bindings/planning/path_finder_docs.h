#pragma once

namespace kinegraph::python::docs::path_finder {

inline constexpr char type[] =
    R"(Finds a continuously collision-free path between two joint vectors; the interface of the reference package.

    rrt = ry.RRT_PathFinder().setProblem(C)
    rrt.setStartGoal(q0, qT)
    ret = rrt.solve()
    if ret.feasible: C.view_path(ret.x)

planMotion does more: several goals, constraints, time parameterization.)";

inline constexpr char make[] = R"(Creates a path finder without a problem.)";

inline constexpr char setOptions[] = R"(Sets options by name, or by place in the order below.

Args:
    by_place: Values of verbose, stepsize, subsamples, maxIters, p_connect, collisionTolerance, useBroadCollisions.
    options: verbose, stepsize (rad or m, between configurations of the path), maxIters (iterations), collisionTolerance
        (m, allowed penetration of pairs). subsamples, p_connect and useBroadCollisions have no effect.
Returns:
    This path finder.
Raises:
    ArgumentError: There is no such option, it is given twice, or it cannot have this value.)";

inline constexpr char setProblem[] = R"(Sets the scene. solve reads it and does not change it.

Args:
    Configuration: The scene.
    q0: The start, as in setStartGoal.
    qT: The goal, as in setStartGoal.
Returns:
    This path finder.
Raises:
    ArgumentError: Only one of q0 and qT is passed, or one is not a joint vector.)";

inline constexpr char setStartGoal[] = R"(Sets the two ends of the path.

Args:
    starts: One joint vector, shape (n,) or (1, n), rad or m.
    goals: One joint vector, shape (n,) or (1, n), rad or m.
Returns:
    This path finder.
Raises:
    ArgumentError: One of them is not a single joint vector.)";

inline constexpr char setExplicitCollisionPairs[] = R"(Restricts collisions to these pairs of frames.

Args:
    collisionPairs: Names of frames, two per pair: a1 b1 a2 b2 ... An empty list restores the pairs of the scene.
Returns:
    This path finder.
Raises:
    FrameNotFound: A frame is not in the scene.
    ArgumentError: The number of names is odd.)";

inline constexpr char solve[] =
    R"(Searches a path. Equal seeds (rnd_seed) give equal paths. Ctrl-C ends the search.

Args:
    verbose: 0: silent; 1: logs a line; 2 and more: also shows the path and waits.
Returns:
    The outcome. x is the path, shape (K, n), start and goal included, configurations at most stepsize apart; feasible
    is True if there is one. Otherwise x is empty and message says why, as "the start collides: ...". evals is the
    number of iterations. A sliding joint without limits is sampled around start and goal, with a KinegraphWarning.
Raises:
    ArgumentError: There is no problem, or start and goal do not fit it.)";

inline constexpr char getResampledPath[] = R"(Returns configurations of the path, evenly spaced in its index.

Args:
    T: Number of configurations.
Returns:
    Shape (T, n), rad or m.
Raises:
    ArgumentError: There is no path, or T is less than 1.)";

inline constexpr char view[] = R"(Shows the path in the browser, with a time slider.

Args:
    pause: Waits for a key.
    message: A text in the corner.
    play: Plays the path at once.
Returns:
    The key, or 0.
Raises:
    ArgumentError: There is no path.)";

}  // namespace kinegraph::python::docs::path_finder
