"""Scenes that are asked for frames which may not be there, as scripts do before they add them."""

from __future__ import annotations

import warnings
from typing import Any

import kinegraph
from kinegraph import Frame, FrameNotFound, KinegraphWarning


class Config(kinegraph.Config):
    """As kinegraph.Config. A frame that is not there is None, with a warning that names similar ones, and not an error."""

    def getFrame(self, frameName: str, warnIfNotExist: bool = True) -> Frame:
        """The first frame of that name.

        Args:
            frameName: Its name.
            warnIfNotExist: Whether to warn if there is none.
        Returns:
            The frame, or None.
        """
        try:
            return super().getFrame(frameName)
        except FrameNotFound as error:
            if warnIfNotExist:
                warnings.warn(str(error), KinegraphWarning, stacklevel=2)
            return None  # type: ignore[return-value]  # as kinegraph.Config declares it

    def delFrame(self, frame: Any) -> None:
        """Deletes a frame, if it is there.

        Args:
            frame: A Frame, or its name or id.
        """
        try:
            super().delFrame(frame)
        except FrameNotFound as error:
            warnings.warn(str(error), KinegraphWarning, stacklevel=2)

    def copy(self, other: kinegraph.Config | None = None) -> Any:
        """A copy that shares nothing that can be changed; with another scene, becomes a copy of that one.

        Args:
            other: What to become; None: this scene is copied.
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
