"""Entries of the gallery: functions that return a scene; or a scene, a path and a duration, which is shown as a loop.

Each has a caption as its docstring and at most 40 lines. `VIEW` maps names to positions and targets of the camera.
"""
