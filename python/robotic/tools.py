"""Helper scripts of the reference; what they do is part of the package here."""

raise ImportError(
    "robotic.tools: the reference's helper scripts are not there; instead: C.addFile reads .urdf, .xml (MJCF) and .yml, "
    "C.write, C.asYaml, C.writeURDF and C.writeMJCF write, Frame.setMeshFile reads meshes, also .h5"
)
