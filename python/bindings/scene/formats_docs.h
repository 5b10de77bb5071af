#pragma once

/// Docstrings for bind_formats.cpp.
namespace kinegraph::python::docs::formats {

inline constexpr char writeMesh[] = R"(Writes all surfaces to one mesh file, in world coordinates, m.

Args:
    filename: Path of the file; the suffix is .ply or .obj, with colors, or .stl.
Raises:
    ArgumentError: Another suffix, or a scene without surfaces.
    FileError: The file cannot be written.)";

inline constexpr char writeMeshes[] = R"(Writes every mesh once as a PLY file, in the coordinates of its frame, m.

Args:
    pathPrefix: Prefix of the files <pathPrefix><frame>.ply.
    copyTextures: Not used: PLY files contain no pictures.
    enumerateAssets: Names the files <pathPrefix>mesh_0.ply and so on instead.
Returns:
    The paths of the files.
Raises:
    FileError: A file cannot be written.)";

inline constexpr char writeConvexStls[] =
    R"(Writes the convex hull of every mesh as an STL file, in the coordinates of its frame, m.

Args:
    pathPrefix: Prefix of the files <pathPrefix><frame>.stl.
    shrinkRadius: Distance by which the hulls shrink, m; not applied unless positive.
    verbose: Not used; accepted for older scripts.
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
    R"(Writes the scene at the current q as binary glTF: one node per frame, with its visible surface and colors, y up.

Args:
    filename: Path of the file, .glb.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char addDict[] = R"doc(Adds frames from a dict.

Args:
    dict: {"name (parent)" : {attribute : value, ...},
                      ...
}, with the attributes of a .g file.
Returns:
    The first frame, or None.
Raises:
    ParseError: An entry is invalid.
    ArgumentError: A value is neither bool, number, text, list nor dict.)doc";

inline constexpr char asDict[] = R"doc(Returns the scene as {"name(parent)": {attribute: value, ...}, ...
}
, in the order of the frames; addDict reads it.)doc";

inline constexpr char asYaml[] = R"(Returns the scene as text that is valid YAML and .g.

Args:
    serial: Writes a single line.
Returns:
    The text.)";

inline constexpr char write[] = R"(Returns the scene as .g text with exact numbers, and optionally writes it to a file.

Args:
    filename: Path of the file. The extension selects URDF (.urdf), MJCF (.xml), YAML (.yml, .yaml), else .g. None: no
        file.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char writeURDF[] = R"(Returns the scene as URDF text, and warns of content without a URDF equivalent.

Args:
    filename: Path of a file to write, too. Shapes without a URDF element go to .stl files in a folder beside it;
        without a file they are omitted with a warning. Disabled collision pairs, groups of joints and named states go
        to an .srdf file of the same name (asSRDF). Hands move by their joint and
        those that mimic it; other joints outside of q are fixed.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

inline constexpr char asSRDF[] =
    R"(Returns the SRDF text for the text of writeURDF: disabled collision pairs, groups of joints, named states.

Returns:
    The text; '' if it would be empty.)";

inline constexpr char asMJCF[] =
    R"(Returns the scene as MJCF text with inline meshes; MuJoCo loads it with the same poses.

Args:
    motors: As for writeMJCF.
Returns:
    The text.)";

inline constexpr char writeMJCF[] =
    R"(Writes the scene as MJCF; MuJoCo loads it with the same poses.

Bodies, joints, geoms and sites have the names of their frames.

Args:
    filename: Path of the file. Meshes that MuJoCo cannot read directly go to a folder beside it.
    motors: Adds actuators with the gains and force limits of the simulation, hands that open and close, free joints of
        objects with a mass, and options for contacts. An actuator has the name of its joint. Its ctrl is q + v kv / kp
        for a reference q with velocity v; that of a hand is the position of its joint, m or rad.
Returns:
    The text.
Raises:
    FileError: The file cannot be written.)";

}  // namespace kinegraph::python::docs::formats
