#pragma once

/// Docstrings for bind_perception.cpp.
namespace kinegraph::python::docs::perception {

inline constexpr char makeView[] = R"(Creates a depth image with the camera that took it.

The camera looks along z, x to the right and y down. A pixel with depth d shows the point Z = d,
X = (column + .5 - cx) d / fx, Y = (row + .5 - cy) d / fy.

Args:
    depth: Depths along the camera's z axis, shape (height, width). Zero, negative and non-finite numbers, depths
        above 50 m and the largest number of an integer type are pixels without a measurement.
    fxycxy: fx, fy, cx, cy in pixels, shape (4,).
    camera: The camera: the name of its frame in the scene, or its pose in the world, shape (7,).
    unit: Meters per unit of `depth`; None: .001 for integers, 1 for floats.
    noise: Standard deviation of the depth of a pixel, divided by its squared depth, 1/m.
    bias: The same for an error that all pixels of an object share, 1/m.
Raises:
    ArgumentError: The depth has not two dimensions, fxycxy does not fit the image or is that of the transposed one,
        depths look like millimeters, or a number is invalid.)";

inline constexpr char registerScene[] = R"(Moves frames to where depth images show them.

Each frame starts at its present pose. A robust fit minimizes the distances of measured points from the exact surfaces
that face the camera. A thing on a support has x, y and the rotation about z as variables, a frame with a hinge or slide
its dof, all others six directions. Measurements of the robot and other shapes of the scene are left out, and a point
belongs to one thing only. Each of several things that look alike is taken to be the one that had to move least, in sum;
`may_be` and a warning name those that may be confused. Frames that are not seen keep their poses. The shape of a frame
has those of frames that are fixed to it. Warnings of the result are also given as Python warnings.

Args:
    config: The scene. Frames that are seen are moved.
    views: A DepthView, or a list of them. The scene must have the joint angles at which they were taken.
    frames: The names of the frames to look for.
    support: The frame on whose top the things rest, or on level boxes below it, such as a tray, or on what
        they stood on in their last pose; None: they may be anywhere. Frames with a joint of their own and frames in a
        hand never rest.
    search_radius: How far a thing may have moved since its last pose, m.
    prior: "last": things are near their last poses. "anywhere": they rest anywhere on the support, on any stable face.
        Frames with a joint are then looked for within its limits, frames in a hand near their last poses.
    estimate: What is corrected along with the things, by the points on all shapes, also those of the robot. "camera":
        the poses of the cameras, relative to their parents; expected are 2 cm and .03 rad. "joints": offsets of all
        active hinges and slides that are not of `frames`; expected are .01 rad and 5 mm. The scene gets the corrected
        cameras and angles; `cameras`, `joint_offsets` and their covariances are in the result.
Returns:
    A SeenScene with a SeenFrame for each frame.
Raises:
    FrameNotFound: A frame, a camera or the support is unknown.
    ArgumentError: There is no view, a view is invalid, or a frame is listed twice or has no visible shape. `prior` or
        `estimate` has another word, `prior` is "anywhere" without a support, or there is no joint to estimate.)";

inline constexpr char setCells[] = R"(Gives the frame the solid ones among equal cubes that fill a box, as an obstacle.

Collision checks use the exact distance from the cubes, and lower bounds of it that are computed once per cell.

Args:
    data: Shape (nx, ny, nz), one value per cube: 0 is free, 1 occupied, 2 not seen by any camera. The last two are
        solid, and have different colors in the viewer.
    size: Extent of the box, shape (3,), m; the cells must be cubes.
Returns:
    The frame itself.
Raises:
    ArgumentError: data or size has another shape, data has other values, or the cells are not cubes.)";

inline constexpr char occupancyMap[] = R"(A map of the space that depth images show: equal cubes in a box of the world.

    map = ry.OccupancyMap(C, region=[[-0.5, -0.1, 0.65], [0.5, 0.8, 1.25]], cell=0.01)
    map.update(C, views)
    map.attach(C)  # now ry.planMotion(C, ...) avoids occupied and unseen cells

Points of the robot and of all shapes of the scene are left out: the shapes themselves are the obstacles. A cell is free
if a camera looked through the whole of it, occupied if points were measured in it. The last such image counts: cells of
a thing that moved away become free once a camera sees the background.)";

inline constexpr char makeMap[] = R"(Creates a map of which nothing was seen.

Args:
    config: The scene. Cells that its shapes touch, and those within 5 mm of the robot, are free.
    region: Two corners of the box in the world, shape (2, 3), m. It is enlarged to whole cells. Space outside of it is
        free.
    cell: The side of a cell, m.
    free: Names of frames in whose shapes all cells are free at first.
Raises:
    FrameNotFound: A frame is unknown.
    ArgumentError: The region is empty, has more than 50 million cells, or a free frame has no shape.)";

inline constexpr char updateMap[] = R"(Adds depth images.

Args:
    config: The scene, with the joint angles and the poses of things at which the images were taken.
    views: A DepthView, or a list of them.
    known: The result of registerScene. Frames that were not seen count as unknown: their points occupy cells.
Returns:
    Warnings, which are also given as Python warnings: images without depth, images that show nothing of the region, and
    doubtful poses of cameras.
Raises:
    FrameNotFound: A camera is unknown.
    ArgumentError: A view is invalid; the map is then unchanged.)";

inline constexpr char attachMap[] = R"(Makes the map an obstacle of the scene.

The frame `name` gets the shape of the cells that block motions, with contact. It is added if it does not exist. The
scene keeps these cells until the next call: call it again after an update. Nothing floats: a group of hidden cells does
not block if it touches no occupied cell, no shape of the scene on which things rest, and no other cell that blocks.

Args:
    config: The scene.
    unseen: "blocked": all cells that were not seen free block. "shadows": of the unseen cells, those behind something
        that was measured block. "free": only occupied cells block.
    name: The name of the frame.
Raises:
    ArgumentError: `unseen` is another word, or the frame exists with another shape.)";

inline constexpr char sceneObserver[] =
    R"(Looks with cameras: sees where the things of a scene are, and keeps a map of all else.

    map = ry.OccupancyMap(C, region=[[-0.5, 0, 0.66], [0.5, 0.7, 1.1]], cell=0.02)
    observer = ry.SceneObserver(take, ["cup"], support="table", map=map)
    observer.observe(C)
    run = ry.planTask(C, goal).execute(bot, observe=observer)

During an execution, the robot looks before and after each motion and grip. It stops before a motion that would enter
cells of the map, and new plans avoid them.)";

inline constexpr char makeObserver[] = R"(Creates an observer.

Args:
    take: A function without arguments that returns depth images of this moment: a DepthView, or a list of them.
    frames: The things that registerScene looks for.
    support: As for registerScene.
    search_radius: As for registerScene, m.
    prior: As for registerScene: "last", or "anywhere" for things with unknown places. Once one was seen, they are
        looked for near their last poses, and anywhere else if they are not there.
    map: An OccupancyMap that is updated and attached; None: no map.
    unseen: "blocked", "shadows" or "free", as for OccupancyMap.attach.
Raises:
    ArgumentError: `unseen` or `prior` is another word, "anywhere" without a support, or the radius is invalid.)";

inline constexpr char observe[] =
    R"(Takes images, moves the things to where they are seen, and attaches the updated map.

Args:
    config: The scene, with the joint angles of this moment, and with objects in hands attached to these. Held objects
        are not looked for.
Returns:
    For each of the frames its pose in the world, shape (7,), or None if it was not seen.
Raises:
    FrameNotFound: A frame or camera is unknown.
    ArgumentError: A view is invalid, or a frame has no visible shape.)";

inline constexpr char stateAt[] = R"(Returns whether places are free, occupied, hidden or unseen.

Args:
    points: A point in the world, shape (3,), m, or several, shape (n, 3). Space outside of the region is free.
Returns:
    The CellState of the point, or a list of them.
Raises:
    ArgumentError: points has another shape.)";

}  // namespace kinegraph::python::docs::perception
