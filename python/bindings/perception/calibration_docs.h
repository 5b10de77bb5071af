#pragma once

/// Docstrings for the calibration and the next view in bind_perception.cpp.
namespace kinegraph::python::docs::calibration {

inline constexpr char calibrateCamera[] =
    R"(Finds the poses of a camera and a marker relative to their parents, and moves both frames there.

One of them is carried by the robot, the other one is fixed: a camera on the hand and a marker on the table, or a camera
beside the robot and a marker in the hand. Their present poses do not matter if the points lie in the plane z = 0 of the
marker; otherwise they are the start. Errors of the joint angles are part of the model, and so of the covariance.
Warnings of the result are also given as Python warnings.

Args:
    config: The scene. Both frames are moved relative to their parents.
    camera: The frame of the camera, which looks along z, x to the right and y down.
    marker: The frame of the marker.
    points: Points of the marker in its frame, such as four corners, shape (n, 3), m.
    fxycxy: fx, fy, cx, cy in pixels, shape (4,).
    q: Joint angles at which the images were taken, shape (K, dofs). At least 3 images, better 10.
    pixels: Column and row of each point in each image, shape (K, n, 2). The middle of the first pixel is (.5, .5): add
        .5 to what OpenCV returns. NaN: not seen.
    pixel_noise: Standard deviation of a coordinate in an image, pixels.
    joint_noise: Standard deviation of a joint angle (rad) or slide (m), independent in each image.
Returns:
    A CameraCalibration.
Raises:
    FrameNotFound: A frame is unknown.
    ArgumentError: An array has a wrong size, lengths look like millimeters, or no joint moves the camera relative to
        the marker; the scene is then unchanged.)";

inline constexpr char nextView[] = R"(Finds a view that answers the question of a plan.

The question is whether the unseen cells that prevent the motion (plan.blockedByUnseen) are free. Eyes are tried in
directions and at distances around these cells, in the order of the number of cells that neither occupied cells nor
shapes of the scene hide. The first ones with a configuration and a
collision-free motion to it are compared, with the image of the camera and the robot itself in the way. Deterministic.

Args:
    config: The scene, with the map attached, so that the motion leads through free space only.
    map: The OccupancyMap.
    camera: The frame of a camera on the robot, with the attributes focalLength, width and height.
    plan: A MotionPlan that is blocked by unseen cells.
    nearest: Smallest distance of the camera from the middle of the cells, m.
    farthest: Largest one, m.
    margin: Distance that the configuration and the motion keep, m.
Returns:
    A NextView. If there is none, `feasible` is False and `message` says why.
Raises:
    FrameNotFound: The camera is unknown.
    ArgumentError: The plan is not blocked by unseen cells, no joint moves the camera, or a number is invalid.)";

}  // namespace kinegraph::python::docs::calibration
