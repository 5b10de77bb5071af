#pragma once

/// The manual of what bind_meshes.cpp binds.
namespace kinegraph::python::docs::meshes {

inline constexpr char setTensorShape[] = R"(Gives the frame a grid of numbers in a box. It is drawn as the box.

Args:
    data: Shape (nx, ny, nz).
    size: Extent of the box, shape (3,), m.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape.)";

inline constexpr char setSdf[] =
    R"(Gives the frame the solid where a grid of numbers is not positive. The viewer draws the box.

Args:
    data: Shape (nx, ny, nz): signed distances from the surface, m; collisions and distances interpolate them.
    size: Extent of the box that the grid fills, shape (3,), m.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape.)";

inline constexpr char setImplicitSurface[] =
    R"(Gives the frame the surface where a grid of numbers is zero, as a mesh. Normals point to larger values.

Args:
    data: Shape (nx, ny, nz).
    size: Extent of the box that the grid fills, shape (3,), m.
    blur: How often values are averaged with their neighbors first.
    resample: Size of the cells to interpolate to, m; not positive: the grid as it is.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape, or values that are nowhere zero.)";

inline constexpr char setMesh[] = R"(Gives the frame a mesh.

Args:
    vertices: Shape (n, 3), in the frame's coordinates, m.
    triangles: Shape (m, 3), indices of vertices.
    colors: In 0..255: (n, 3) or (n, 4), or one row for all; None: the frame's color.
    cvxParts: Index of the first vertex of each convex part, ascending; None: the mesh collides as its convex hull.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape, or an index that names no vertex.)";

inline constexpr char setMeshFile[] = R"(Gives the frame the mesh of a file.

Args:
    filename: Path of the file (h5, ply, stl, obj, dae, ...).
    scale: Factor on the coordinates, for files that are not in m.
Returns:
    The frame itself.
Raises:
    FileError: The file cannot be read.)";

inline constexpr char setTextureFile[] = R"(Covers the frame's shape with a picture.

Without coordinates the mesh's own count; on other shapes the picture covers every side of a box, a quad, or goes once
around z.

Args:
    image_filename: Path of a PNG or JPEG file.
    texCoords: Shape (n, 2): where each vertex of the mesh is in the picture, to the right and up, in 0..1.
Returns:
    The frame itself.
Raises:
    FileError: The file is missing or of another kind.
    ArgumentError: The frame has no shape, or texCoords have another size.)";

inline constexpr char setConvexMesh[] = R"(Gives the frame the convex hull of points.

Args:
    points: Shape (n, 3), in the frame's coordinates, m.
    colors: In 0..255, (n, 3), (n, 4) or one row; the hull has one color, their mean.
    radius: If positive, the hull is an ssCvx, swept by a ball of this radius, m; else it is a mesh.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape, or points that span no volume.)";

inline constexpr char setPointCloud[] = R"(Gives the frame a cloud of points.

Args:
    points: Shape (n, 3), or (h, w, 3) as depthImage2PointCloud gives them; in the frame's coordinates, m.
    colors: In 0..255: (n, 3) or (n, 4), an image (h, w, 3), or one row for all; None: the frame's color.
    normals: Not used; older scripts pass them.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape, or numbers that are not finite.)";

inline constexpr char setLines[] = R"(Gives the frame line segments.

Args:
    verts: Points, shape (n, 3), in the frame's coordinates, m, two per segment.
    colors: In 0..255: (n, 3) or (n, 4), or one row for all; None: the frame's color.
    singleConnectedLine: One line through all points instead.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another shape, or numbers that are not finite.)";

inline constexpr char setMeshAsLines[] = R"(Gives the frame line segments, from a flat list.

Args:
    lines: x y z of both ends in m, segment after segment: 6 numbers each.
Returns:
    The frame itself.
Raises:
    ArgumentError: Another size, or numbers that are not finite.)";

inline constexpr char convertDecomposedShapeToChildFrames[] =
    R"(Gives every convex part of the mesh (cvxParts, or what its triangles connect) to a child <name>_<i> as its convex
hull, with the color and contact flag. The frame loses its shape. Returns the frame itself.

Raises:
    ArgumentError: The frame has no mesh.)";

}  // namespace kinegraph::python::docs::meshes
