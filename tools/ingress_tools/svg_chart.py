"""Charts over time as svg text, for self-contained pages."""
import math
from html import escape

WIDTH, HEIGHT, LEFT, RIGHT, TOP, BOTTOM = 1000, 230, 56, 10, 26, 24
MOST_OF_SPREAD = 0.98  # share of the values that the axis shows; others are drawn at its edge


def ticks(low, high, about=5):
    """Round numbers from low to high."""
    raw = (high - low) / about
    base = 10 ** math.floor(math.log10(raw))
    step = next(m * base for m in (1, 2, 5, 10) if m * base >= raw)
    first = math.ceil(low / step - 1e-9)
    return [round(i * step, 10) for i in range(first, int(math.floor(high / step + 1e-9)) + 1)]


def spread(values):
    """Limits for the bulk of the values, never equal."""
    known = sorted(value for value in values if math.isfinite(value))
    if not known:
        return 0.0, 1.0
    beyond = int(len(known) * (1 - MOST_OF_SPREAD) / 2)
    low, high = known[beyond], known[len(known) - 1 - beyond]
    room = 0.08 * (high - low) or 0.5
    return low - room, high + room


def runs(*columns):
    """Runs of neighbouring indices that are finite in all columns."""
    run = []
    for i, values in enumerate(zip(*columns)):
        if all(math.isfinite(value) for value in values):
            run.append(i)
        elif run:
            yield run
            run = []
    if run:
        yield run


class Chart:
    def __init__(self, time, title):
        self.time, self.title = time, title
        self.begin, self.end = min(time), max(max(time), min(time) + 1e-3)
        self.values, self.drawn, self.legend = [], [], []

    def points(self, name, values, colour):
        self._add(name, values, colour, self._points)

    def line(self, name, values, colour):
        self._add(name, values, colour, self._line)

    def band(self, low, high, colour):
        self.values += low + high
        self.drawn.append(lambda: "".join(self._band(run, low, high, colour) for run in runs(low, high)))

    def marks(self, name, times, colour):
        """Marks at the bottom."""
        if times:
            self.legend.append((name, colour))
        bottom = HEIGHT - BOTTOM
        self.drawn.append(lambda: "".join(f'<path d="M{self._x(t):.1f} {bottom}v-8" stroke="{colour}"/>' for t in times))

    def svg(self):
        self.low, self.high = spread(self.values)
        shapes = "".join(draw() for draw in self.drawn)
        return (f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" font-size="12" role="img">'
                f'<title>{escape(self.title)}</title>{self._axes()}{shapes}{self._legend()}</svg>')

    def _add(self, name, values, colour, draw):
        if not any(math.isfinite(value) for value in values):
            return
        self.values += values
        self.legend.append((name, colour))
        self.drawn.append(lambda: draw(values, colour))

    def _x(self, time):
        return LEFT + (WIDTH - LEFT - RIGHT) * (time - self.begin) / (self.end - self.begin)

    def _y(self, value):
        bounded = min(max(value, self.low), self.high)
        return HEIGHT - BOTTOM - (HEIGHT - TOP - BOTTOM) * (bounded - self.low) / (self.high - self.low)

    def _place(self, i, value):
        return f"{self._x(self.time[i]):.1f} {self._y(value):.1f}"

    def _points(self, values, colour):
        return "".join(f'<circle cx="{self._x(t):.1f}" cy="{self._y(v):.1f}" r="2" fill="{colour}"/>'
                       for t, v in zip(self.time, values) if math.isfinite(v))

    def _line(self, values, colour):
        paths = ("M" + "L".join(self._place(i, values[i]) for i in run) for run in runs(values))
        return "".join(f'<path d="{path}" fill="none" stroke="{colour}" stroke-width="1.3"/>' for path in paths)

    def _band(self, run, low, high, colour):
        there, back = (self._place(i, low[i]) for i in run), (self._place(i, high[i]) for i in reversed(run))
        return f'<path d="M{"L".join([*there, *back])}Z" fill="{colour}" fill-opacity="0.18"/>'

    def _axes(self):
        parts = []
        for value in ticks(self.low, self.high):
            y = self._y(value)
            parts.append(f'<path d="M{LEFT} {y:.1f}H{WIDTH - RIGHT}" stroke="#e4e4e4"/>'
                         f'<text x="{LEFT - 6}" y="{y + 4:.1f}" text-anchor="end" fill="#666">{value:g}</text>')
        for value in ticks(self.begin, self.end, 10):
            parts.append(f'<text x="{self._x(value):.1f}" y="{HEIGHT - 6}" text-anchor="middle" fill="#666">{value:g} s</text>')
        parts.append(f'<text x="{LEFT}" y="14" font-weight="bold">{escape(self.title)}</text>')
        return "".join(parts)

    def _legend(self):
        parts, right = [], WIDTH - RIGHT
        for name, colour in reversed(self.legend):
            right -= 7 * len(name) + 22
            parts.append(f'<circle cx="{right + 6}" cy="10" r="4" fill="{colour}"/><text x="{right + 14}" y="14">{escape(name)}</text>')
        return "".join(parts)
