"""Helper scripts of the reference; their functions are part of the package here."""

raise ImportError(
    "robotic.tools: the reference's helper scripts are not included; instead: "
    "C.addFile reads .urdf, .xml (MJCF) and .yml, C.write, C.asYaml, C.writeURDF and C.writeMJCF "
    "write, Frame.setMeshFile reads meshes, also .h5"
)
