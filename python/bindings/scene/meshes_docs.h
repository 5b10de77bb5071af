#pragma once

/// Docstrings for bind_meshes.cpp.
namespace kinegraph::python::docs::meshes {

inline constexpr char setTensorShape[] = R"(Gives the frame a grid of numbers in a box, and draws the box.

Args:
    data: Shape (nx, ny, nz).
    size: Extent of the box, shape (3,), m.
Returns:
    The frame itself.
Raises:
    ArgumentError: data or size has another shape.)";

inline constexpr char setSdf[] =
    R"(Gives the frame the solid of a grid's non-positive values. The viewer draws the box.

Args:
    data: Shape (nx, ny, nz): signed distances from the surface, m; collision checks interpolate them.
    size: Extent of the box that the grid fills, shape (3,), m.
Returns:
    The frame itself.
Raises:
    ArgumentError: data or size has another shape.)";

inline constexpr char setImplicitSurface[] =
    R"(Gives the frame the zero level set of a grid of numbers, as a mesh. Normals point to larger values.

Args:
    data: Shape (nx, ny, nz).
    size: Extent of the box that the grid fills, shape (3,), m.
    blur: Number of times that values are averaged with their neighbors first.
    resample: Size of the cells to resample to, m; not applied unless positive.
Returns:
    The frame itself.
Raises:
    ArgumentError: data or size has another shape, or the values never cross zero.)";

inline constexpr char setMesh[] = R"(Gives the frame a mesh.

Args:
    vertices: Shape (n, 3), in the frame's coordinates, m.
    triangles: Shape (m, 3), indices of vertices.
    colors: In 0..255: (n, 3) or (n, 4), or one color for all; None: the frame's color.
    cvxParts: Index of the first vertex of each convex part, ascending; None: the mesh collides as its convex hull.
Returns:
    The frame itself.
Raises:
    ArgumentError: An argument has another shape, or an index refers to no vertex.)";

inline constexpr char setMeshFile[] = R"(Gives the frame the mesh of a file.

Args:
    filename: Path of the file (h5, ply, stl, obj, dae, ...).
    scale: Factor on the coordinates, for files with other units than m.
Returns:
    The frame itself.
Raises:
    FileError: The file cannot be read.)";

inline constexpr char setTextureFile[] = R"(Covers the frame's shape with a picture.

Without texCoords, a mesh uses its own coordinates; on other shapes the picture covers every side of a box, a quad, or
wraps once around z.

Args:
    image_filename: Path of a PNG or JPEG file.
    texCoords: Shape (n, 2): position of each vertex of the mesh in the picture, to the right and up, in 0..1.
Returns:
    The frame itself.
Raises:
    FileError: The file is missing or has another format.
    ArgumentError: The frame has no shape, or texCoords have another size.)";

inline constexpr char setConvexMesh[] = R"(Gives the frame the convex hull of points.

Args:
    points: Shape (n, 3), in the frame's coordinates, m.
    colors: In 0..255, (n, 3), (n, 4) or one color; the hull gets their mean.
    radius: If positive, the hull is an ssCvx, swept by a ball of this radius, m; otherwise a mesh.
Returns:
    The frame itself.
Raises:
    ArgumentError: An argument has another shape, or the points span no volume.)";

inline constexpr char setPointCloud[] = R"(Gives the frame a cloud of points.

Args:
    points: Shape (n, 3), or (h, w, 3) as returned by depthImage2PointCloud; in the frame's coordinates, m.
    colors: In 0..255: (n, 3) or (n, 4), an image (h, w, 3), or one color for all; None: the frame's color.
    normals: Not used; accepted for older scripts.
Returns:
    The frame itself.
Raises:
    ArgumentError: An argument has another shape, or non-finite numbers.)";

inline constexpr char setLines[] = R"(Gives the frame line segments.

Args:
    verts: Points, shape (n, 3), in the frame's coordinates, m, two per segment.
    colors: In 0..255: (n, 3) or (n, 4), or one color for all; None: the frame's color.
    singleConnectedLine: Draws one line through all points instead.
Returns:
    The frame itself.
Raises:
    ArgumentError: An argument has another shape, or non-finite numbers.)";

inline constexpr char setMeshAsLines[] = R"(Gives the frame line segments, from a flat list.

Args:
    lines: x y z of both ends in m, segment after segment: 6 numbers each.
Returns:
    The frame itself.
Raises:
    ArgumentError: lines has another size, or non-finite numbers.)";

inline constexpr char convertDecomposedShapeToChildFrames[] =
    R"(Moves every convex part of the mesh to a child <name>_<i> as its convex hull, with the color and contact flag.

The parts are cvxParts, or the connected components of the triangles. The frame loses its shape. Returns the frame
itself.

Raises:
    ArgumentError: The frame has no mesh.)";

}  // namespace kinegraph::python::docs::meshes
