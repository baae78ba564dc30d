"""Snapshots: the fields of all particles, or cells of a gas, at one time."""
import os

import h5py
import numpy

from .table import COMPONENTS, Named, unknown


class Snapshot:
    """One moment of a run. snapshot["pressure"] is an array of all particles or cells,
    snapshot["velocity"] one of three columns, snapshot["velocity.x"] the first of them. `position`
    is that of the particles, or of the centres of the cells. Cells that an obstacle blocks are left
    out."""

    def __init__(self, path, others=None):
        self.path = os.fspath(path)
        self._others = others or {}
        self._kept = None
        with self._open() as file:
            fields = file["VTKHDF/FieldData"]
            self.time = float(fields["time"][0])
            self.step = int(fields["step"][0])
            self.bodies = self._list(fields, "bodies")
            self.materials = self._list(fields, "materials")
            self._cells = len(file["VTKHDF/CellData"]) > 0
            data = self._data(file)
            self._units = {name: self._text(data[name].attrs.get("unit", "")) for name in data
                           if name != "vtkGhostType"}
            if "vtkGhostType" in data:
                self._kept = data["vtkGhostType"][:] == 0
        self._units["position"] = "m"

    @property
    def others(self):
        """{name: Snapshot} of the other populations of a coupled run: "gas", "detonation"."""
        return Named(self.path, {name: Snapshot(path) for name, path in self._others.items()})

    def keys(self):
        """The names of the fields."""
        return sorted(self._units)

    def __iter__(self):
        return iter(self.keys())

    def __contains__(self, name):
        return name in self._units

    def __len__(self):
        """The number of particles or cells."""
        return len(self["id"])

    def unit(self, name):
        """The unit of a field, "" of a plain number."""
        return self._units[self._known(name.partition(".")[0])]

    def __getitem__(self, name):
        stem, _, part = name.partition(".")
        self._known(stem)
        with self._open() as file:
            if stem == "position":
                values = self._centres(file) if self._cells else file["VTKHDF/Points"][:]
            else:
                values = self._data(file)[stem][:]
        if self._kept is not None:
            values = values[self._kept]
        return values[:, self._component(name, part, values)] if part else values

    def where(self, *bodies):
        """A mask of the particles or cells that belong to one of BODIES."""
        for body in bodies:
            if body not in self.bodies:
                raise unknown(self.path, body, self.bodies)
        return numpy.isin(self["body"], [self.bodies.index(body) for body in bodies])

    def mean(self, name, where=None, weights="mass"):
        """The mean of a field over all, or over those of a mask, by mass, volume or number."""
        where = self._mask(where)
        return numpy.average(self[name][where].astype(float), axis=0,
                             weights=self.weights(weights)[where])

    def histogram(self, name, bins=50, range=None, where=None, weights="mass"):
        """numpy.histogram of a field by mass, volume or number: the sums and the edges."""
        where = self._mask(where)
        return numpy.histogram(self[name][where], bins, range, weights=self.weights(weights)[where])

    def weights(self, kind):
        """Each one's weight: its "mass", its "volume", or 1 with "number"."""
        if kind == "number":
            return numpy.ones(len(self))
        if kind not in ("mass", "volume"):
            raise ValueError(f'weights are "mass", "volume" or "number", not {kind!r}')
        mass = self["mass"].astype(float)
        return mass if kind == "mass" else mass / self["density"]

    def to_pyvista(self):
        """A pyvista.PolyData: a point a particle or cell, with all fields."""
        import pyvista  # not needed by anything else
        data = pyvista.PolyData(self["position"])
        for name in self._units:
            if name != "position":
                data.point_data[name] = self[name]
        return data

    def _open(self):
        return h5py.File(self.path, "r")

    def _data(self, file):
        return file["VTKHDF/CellData" if self._cells else "VTKHDF/PointData"]

    @staticmethod
    def _text(value):
        return value.decode() if isinstance(value, bytes) else str(value)

    def _list(self, fields, name):
        return [self._text(text) for text in fields[name]] if name in fields else []

    def _mask(self, where):
        return slice(None) if where is None else where

    def _known(self, stem):
        if stem not in self._units:
            raise unknown(self.path, stem, self.keys())
        return stem

    def _component(self, name, part, values):
        parts = COMPONENTS.get(values.shape[1] if values.ndim > 1 else 1, ())
        if part not in parts:
            stem = name.partition(".")[0]
            raise unknown(self.path, name, [f"{stem}.{one}" for one in parts] or [stem])
        return parts.index(part)

    @staticmethod
    def _centres(file):
        """The middles of the cells, whose corners are listed one cell after the other."""
        offsets = file["VTKHDF/Offsets"][:]
        corners = file["VTKHDF/Points"][:][file["VTKHDF/Connectivity"][:]]
        sums = numpy.add.reduceat(corners, offsets[:-1], axis=0)
        return sums / numpy.diff(offsets)[:, None]

    def __repr__(self):
        return f"<Snapshot {self.path}: {self.time:.6g} s>"
