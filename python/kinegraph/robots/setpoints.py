"""Smooth motion at the rate of a robot through setpoints that come less often."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

Vector = list[float]

FOLLOW, SKIP = 0.05, 2.0  # share of its delay by which a setpoint moves the schedule; periods that begin a new schedule
STRETCHES, MARGIN = 14, 0.9  # tries of longer durations; share of acceleration and jerk that a polynomial may use
SAMPLES = (0.0, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 1.0)


@dataclass(frozen=True)
class Limits:
    """Limits per joint: velocity (rad/s), acceleration (rad/s^2), jerk (rad/s^3)."""

    velocity: Sequence[float]
    acceleration: Sequence[float]
    jerk: Sequence[float]


class Setpoints:
    """Quintic polynomials from the present state of the reference to the last setpoint, and a stop if no more come.

    Position, velocity and acceleration are continuous. Plain numbers keep a cycle short.
    """

    def __init__(self, q: Sequence[float], limits: Limits):
        """Begins at rest.

        Args:
            q: The joint values.
            limits: Limits that `advance` keeps.
        """
        self.q, self.velocity, self.acceleration = list(q), [0.0] * len(q), [0.0] * len(q)
        self.fault = ""
        self._limits = limits
        self._coefficients: list[tuple[float, float, float, float, float, float]] | None = None
        self._time = self._duration = 0.0
        self._braking = False
        self._clock = 0.0  # of the robot, s
        self._due: float | None = None  # when the next setpoint is expected

    def aim(self, q: Sequence[float], velocity: Sequence[float], acceleration: Sequence[float], period: float) -> None:
        """Moves toward a setpoint: in 1.5 periods, or longer if the limits demand it.

        Setpoints count from the times at which they are due, period by period, so that small delays of the program do
        not disturb the motion.

        Args:
            q, velocity, acceleration: State one period from now.
            period: s.
        """
        if self.fault:
            return
        due = self._clock if self._due is None else self._due
        shift = due - self._clock
        shift = 0.0 if abs(shift) > SKIP * period else (1.0 - FOLLOW) * shift
        self._due = self._clock + shift + period
        duration = max(1.5 * period + shift, period)
        for _ in range(STRETCHES):
            ahead = duration - period - shift
            a_end = acceleration if duration < 3.0 * period else [0.0] * len(q)  # not predicted for longer
            ends = [
                (x + ahead * v + 0.5 * ahead**2 * a, v + ahead * a, a)
                for x, v, a in zip(q, velocity, a_end, strict=True)
            ]
            starts = zip(self.q, self.velocity, self.acceleration, strict=True)
            self._coefficients = [_quintic(start, end, duration) for start, end in zip(starts, ends, strict=True)]
            samples = ([_at(c, u * duration) for c in self._coefficients] for u in SAMPLES)
            problem = next(filter(None, (self._excess(state, MARGIN, self.acceleration) for state in samples)), "")
            if not problem:
                break
            duration *= 1.3
        else:
            self.brake(problem)
            return
        self._time, self._duration, self._braking = 0.0, duration, False

    def brake(self, reason: str = "") -> None:
        """Comes to rest within the limits.

        Args:
            reason: The cause; later setpoints are ignored if there is one.
        """
        self.fault = self.fault or reason
        duration, limits = 0.05, self._limits
        for _ in range(STRETCHES):
            starts = zip(self.q, self.velocity, self.acceleration, strict=True)
            self._coefficients = [_stopping(q, v, a, duration) for q, v, a in starts]
            peaks = [
                max(abs(s[2]) / acceleration for s in samples)
                if max(abs(s[3]) for s in samples) <= MARGIN * jerk
                else 2.0
                for samples, acceleration, jerk in zip(
                    ([_at(c, u * duration) for u in SAMPLES] for c in self._coefficients),
                    limits.acceleration,
                    limits.jerk,
                    strict=True,
                )
            ]
            if max(peaks) <= 0.97:
                break
            duration *= 1.3
        self._time, self._duration, self._braking = 0.0, duration, True

    def advance(self, dt: float) -> Vector:
        """Advances by one cycle and returns the joint values to send.

        Args:
            dt: s.
        """
        self._clock += dt
        if self._coefficients is None:
            return self.q
        self._time += dt
        if self._time >= self._duration and self._braking:
            self.q = [_at(c, self._duration)[0] for c in self._coefficients]
            self.velocity, self.acceleration = [0.0] * len(self.q), [0.0] * len(self.q)
            self._coefficients = None
            return self.q
        if self._time > self._duration + dt:  # the next setpoint is late
            self.brake()
            self._clock -= dt
            return self.advance(dt)
        state = [_at(c, self._time) for c in self._coefficients]
        problem = "" if self._braking else self._excess(state)
        if problem:
            self.brake(problem)
            self._clock -= dt
            return self.advance(dt)
        self.q = [s[0] for s in state]
        self.velocity, self.acceleration = [s[1] for s in state], [s[2] for s in state]
        return self.q

    def _excess(
        self, state: list[tuple[float, float, float, float]], share: float = 1.0, present: Sequence[float] = ()
    ) -> str:
        """Returns the limit that a state exceeds; accelerations may be as large as the present ones."""
        limits = self._limits
        accelerations = [share * limit for limit in limits.acceleration]
        if present:
            accelerations = [max(allowed, abs(a)) for allowed, a in zip(accelerations, present, strict=True)]
        for i, (_, v, a, j) in enumerate(state):
            for name, value, limit, unit in (
                ("velocity", v, limits.velocity[i], "rad/s"),
                ("acceleration", a, accelerations[i], "rad/s^2"),
                ("jerk", j, share * limits.jerk[i], "rad/s^3"),
            ):
                if not abs(value) <= limit + 1e-9:  # NaN, too
                    return (
                        f"the setpoints ask for a {name} of {value:.3g} {unit} of joint {i + 1}; the limit is {limit:g}"
                    )
        return ""


def _quintic(
    start: tuple[float, float, float], end: tuple[float, float, float], h: float
) -> tuple[float, float, float, float, float, float]:
    """Returns the coefficients of the quintic polynomial between two states."""
    (q0, v0, a0), (q1, v1, a1) = start, end
    d = q1 - q0 - v0 * h - 0.5 * a0 * h * h
    dv = (v1 - v0 - a0 * h) * h
    da = (a1 - a0) * h * h
    return (
        q0,
        v0,
        0.5 * a0,
        (10.0 * d - 4.0 * dv + 0.5 * da) / h**3,
        (-15.0 * d + 7.0 * dv - da) / h**4,
        (6.0 * d - 3.0 * dv + 0.5 * da) / h**5,
    )


def _stopping(q: float, v: float, a: float, h: float) -> tuple[float, float, float, float, float, float]:
    """Returns the coefficients of a motion to rest: velocity and acceleration end at 0, the place is free."""
    return q, v, 0.5 * a, (-3.0 * v / h**2 - 2.0 * a / h) / 3.0, (2.0 * v / h**3 + a / h**2) / 4.0, 0.0


def _at(c: tuple[float, float, float, float, float, float], t: float) -> tuple[float, float, float, float]:
    return (
        c[0] + t * (c[1] + t * (c[2] + t * (c[3] + t * (c[4] + t * c[5])))),
        c[1] + t * (2 * c[2] + t * (3 * c[3] + t * (4 * c[4] + t * 5 * c[5]))),
        2 * c[2] + t * (6 * c[3] + t * (12 * c[4] + t * 20 * c[5])),
        6 * c[3] + t * (24 * c[4] + t * 60 * c[5]),
    )
