#!/usr/bin/python3
"""Writes hertz_cylinder.msh: the lower cap of a cylinder of radius 50 mm that
stands on the origin, 60 mm wide, its flat top 40 mm above; quadrilaterals, 0.5
mm wide where contact is, growing away from it."""
import math

RADIUS, HALF_WIDTH, TOP, CELL, FINE = 0.05, 0.03, 0.04, 5e-4, 0.01


def graded(first, length, growth):
    """Places from 0 to a length, the steps growing by a factor."""
    steps = [first]
    while sum(steps) < length:
        steps.append(steps[-1] * growth)
    scale = length / sum(steps)
    places = [0.0]
    for step in steps:
        places.append(places[-1] + scale * step)
    return places


fine = [CELL * k for k in range(round(FINE / CELL) + 1)]
right = fine[:-1] + [FINE + x for x in graded(CELL, HALF_WIDTH - FINE, 1.2)]
columns = [-x for x in reversed(right[1:])] + right
rows = [y / TOP for y in graded(CELL, TOP, 1.15)]

nodes = []
for s in rows:
    for x in columns:
        arc = RADIUS - math.sqrt(RADIUS**2 - x**2)
        nodes.append((x, arc + s * (TOP - arc)))
n, m = len(columns), len(rows)


def node(i, j):
    return j * n + i + 1


elements = []  # type, physical tag, nodes
for i in range(n - 1):
    elements.append((1, 1, (node(i, 0), node(i + 1, 0))))
    elements.append((1, 2, (node(i, m - 1), node(i + 1, m - 1))))
for j in range(m - 1):
    elements.append((1, 3, (node(0, j), node(0, j + 1))))
    elements.append((1, 3, (node(n - 1, j), node(n - 1, j + 1))))
for j in range(m - 1):
    for i in range(n - 1):
        elements.append((3, 4, (node(i, j), node(i + 1, j),
                                node(i + 1, j + 1), node(i, j + 1))))

with open("hertz_cylinder.msh", "w") as out:
    out.write('$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n'
              '1 1 "arc"\n1 2 "top"\n1 3 "flanks"\n2 4 "cylinder"\n'
              '$EndPhysicalNames\n$Nodes\n%d\n' % len(nodes))
    for k, (x, y) in enumerate(nodes):
        out.write("%d %.9g %.9g 0\n" % (k + 1, x, y))
    out.write("$EndNodes\n$Elements\n%d\n" % len(elements))
    for k, (kind, tag, corners) in enumerate(elements):
        out.write("%d %d 2 %d %d %s\n" % (k + 1, kind, tag, tag,
                                          " ".join(map(str, corners))))
    out.write("$EndElements\n")
