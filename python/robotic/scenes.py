"""Scenes with look-ups that tolerate missing frames, as scripts use them before adding frames."""

from __future__ import annotations

import warnings
from typing import Any

import kinegraph
from kinegraph import Frame, FrameNotFound, KinegraphWarning


class Config(kinegraph.Config):
    """Like kinegraph.Config, but an unknown frame gives None and a warning with similar names instead of an error."""

    def getFrame(self, frameName: str, warnIfNotExist: bool = True) -> Frame:
        """Returns the first frame with a name.

        Args:
            frameName: The name.
            warnIfNotExist: Whether to warn if the frame does not exist.
        Returns:
            The frame, or None.
        """
        try:
            return super().getFrame(frameName)
        except FrameNotFound as error:
            if warnIfNotExist:
                warnings.warn(str(error), KinegraphWarning, stacklevel=2)
            return None  # type: ignore[return-value]  # kinegraph.Config declares a Frame

    def delFrame(self, frame: Any) -> None:
        """Deletes a frame if it exists; warns otherwise.

        Args:
            frame: A Frame, or its name or id.
        """
        try:
            super().delFrame(frame)
        except FrameNotFound as error:
            warnings.warn(str(error), KinegraphWarning, stacklevel=2)

    def copy(self, other: kinegraph.Config | None = None) -> Any:
        """Returns an independent copy; with another scene, replaces this scene by a copy of that one.

        Args:
            other: Scene to copy into this one; None copies this scene.
        Returns:
            The copy, or None.
        """
        if other is not None:
            return super().copy(other)
        again = type(self)()
        kinegraph.Config.copy(again, self)
        return again

    def __copy__(self) -> Config:
        return self.copy()  # type: ignore[no-any-return]

    def __deepcopy__(self, memo: object) -> Config:
        return self.copy()  # type: ignore[no-any-return]
