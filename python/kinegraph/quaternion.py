"""Rotations as unit quaternions (w, x, y, z)."""

from __future__ import annotations

import numpy as np
import numpy.typing as npt

from ._core import Config
from .errors import ArgumentError

Numbers = npt.ArrayLike
Array = npt.NDArray[np.float64]


def _asNumbers(values: Numbers, subject: str, shape: str) -> Array:
    try:
        return np.asarray(values, np.float64)
    except (TypeError, ValueError):
        raise ArgumentError(f"{subject} {values!r}; expected numbers, shape {shape}") from None


def _numbers(values: Numbers, shape: tuple[int, ...], what: str) -> Array:
    array = _asNumbers(values, f"{what} is", str(shape))
    if array.size != np.prod(shape) or (array.ndim == 2 and 1 not in array.shape and array.shape != shape):
        raise ArgumentError(f"{what} has shape {array.shape}; expected {shape}")
    return array.reshape(shape)


def _rotation(value: object, what: str) -> Quaternion:
    if isinstance(value, Quaternion):
        return value
    raise ArgumentError(f"{what} is {value!r}; expected a Quaternion, as of Quaternion([1, 0, 0, 0])")


class Quaternion:
    """A rotation as a quaternion w x y z. Setters modify it and return it, so that calls can be chained.

    q1 * q2 rotates by q2 first; -q is the inverse.

    Args:
        wxyz: Four numbers; the default is the identity.
    Raises:
        ArgumentError: Not four numbers.
    """

    def __init__(self, wxyz: Numbers = (1.0, 0.0, 0.0, 0.0)) -> None:
        """Creates a quaternion of four numbers.

        Args:
            wxyz: Shape (4,): w x y z, of any length; as a rotation, only the direction matters.
        Raises:
            ArgumentError: The shape is wrong.
        """
        self._q = _numbers(wxyz, (4,), "a quaternion").copy()

    def __repr__(self) -> str:
        return f"Quaternion([{', '.join(f'{x:.6g}' for x in self._q)}])"

    def __eq__(self, other: object) -> bool:
        return isinstance(other, Quaternion) and bool(np.array_equal(self._q, other._q))

    __hash__ = None  # type: ignore[assignment]  # it is mutable

    def __mul__(self, other: Quaternion) -> Quaternion:
        if not isinstance(other, Quaternion):
            return NotImplemented
        w, v = self._q[0], self._q[1:]
        a, b = other._q[0], other._q[1:]
        return Quaternion([w * a - v @ b, *(w * b + a * v + np.cross(v, b))])

    def __neg__(self) -> Quaternion:
        return Quaternion(self._q * [1, -1, -1, -1])

    def set(self, q: Numbers) -> Quaternion:
        """Sets the four numbers, without normalization.

        Args:
            q: w x y z, shape (4,).
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not four numbers.
        """
        self._q = _numbers(q, (4,), "a quaternion").copy()
        return self

    def setZero(self) -> Quaternion:
        """Sets the identity. Returns the quaternion itself."""
        return self.set([1.0, 0.0, 0.0, 0.0])

    def setRad(self, radians: float, axis: Numbers = (1.0, 0.0, 0.0)) -> Quaternion:
        """Sets a rotation about an axis.

        Args:
            radians: Angle, rad.
            axis: Shape (3,), of any nonzero length.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not three numbers, or all of them 0.
        """
        direction = _numbers(axis, (3,), "the axis")
        length = np.linalg.norm(direction)
        if not length > 0:
            raise ArgumentError("setRad: the axis has length 0")
        return self.set([np.cos(0.5 * radians), *(np.sin(0.5 * radians) * direction / length)])

    def setExp(self, vector_w: Numbers) -> Quaternion:
        """Sets the rotation about a vector by its length.

        Args:
            vector_w: Shape (3,), rad.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not three numbers.
        """
        v = _numbers(vector_w, (3,), "the rotation vector")
        angle = float(np.linalg.norm(v))
        return self.setRad(angle, v) if angle > 0 else self.setZero()

    def setEuler(self, euler_zxz: Numbers) -> Quaternion:
        """Sets Rz(a) Rx(b) Rz(c) from three angles.

        Args:
            euler_zxz: a, b, c, shape (3,), rad.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not three numbers.
        """
        a, b, c = _numbers(euler_zxz, (3,), "the angles")
        return self.set((_axisRotation(2, a) * _axisRotation(0, b) * _axisRotation(2, c))._q)

    def setRollPitchYaw(self, roll_pitch_yaw: Numbers, reverse: bool = False) -> Quaternion:
        """Sets Rx(roll) Ry(pitch) Rz(yaw).

        Args:
            roll_pitch_yaw: Roll, pitch and yaw, shape (3,), rad.
            reverse: Use Rz(yaw) Ry(pitch) Rx(roll) instead.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not three numbers.
        """
        rotations = [
            _axisRotation(axis, angle)
            for axis, angle in enumerate(_numbers(roll_pitch_yaw, (3,), "roll, pitch and yaw"))
        ]
        a, b, c = reversed(rotations) if reverse else rotations
        return self.set((a * b * c)._q)

    def setMatrix(self, R: Numbers) -> Quaternion:
        """Sets the rotation of a matrix.

        Args:
            R: Shape (3, 3).
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: The matrix is not a rotation.
        """
        m = _numbers(R, (3, 3), "the matrix").ravel()
        if (
            not np.allclose(m.reshape(3, 3) @ m.reshape(3, 3).T, np.eye(3), atol=1e-3)
            or np.linalg.det(m.reshape(3, 3)) < 0
        ):
            raise ArgumentError("setMatrix: the matrix is not a rotation (columns orthogonal, length 1, right-handed)")
        squares = 1 + np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]]) @ m[[0, 4, 8]]
        largest = int(np.argmax(squares))
        products = np.array(
            [
                [squares[0], m[7] - m[5], m[2] - m[6], m[3] - m[1]],
                [m[7] - m[5], squares[1], m[1] + m[3], m[2] + m[6]],
                [m[2] - m[6], m[1] + m[3], squares[2], m[5] + m[7]],
                [m[3] - m[1], m[2] + m[6], m[5] + m[7], squares[3]],
            ]
        )  # 4 times the products of all pairs of entries
        return self.set(products[largest] / (2 * np.sqrt(squares[largest]))).normalize()

    def setDiff(self, start: Numbers, end: Numbers) -> Quaternion:
        """Sets the shortest rotation between two directions; for opposite ones, about a perpendicular axis.

        Args:
            start: Shape (3,), of any nonzero length.
            end: Shape (3,), of any nonzero length.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: Not three numbers each, or all of them 0.
        """
        a, b = _numbers(start, (3,), "the first vector"), _numbers(end, (3,), "the second vector")
        lengths = np.linalg.norm(a) * np.linalg.norm(b)
        if not lengths > 0:
            raise ArgumentError("setDiff: a vector of length 0 has no direction")
        a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
        if a @ b < -1 + 1e-12:
            across = np.cross(a, np.eye(3)[1 if abs(a[1]) < 0.9 else 0])
            return self.setRad(np.pi, across)
        return self.set([1 + a @ b, *np.cross(a, b)]).normalize()

    def setRandom(self) -> Quaternion:
        """Sets a uniformly random rotation; ry.rnd_seed seeds it. Returns the quaternion itself."""
        scene = Config()
        scene.addFrame("world")
        scene.addFrame("ball", "world", "joint: quatBall, sampleUniform: 1, limits: [-1 -1 -1 -1 1 1 1 1]")
        scene.setRandom()
        return self.set(scene.getJointState()).normalize()

    def setInterpolateProper(self, t: float, start: Quaternion, end: Quaternion) -> Quaternion:
        """Interpolates between two rotations at constant angular velocity, along the shorter arc (slerp).

        Args:
            t: Interpolation parameter, 0 .. 1.
            start: Rotation at t = 0.
            end: Rotation at t = 1.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: start or end is not a Quaternion.
        """
        between = -_rotation(start, "the start") * _rotation(end, "the end")
        if between._q[0] < 0:
            between.flipSign()
        return self.set((start * Quaternion().setExp(t * between.getLog()))._q)

    def setInterpolateEmbedded(self, t: float, start: Quaternion, end: Quaternion) -> Quaternion:
        """Interpolates linearly between the four numbers of two rotations, and normalizes the result.

        Args:
            t: Interpolation parameter, 0 .. 1.
            start: Rotation at t = 0.
            end: Rotation at t = 1.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: start or end is not a Quaternion.
        """
        sign = 1.0 if _rotation(start, "the start")._q @ _rotation(end, "the end")._q >= 0 else -1.0
        return self.set((1 - t) * start._q + t * sign * end._q).normalize()

    def append(self, q: Quaternion) -> Quaternion:
        """Sets self * q.

        Args:
            q: The rotation that is applied first.
        Returns:
            The quaternion itself.
        Raises:
            ArgumentError: q is not a Quaternion.
        """
        return self.set((self * _rotation(q, "q"))._q)

    def invert(self) -> Quaternion:
        """Inverts the rotation. Returns the quaternion itself."""
        return self.set((-self)._q)

    def flipSign(self) -> Quaternion:
        """Negates the four numbers, which represent the same rotation. Returns the quaternion itself."""
        return self.set(-self._q)

    def normalize(self) -> Quaternion:
        """Scales the numbers to length 1. Returns the quaternion itself.

        Raises:
            ArgumentError: All numbers are 0.
        """
        length = np.linalg.norm(self._q)
        if not length > 0:
            raise ArgumentError("normalize: the quaternion is zero; expected w x y z of a rotation, e.g. 1 0 0 0")
        return self.set(self._q / length)

    def multiply(self, f: float) -> None:
        """Scales the angle.

        Args:
            f: Factor of the angle.
        """
        self.setExp(f * self.getLog())

    def applyOnPointArray(self, pts: Numbers) -> Array:
        """Rotates points.

        Args:
            pts: Shape (n, 3).
        Returns:
            The rotated points, shape (n, 3).
        Raises:
            ArgumentError: The shape is wrong.
        """
        array = _asNumbers(pts, "the points are", "(n, 3)")
        if array.ndim != 2 or array.shape[1] != 3:
            raise ArgumentError(f"applyOnPointArray: points have shape {array.shape}; expected (n, 3)")
        rotated: Array = array @ self.getMatrix().T
        return rotated

    def asArr(self) -> Array:
        """Returns w x y z, shape (4,)."""
        return self._q.copy()

    def getArr(self) -> Array:
        """Returns w x y z, shape (4,), like asArr."""
        return self.asArr()

    def getMatrix(self) -> Array:
        """Returns the rotation matrix, shape (3, 3)."""
        w, x, y, z = self._q / np.linalg.norm(self._q)
        return np.array(
            [
                [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
                [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
                [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
            ]
        )

    def getRad(self) -> float:
        """Returns the angle of the quaternion, 0 .. 2 pi rad."""
        return float(2 * np.arctan2(np.linalg.norm(self._q[1:]), self._q[0]))

    def getLog(self) -> Array:
        """Returns the rotation vector of the shorter rotation, shape (3,), rad."""
        q = self._q if self._q[0] >= 0 else -self._q
        length = float(np.linalg.norm(q[1:]))
        if length < 1e-12:
            return 2 * q[1:] / np.linalg.norm(q)
        vector: Array = 2 * np.arctan2(length, q[0]) * q[1:] / length
        return vector

    def getRollPitchYaw(self) -> Array:
        """Returns roll, pitch and yaw, shape (3,), rad, the inverse of setRollPitchYaw."""
        m = self.getMatrix()
        pitch = np.arcsin(np.clip(m[0, 2], -1, 1))
        return np.array([np.arctan2(-m[1, 2], m[2, 2]), pitch, np.arctan2(-m[0, 1], m[0, 0])])

    def getJacobian(self) -> Array:
        """Returns the derivative of the world angular velocity by the velocity of the four numbers, shape (3, 4)."""
        w, x, y, z = self._q
        return 2 * np.array([[-x, w, -z, y], [-y, z, w, -x], [-z, -y, x, w]])

    def sqrNorm(self) -> float:
        """Returns the squared norm of the four numbers."""
        return float(self._q @ self._q)

    @property
    def w(self) -> float:
        """The scalar part."""
        return float(self._q[0])

    @w.setter
    def w(self, value: float) -> None:
        self._q[0] = value

    @property
    def x(self) -> float:
        """The first entry of the vector part."""
        return float(self._q[1])

    @x.setter
    def x(self, value: float) -> None:
        self._q[1] = value

    @property
    def y(self) -> float:
        """The second entry of the vector part."""
        return float(self._q[2])

    @y.setter
    def y(self, value: float) -> None:
        self._q[2] = value

    @property
    def z(self) -> float:
        """The third entry of the vector part."""
        return float(self._q[3])

    @z.setter
    def z(self, value: float) -> None:
        self._q[3] = value


def _axisRotation(axis: int, angle: float) -> Quaternion:
    return Quaternion().setRad(angle, np.eye(3)[axis])
