"""Tables: the CSV files of a run, by plain names of columns, and the search for near names."""
import csv
import difflib
import os
import re

import numpy

COMPONENTS = {3: ("x", "y", "z"), 6: ("xx", "yy", "zz", "xy", "yz", "zx")}


class UnknownName(KeyError):
    """A name that is not there; the text has the nearest ones."""

    def __str__(self):
        return self.args[0]


def unknown(what, name, names):
    """UnknownName for NAME, where WHAT has NAMES."""
    names = [str(one) for one in names]
    near = difflib.get_close_matches(str(name), names, 3, 0.5)
    text = f"{what} has no {name!r}"
    if near:
        return UnknownName(f"{text} (did you mean {' or '.join(near)}?)")
    return UnknownName(f"{text}; it has {', '.join(names) or 'nothing'}")


class Named(dict):
    """A dict that answers an unknown name with the nearest ones."""

    def __init__(self, what, items):
        super().__init__(items)
        self.what = what

    def __missing__(self, name):
        raise unknown(self.what, name, self)


def numbers(texts):
    """An array of numbers, not a number where a cell is empty; of texts where one is no number."""
    try:
        return numpy.array([float(text) if text else numpy.nan for text in texts])
    except ValueError:
        return numpy.array(texts)


class Table:
    """The columns of a CSV file. table["pressure"] is an array in SI units, table.unit("pressure")
    its unit; table["velocity"] has the columns of a vector side by side, those of .x, .y
    and .z that there are."""

    def __init__(self, path):
        self.path = os.fspath(path)
        with open(path, newline="", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        if not rows:
            raise ValueError(f"{self.path} is empty")
        heads = [re.fullmatch(r"(.*?)(?: \[(.*)\])?", head) for head in rows[0]]
        self._units = {head[1]: head[2] or "" for head in heads}
        self._columns = {head[1]: numbers([row[at] for row in rows[1:]])
                         for at, head in enumerate(heads)}
        self._rows = len(rows) - 1

    def keys(self):
        """The names of the columns."""
        return list(self._columns)

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        """The number of rows."""
        return self._rows

    def __contains__(self, name):
        return name in self._columns or bool(self._parts(name))

    def __getitem__(self, name):
        if name in self._columns:
            return self._columns[name]
        return numpy.stack([self._columns[part] for part in self._known(name)], axis=1)

    def unit(self, name):
        """The unit of a column, "" of a plain number."""
        return self._units[name if name in self._units else self._known(name)[0]]

    def frame(self):
        """A pandas.DataFrame; its attrs["units"] has the units."""
        import pandas  # not needed by anything else
        frame = pandas.DataFrame(self._columns)
        frame.attrs["units"] = dict(self._units)
        return frame

    def _parts(self, stem):
        for parts in COMPONENTS.values():
            names = [f"{stem}.{part}" for part in parts if f"{stem}.{part}" in self._columns]
            if names:
                return names
        return []

    def _known(self, name):
        parts = self._parts(name)
        if not parts:
            raise unknown(self.path, name, self._columns)
        return parts

    def __repr__(self):
        return f"<Table {self.path}: {len(self)} rows of {', '.join(self._columns)}>"
