"""Columns of equal length under names."""
import numpy


class Table:
    """Columns as attributes: table.t, table.x. All are numpy arrays of one length."""

    def __init__(self, **columns):
        self._names = list(columns)
        for name, values in columns.items():
            setattr(self, name, numpy.asarray(values))

    @property
    def columns(self):
        return list(self._names)

    def add(self, **columns):
        for name, values in columns.items():
            if name not in self._names:
                self._names.append(name)
            setattr(self, name, numpy.asarray(values))
        return self

    def __len__(self):
        return len(getattr(self, self._names[0])) if self._names else 0

    def __bool__(self):
        return len(self) > 0

    def where(self, mask):
        return Table(**{name: getattr(self, name)[mask] for name in self._names})

    def at(self, times, name, period=None):
        """Column `name` at `times` by linear interpolation; angles with their period."""
        if not len(self):
            return numpy.full(numpy.shape(times), numpy.nan)
        return numpy.interp(times, self.t, numpy.unwrap(getattr(self, name), period=period)
                            if period else getattr(self, name))


def table_of(names, rows):
    """A table from rows of numbers; without rows the columns are there and empty."""
    array = numpy.array(rows, dtype=float).reshape(len(rows), len(names))
    return Table(**{name: array[:, k] for k, name in enumerate(names)})


def wrap(angle):
    """Angles in [-pi, pi)."""
    return (numpy.asarray(angle) + numpy.pi) % (2.0 * numpy.pi) - numpy.pi
