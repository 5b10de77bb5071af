"""Line drawings of small scenes in space, as SVG."""

from xml.sax.saxutils import escape

import numpy as np

RED, GREEN, BLUE, ORANGE, GRAY, BLACK = "#d33", "#2a2", "#26c", "#e70", "#999", "#333"
AXIS_COLORS = (RED, GREEN, BLUE)


class Drawing:
    """Draws points of space (m) as they look from above at the front."""

    def __init__(
        self, width: int = 150, height: int = 110, scale: float = 60.0, origin: tuple[float, float] = (0.22, 0.72)
    ):
        self.size = (width, height)
        self.scale, self.origin = scale, np.array(origin) * self.size
        self.parts: list[str] = []

    def at(self, point: np.ndarray | list[float]) -> np.ndarray:
        """Position on the picture, pixels: x to the right and a little down, y into the picture, z up."""
        x, y, z = point
        return self.origin + self.scale * np.array([x + 0.45 * y, 0.12 * x - 0.3 * y - z])

    def line(self, a: object, b: object, color: str = BLACK, width: float = 1.2, dashed: bool = False) -> None:
        (x1, y1), (x2, y2) = self.at(a), self.at(b)
        dash = ' stroke-dasharray="3 2"' if dashed else ""
        self.parts.append(
            f'<line x1="{x1:.1f}" y1="{y1:.1f}" x2="{x2:.1f}" y2="{y2:.1f}" stroke="{color}" stroke-width="{width}"{dash}/>'
        )

    def arrow(self, a: object, b: object, color: str = ORANGE, width: float = 2.2) -> None:
        self.line(a, b, color, width)
        tip = self.at(b)
        along = tip - self.at(a)
        if np.linalg.norm(along) < 1:
            return
        along = along / np.linalg.norm(along)
        across = np.array([-along[1], along[0]])
        corners = (tip + 1.5 * along, tip - 5 * along + 3 * across, tip - 5 * along - 3 * across)
        points = " ".join(f"{x:.1f},{y:.1f}" for x, y in corners)
        self.parts.append(f'<polygon points="{points}" fill="{color}"/>')

    def text(self, point: object, text: str, color: str = BLACK, shift: tuple[float, float] = (3, -3)) -> None:
        x, y = self.at(point) + shift
        self.parts.append(f'<text x="{x:.1f}" y="{y:.1f}" font-size="10" fill="{color}">{escape(text)}</text>')

    def axes(
        self, position: np.ndarray, rotation: np.ndarray, name: str = "", length: float = 0.35, only: str = "xyz"
    ) -> None:
        for i, (axis, color) in enumerate(zip("xyz", AXIS_COLORS)):
            if axis in only:
                self.arrow(position, position + length * rotation[:, i], color, 1.2)
        self.text(position, name, shift=(-10, 8))

    def ball(self, center: object, radius: float, color: str = GRAY, filled: bool = True) -> None:
        x, y = self.at(center)
        fill = f'fill="{color}" fill-opacity=".25"' if filled else 'fill="none"'
        self.parts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="{self.scale * radius:.1f}" {fill} stroke="{color}"/>')

    def box(self, center: np.ndarray, size: np.ndarray, rotation: np.ndarray | None = None, color: str = GRAY) -> None:
        R = np.eye(3) if rotation is None else rotation
        corner = {s: center + R @ (np.array(s) * size / 2) for s in np.ndindex(2, 2, 2)}
        corner = {s: center + R @ ((2 * np.array(s) - 1) * np.asarray(size) / 2) for s in corner}
        for s in corner:
            for i in range(3):
                t = tuple(1 if j == i else v for j, v in enumerate(s))
                if s[i] == 0:
                    self.line(corner[s], corner[t], color)

    def curve(self, points: list, color: str = ORANGE, width: float = 1.8, arrow: bool = False) -> None:
        for a, b in zip(points[:-2] if arrow else points, points[1:-1] if arrow else points[1:]):
            self.line(a, b, color, width)
        if arrow:
            self.arrow(points[-2], points[-1], color, width)

    def arc(self, center: np.ndarray, a: np.ndarray, b: np.ndarray, color: str = ORANGE, arrow: bool = True) -> None:
        """From direction a to b, with the lengths of both."""
        steps = np.linspace(0, 1, 9)
        length = np.linalg.norm(a)
        between = [(1 - s) * a + s * b for s in steps]
        self.curve([center + length * v / max(np.linalg.norm(v), 1e-9) for v in between], color, arrow=arrow)

    def svg(self) -> str:
        width, height = self.size
        head = (
            f'<svg xmlns="http://www.w3.org/2000/svg" width="{width}" height="{height}" viewBox="0 0 {width} {height}"'
        )
        return f'{head} font-family="sans-serif">{"".join(self.parts)}</svg>\n'
