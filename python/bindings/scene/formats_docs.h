#pragma once

/// The manual of what bind_formats.cpp binds.
namespace kinegraph::python::docs::formats {

inline constexpr char writeMesh[] = R"(Writes all surfaces as one PLY file, in world coordinates, m.

Args:
    filename: Path of the file.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char writeMeshes[] = R"(Writes every mesh once as a PLY file, in the coordinates of its frame, m.

Args:
    pathPrefix: The files are <pathPrefix><frame>.ply.
    copyTextures: Not used: PLY files hold no pictures.
    enumerateAssets: The files are <pathPrefix>mesh_0.ply and so on instead.
Returns:
    The paths of the files.
Raises:
    FileError: A file cannot be written.)";

inline constexpr char writeConvexStls[] =
    R"(Writes the convex hull of every mesh as an STL file, in the coordinates of its frame, m.

Args:
    pathPrefix: The files are <pathPrefix><frame>.stl.
    shrinkRadius: How far the hulls are drawn in, m; not positive: not at all.
    verbose: Not used; older scripts pass it.
Returns:
    The paths of the files.
Raises:
    FileError: A file cannot be written.)";

inline constexpr char writeCollada[] = R"(Writes the tree of frames with poses, surfaces and colors as a COLLADA file.

Args:
    filename: Path of the file, .dae.
    format: "collada".
Raises:
    ArgumentError: Another format.
    FileError: The file cannot be written.)";

inline constexpr char writeGltf[] =
    R"(Writes the scene at the present q as binary glTF: a node per frame, with the surface and the colors that are shown
for it, y up as glTF has it.

Args:
    filename: Path of the file, .glb.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char addDict[] = R"doc(Adds frames given as a dict.

Args:
    dict: {"name (parent)" : {attribute : value, ...},
                      ...
}, with the attributes of a .g file.
Returns:
    The first frame, or None.
Raises:
    ParseError: A mistake in the entries.
    ArgumentError: A value that is neither bool, number, text, list nor dict.)doc";

inline constexpr char asDict[] = R"doc(The scene as {"name(parent)": {attribute: value, ...}, ...
}
, in the order of the frames; addDict reads it.)doc";

inline constexpr char asYaml[] = R"(The scene as text that is YAML and .g at once.

Args:
    serial: On one line.
Returns:
    The text.)";

inline constexpr char write[] = R"(The scene as .g text, with all digits.

Args:
    filename: Where it is written as well: as URDF for .urdf, as MJCF for .xml, as YAML for .yml and .yaml, else as
        .g.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char writeURDF[] = R"(The scene as URDF text. What URDF cannot say is a warning.

Args:
    filename: Where it is written as well. Shapes that URDF has no element for go into .stl files in a folder beside
        it; without a file they are left out with a warning. Links that do not collide, groups of joints and named
        states go into an .srdf file of the same name (asSRDF). Joints that are no part of q are fixed.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char asSRDF[] =
    R"(What the text of writeURDF has no words for, as SRDF text: links that do not collide, groups of joints, named states.

Returns:
    The text; '' if there is nothing to say.)";

inline constexpr char writeMJCF[] =
    R"(Writes the scene as MJCF, which MuJoCo loads with the same poses. Bodies, joints, geoms and sites have the names of
their frames.

Args:
    filename: Path of the file. Meshes that MuJoCo cannot read as they are go into a folder beside it.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

}  // namespace kinegraph::python::docs::formats
