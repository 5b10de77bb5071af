"""The attributes of frames in the .g language."""

from .scene_bodies import BODIES, CAMERAS, MOTORS, STORED, TASKS
from .scene_shapes import JOINTS, POSES, SHAPES

SECTIONS = {
    "Poses": ("A pose is 7, 3 or 4 numbers, or a sequence of steps, see [Scenes](../scenes.md#poses).", POSES),
    "Joints": ("", JOINTS),
    "Shapes and contacts": ("", SHAPES),
    "Masses and contacts in simulations": ("", BODIES),
    "Motors and joints in simulations": ("", MOTORS),
    "Cameras": ("A frame with one of these attributes, or with the shape `camera`, is a camera.", CAMERAS),
    "Tasks": ("", TASKS),
    "Stored": ("These words are kept with the frame and have no effect of their own.", STORED),
}
