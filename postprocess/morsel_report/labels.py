"""Labels of points that keep clear of points, of lines and of each other."""
import numpy as np

# Where a label may stand: distances from its point [points], directions.
DISTANCES = (5, 11, 19, 29, 42)
DIRECTIONS = np.deg2rad(np.arange(0, 360, 30))
MARK = 5  # half a marker [points]


def overlap(box, other):
    """The area that two boxes (x0, y0, x1, y1) share."""
    width = min(box[2], other[2]) - max(box[0], other[0])
    height = min(box[3], other[3]) - max(box[1], other[1])
    return width * height if width > 0 and height > 0 else 0.0


def beside(point, angle, distance, size):
    """The box of a label that touches a circle about its point."""
    c, s = np.cos(angle), np.sin(angle)
    x = point[0] + distance * c + (0.5 * (c - 1)) * size[0]
    y = point[1] + distance * s + (0.5 * (s - 1)) * size[1]
    return (x, y, x + size[0], y + size[1])


def place(axes, points, texts, colours, avoid):
    """Writes a text at each point; avoid is what else is in the way, as
    points. The axes' limits and the figure's layout must be final."""
    figure = axes.figure
    figure.canvas.draw()
    scale = figure.dpi / 72.0
    frame = axes.get_window_extent()
    at = axes.transData.transform(np.asarray(points, float)) / scale
    way = axes.transData.transform(np.asarray(avoid, float)) / scale
    frame = np.array([frame.x0, frame.y0, frame.x1, frame.y1]) / scale
    half = np.array([MARK, MARK])
    taken = [(*(p - half), *(p + half)) for p in at]
    for i in np.argsort(at[:, 0]):
        note = axes.annotate(texts[i], points[i], fontsize=8,
                             color=colours[i])
        extent = note.get_window_extent(figure.canvas.get_renderer())
        note.remove()
        size = np.array([extent.width, extent.height]) / scale

        def cost(box, distance):
            hidden = sum(overlap(box, other) for other in taken)
            outside = size[0] * size[1] - overlap(box, frame)
            crossed = np.sum((way[:, 0] > box[0]) & (way[:, 0] < box[2])
                             & (way[:, 1] > box[1]) & (way[:, 1] < box[3]))
            return (10 * hidden + 30 * outside + 60 * (crossed > 0)
                    + 6 * crossed + 4 * distance)

        candidates = [(beside(at[i], a, d, size), d)
                      for d in DISTANCES for a in DIRECTIONS]
        box, distance = min(candidates, key=lambda c: cost(*c))
        taken.append(box)
        note = axes.annotate(
            texts[i], points[i], xytext=(box[0] - at[i][0],
                                         box[1] - at[i][1]),
            textcoords="offset points", fontsize=8, color=colours[i],
            annotation_clip=False,
            arrowprops={"arrowstyle": "-", "lw": 0.5, "color": colours[i],
                        "shrinkA": 0, "shrinkB": 4, "relpos": (0.5, 0.5)}
            if distance > DISTANCES[1] else None)
        note.set_in_layout(False)
