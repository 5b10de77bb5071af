"""Scenes with look-ups that tolerate missing frames, as scripts use them before adding frames."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

import kinegraph
from kinegraph import Frame, FrameNotFound, KinegraphWarning


class Config(kinegraph.Config):
    """Like kinegraph.Config, but an unknown frame gives a warning with similar names instead of an error."""

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

    def addFile(
        self, filename: Any, namePrefix: str | None = None, orphans: bool = True, **options: Any
    ) -> Frame | None:
        """Adds the frames of a file, as kinegraph.Config.addFile; a frame with an unknown parent has none, and a
        warning.

        Args:
            filename, namePrefix: As in kinegraph.Config.addFile.
            orphans: False: an unknown parent is an error.
            options: floating, strict and xacro, as in kinegraph.Config.addFile.
        Returns:
            The first added frame, or None if the file has none.
        Raises:
            FileError: The file cannot be read.
            ParseError: The file has an error; the message has the file, the line and the column.
        """
        return super().addFile(filename, namePrefix, orphans=orphans, **options)

    def addFrame(self, name: str, parent: Any = "", args: str = "") -> Frame:
        """Adds a frame, as kinegraph.Config.addFrame; with an unknown parent it has none, and a warning.

        Args:
            name, parent, args: As in kinegraph.Config.addFrame.
        Returns:
            The frame.
        Raises:
            ParseError: args has an error.
        """
        try:
            return super().addFrame(name, parent, args)
        except FrameNotFound as error:
            warnings.warn(f"{error}; '{name}' has no parent", KinegraphWarning, stacklevel=2)
            return super().addFrame(name, "", args)

    def delFrame(self, frame: Any) -> None:
        """Deletes a frame if it exists; warns otherwise.

        Args:
            frame: A Frame, or its name or id.
        """
        try:
            super().delFrame(frame)
        except FrameNotFound as error:
            warnings.warn(str(error), KinegraphWarning, stacklevel=2)

    def getFrameState(self, frames: Any = ()) -> Any:
        """Returns the poses of all frames, or of some, as in libry.

        Args:
            frames: Names, or one name, whose pose alone is returned; none: all frames.
        Returns:
            World poses x y z qw qx qy qz, shape (number of frames, 7), m; (7,) for one name.
        Raises:
            FrameNotFound: There is no such frame.
        """
        if isinstance(frames, str):
            return kinegraph.Config.getFrame(self, frames).getPose()
        names = list(frames)
        if not names:
            return super().getFrameState()
        return np.array([kinegraph.Config.getFrame(self, name).getPose() for name in names])

    def setFrameState(self, X: Any, frames: Sequence[str] = ()) -> None:
        """Sets the poses of frames, as kinegraph.Config.setFrameState, or those of all frames as in another scene.

        Args:
            X: World poses, shape (number of frames, 7), or a scene with the same frames, such as
                komo.getConfiguration(t), whose result was poses in libry.
            frames: Names; none: all frames.
        Raises:
            ArgumentError: X has another number of frames, or invalid quaternions.
        """
        if isinstance(X, kinegraph.Config):
            poses = X.getFrameState()[: self.getFrameDimension()]  # frames of mode switches come last
            X = np.array([X.getFrame(name).getPose() for name in frames]) if frames else poses
        super().setFrameState(X, frames)

    def simulation(self, engine: Any = kinegraph.SimulationEngine.physx, verbose: int = 2) -> Any:
        """Returns a simulation of this scene, like Simulation(C, engine, verbose), as in scripts for libry.

        Args:
            engine, verbose: As in Simulation.
        Returns:
            A Simulation.
        Raises:
            ArgumentError: The engine does not exist.
        """
        from .simulation import Simulation

        return Simulation(self, engine, verbose)

    def copy(self, other: kinegraph.Config | None = None) -> Any:
        """Returns an independent copy; with another scene, replaces this scene by a copy of that one.

        Args:
            other: Scene to copy into this one; None copies this scene.
        Returns:
            The copy, or None.
        """
        if other is not None:
            return super().copy(other)
        again = type(self).__new__(type(self))  # constructors of derived classes may take other arguments
        kinegraph.Config.__init__(again)
        again.__dict__.update(self.__dict__)
        kinegraph.Config.copy(again, self)
        return again

    def __copy__(self) -> Config:
        return self.copy()  # type: ignore[no-any-return]

    def __deepcopy__(self, memo: object) -> Config:
        return self.copy()  # type: ignore[no-any-return]
