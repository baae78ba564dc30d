"""The axis of a problem: s runs along it, t across. Plane problems rotate it by an angle against
the lattice; about an axis of symmetry s is y, on a line x."""
import dataclasses
import math

from entry import DIMENSION, metres, rotated, speeds, unit


@dataclasses.dataclass(frozen=True)
class Frame:
    geometry: str
    angle: float = 0

    @property
    def dimension(self):
        return DIMENSION[self.geometry]

    @property
    def axes(self):
        """The unit vectors along and across in the x-y plane."""
        if self.geometry == "axisymmetric":
            return (0.0, 1.0), (1.0, 0.0)
        a = math.radians(self.angle)
        return (math.cos(a), math.sin(a)), (-math.sin(a), math.cos(a))

    def s(self):
        """The coordinate along, as an expression."""
        return "x" if self.geometry == "1d" else self._dot(self.axes[0])

    def t(self):
        return self._dot(self.axes[1])

    @staticmethod
    def _dot(n):
        terms = [f"{c:.15g}*{x}" for c, x in zip(n, "xy") if c]
        return f"({' + '.join(terms)})"

    def bar(self, low, high, half):
        """The shape between LOW and HIGH along the axis, HALF wide to either side."""
        if self.geometry == "1d":
            return {"box": {"from": metres(low), "to": metres(high)}}
        if self.geometry == "axisymmetric":
            return {"box": {"from": metres(0, low), "to": metres(half, high)}}
        more = [half] if self.dimension == 3 else []
        box = {"from": metres(low, -half, *[-x for x in more]), "to": metres(high, half, *more)}
        return rotated({"box": box}, self.angle)

    def beyond(self, at, sign):
        """The half space on the side of SIGN of the plane s = AT, to cut with."""
        n = [-sign * c for c in self.axes[0]][: self.dimension]
        point = [at * c for c in self.axes[0]][: self.dimension]
        while len(n) < self.dimension:
            n.append(0.0)
            point.append(0.0)
        return {"half_space": {"point": metres(*point), "normal": n}}

    def vector(self, along, across=None, deep=None):
        """Components of a vector field: numbers in m/s or expressions along, across, and along
        z."""
        parts = [(along, self.axes[0]), (across, self.axes[1])]
        parts = [(speeds(part)[0], n) for part, n in parts if part is not None]
        out = []
        for i in range(min(self.dimension, 2)):
            terms = [f"{n[i]:.15g}*({part})" for part, n in parts if n[i]]
            out.append(" + ".join(terms) or "0 m/s")
        return out + [speeds(deep or 0)[0]] if self.dimension == 3 else out

    def middle(self, radius):
        """Keys of a check that confine it to what is near the origin."""
        if self.geometry == "1d":
            return {"between": metres(-radius, radius)}
        return {"about": metres(*[0] * self.dimension), "between": metres(0, radius)}

    def stress(self, checks):
        """The normal stress along the axis from the checks xx, yy, xy."""
        n = self.axes[0]
        if self.geometry == "1d":
            return checks["xx"]
        return n[0] ** 2 * checks["xx"] + n[1] ** 2 * checks["yy"] + 2 * n[0] * n[1] * checks["xy"]

    def stress_checks(self, **where):
        """The checks that `stress` needs."""
        names = ("xx",) if self.geometry == "1d" else ("xx", "yy", "xy")
        return {x: {"mean": f"stress.{x}", **where, "at_most": "1e300 Pa"} for x in names}

    def strain_checks(self, size, **of):
        """The checks that `strain` needs: means in two spots, SIZE to either side of the origin."""
        made = {}
        for side, sign in (("low", -1), ("high", 1)):
            spot = {"between": metres(*sorted((0, sign * size)))}
            if self.geometry != "1d":
                center = [sign * size * c for c in self.axes[0]] + [0.0] * (self.dimension - 2)
                spot = {"about": metres(*center), "between": metres(0, size)}
            for x in "xy"[: self.dimension]:
                for field in ("position", "displacement"):
                    check = {"mean": f"{field}.{x}", **of, **spot, "at_most": "1e300 m"}
                    made[f"{side} {field}.{x}"] = check
        return made

    def strain(self, checks):
        """The logarithmic strain along, between the two spots: exact where displacement is
        linear."""

        def gap(field):
            pairs = [
                (checks[f"{s} {field}.x"], checks.get(f"{s} {field}.y", 0.0))
                for s in ("low", "high")
            ]
            return sum((b - a) * n for a, b, n in zip(*pairs, self.axes[0]))

        now, moved = gap("position"), gap("displacement")
        return math.log(now / (now - moved))

    @property
    def name(self):
        return self.geometry + (f"/{self.angle:g}deg" if self.angle else "")


def walls(**at):
    """Mirror walls by side: low_x=0, high_y=1, in metres."""
    made = {}
    for name, place in at.items():
        side, x = name.split("_")
        made[name.replace("_", " ")] = {"kind": "reflecting", "axis": x, "at": unit(place, "m"), "side": side}
    return made
