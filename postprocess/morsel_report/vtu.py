"""Reads the program's own ParaView files (vtu, arrays in base64)."""
import base64
import xml.etree.ElementTree as ElementTree

import numpy as np

TYPES = {"Float64": np.float64, "Int32": np.int32, "UInt8": np.uint8}


class Grid:
    """Points, cells and fields; every cell has points of its own."""

    def __init__(self, points, offsets, point_fields, cell_fields):
        self.points = points            # (n, 2) [m]
        self.offsets = offsets          # ends of the cells in the points
        self.point_fields = point_fields
        self.cell_fields = cell_fields

    def starts(self):
        """First point of every cell."""
        return np.concatenate([[0], self.offsets[:-1]]).astype(int)

    def polygons(self, points=None):
        """The cells' points, (m_i, 2) each; of moved points if given."""
        points = self.points if points is None else points
        return np.split(points, self.offsets[:-1])

    def triangles(self):
        """Fans of triangles over convex cells, (n, 3) numbers of points."""
        fans = []
        starts = self.starts()
        sizes = self.offsets - starts
        for size in np.unique(sizes[sizes > 2]):
            first = starts[sizes == size]
            for k in range(1, size - 1):
                fans.append(np.stack([first, first + k, first + k + 1], 1))
        return (np.concatenate(fans) if fans
                else np.zeros((0, 3), dtype=int))


def read_array(element):
    """One DataArray: (name, array with a row for each tuple)."""
    data = base64.b64decode((element.text or "").strip())
    length = int(np.frombuffer(data[:8], np.uint64)[0])
    values = np.frombuffer(data[8:8 + length], TYPES[element.get("type")])
    columns = int(element.get("NumberOfComponents", "1"))
    return element.get("Name"), (values.reshape(-1, columns) if columns > 1
                                 else values)


def read_vtu(file):
    """The grid of one file.

    Raises OSError, ValueError or ElementTree.ParseError for what is no such
    file.
    """
    piece = ElementTree.parse(file).getroot().find("UnstructuredGrid/Piece")
    if piece is None:
        raise ValueError(f"{file} holds no unstructured grid")

    def fields(section):
        return dict(read_array(e) for e in piece.findall(section
                                                         + "/DataArray"))

    points = fields("Points")["points"][:, :2]
    return Grid(points, fields("Cells")["offsets"].astype(int),
                fields("PointData"), fields("CellData"))


def joined(grids):
    """Several grids, of as many ranks, as one; cells keep their rank."""
    if not grids:
        return None
    ends = np.cumsum([0] + [len(g.points) for g in grids])
    ranks = np.concatenate([np.full(len(g.offsets), k)
                            for k, g in enumerate(grids)])
    cell_fields = {name: np.concatenate([g.cell_fields[name] for g in grids])
                   for name in grids[0].cell_fields}
    cell_fields["rank"] = ranks
    return Grid(np.concatenate([g.points for g in grids]),
                np.concatenate([g.offsets + end
                                for g, end in zip(grids, ends)]),
                {name: np.concatenate([g.point_fields[name] for g in grids])
                 for name in grids[0].point_fields}, cell_fields)


def read_pieces(folder, name):
    """All ranks' parts of a picture as one grid, or None.

    NAME.pvd lists the files; without it NAME.vtu is read.
    """
    collection = folder / (name + ".pvd")
    try:
        if collection.is_file():
            root = ElementTree.parse(collection).getroot()
            files = [folder / e.get("file") for e in root.iter("DataSet")]
        else:
            files = [folder / (name + ".vtu")]
        return joined([read_vtu(f) for f in files])
    except (OSError, ValueError, KeyError, ElementTree.ParseError):
        return None
