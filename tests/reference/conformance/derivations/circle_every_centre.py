#!/usr/bin/env python3
"""The four circles of few points from their definitions, by trying every centre there can be; those of lobed
circles of many points in closed form.

circle_every_centre.py CASE.json   prints {pointer: value}

Minimum zone: two points on either circle, hence a centre on the bisectors of two pairs (n^4 / 8 centres). Circumscribed:
a circle on two or three points that holds all. Inscribed: a circle on three corners of an acute triangle that holds none.
Least squares: steps of Newton in 50 decimal digits. Condition: numpy's eigenvalues of the normal matrix.
"""
import itertools
import json
import math
import sys
from decimal import Decimal as D, getcontext

import numpy

getcontext().prec = 50


def distances(points, centre):
    return [math.hypot(x - centre[0], y - centre[1]) for x, y in points]


def crossing(p, q):
    """Of two lines n . c = o; None for parallel ones."""
    determinant = p[0] * q[1] - p[1] * q[0]
    if determinant == 0:
        return None
    return (p[2] * q[1] - q[2] * p[1]) / determinant, (q[2] * p[0] - p[2] * q[0]) / determinant


def bisector(a, b):
    dx, dy = b[0] - a[0], b[1] - a[1]
    return dx, dy, (dx * (a[0] + b[0]) + dy * (a[1] + b[1])) / 2


def zone(points):
    lines = [bisector(a, b) for a, b in itertools.combinations(points, 2)]
    best = None
    for p, q in itertools.combinations(lines, 2):
        centre = crossing(p, q)
        if centre is None:
            continue
        d = distances(points, centre)
        if best is None or max(d) - min(d) < best[0]:
            best = max(d) - min(d), centre, d
    width, centre, d = best
    close = 1e-9 * max(d)
    sides = {i: "outer" for i, one in enumerate(d) if one > max(d) - close}
    sides.update({i: "inner" for i, one in enumerate(d) if one < min(d) + close})
    found = {"/minimum_zone/width": width, "/minimum_zone/x": centre[0], "/minimum_zone/y": centre[1],
             "/minimum_zone/outer_radius": max(d), "/minimum_zone/inner_radius": min(d), "/minimum_zone/gap": 0}
    if len(sides) == 4:
        for place, index in enumerate(sorted(sides)):
            found[f"/minimum_zone/control_points/{place}/index"] = index
            found[f"/minimum_zone/control_points/{place}/side"] = sides[index]
    found["/minimum_zone/wide"] = width > 0.1 * (max(d) + min(d)) / 2
    return found


def circle_of_three(a, b, c):
    centre = crossing(bisector(a, b), bisector(a, c))
    return None if centre is None else (centre, math.dist(centre, a))


def is_acute(a, b, c):
    return all((q[0] - p[0]) * (r[0] - p[0]) + (q[1] - p[1]) * (r[1] - p[1]) > 0
               for p, q, r in ((a, b, c), (b, c, a), (c, a, b)))


def circumscribed(points):
    circles = [(((a[0] + b[0]) / 2, (a[1] + b[1]) / 2), math.dist(a, b) / 2)
               for a, b in itertools.combinations(points, 2)]
    circles += filter(None, (circle_of_three(*three) for three in itertools.combinations(points, 3)))
    return min(((r, c) for c, r in circles if max(distances(points, c)) <= r * (1 + 1e-12)), default=None)


def inscribed(points):
    circles = (circle_of_three(*three) for three in itertools.combinations(points, 3) if is_acute(*three))
    return max(((r, c) for c, r in filter(None, circles) if min(distances(points, c)) >= r * (1 - 1e-12)), default=None)


def solved(matrix, right):
    """Gauss over decimals."""
    rows = [[*row, value] for row, value in zip(matrix, right)]
    for i in range(3):
        pivot = max(range(i, 3), key=lambda k: abs(rows[k][i]))
        rows[i], rows[pivot] = rows[pivot], rows[i]
        for k in range(3):
            if k != i:
                factor = rows[k][i] / rows[i][i]
                rows[k] = [a - factor * b for a, b in zip(rows[k], rows[i])]
    return [rows[i][3] / rows[i][i] for i in range(3)]


def least_squares(points):
    exact = [(D(x), D(y)) for x, y in points]
    n = len(points)
    a, b = sum(x for x, _ in exact) / n, sum(y for _, y in exact) / n
    # Kasa's circle to start from
    rows = [(2 * (x - a), 2 * (y - b), D(1), (x - a) ** 2 + (y - b) ** 2) for x, y in exact]
    normal = [[sum(p[i] * p[j] for p in rows) for j in range(3)] for i in range(3)]
    u, v, w = solved(normal, [sum(p[i] * p[3] for p in rows) for i in range(3)])
    a, b, r = a + u, b + v, (w + u * u + v * v).sqrt()
    for _ in range(60):
        gradient, hessian = [D(0)] * 3, [[D(0)] * 3 for _ in range(3)]
        for x, y in exact:
            d = ((x - a) ** 2 + (y - b) ** 2).sqrt()
            ux, uy, e = (x - a) / d, (y - b) / d, d - r
            row = (-ux, -uy, D(-1))
            curved = [[uy * uy, -ux * uy, 0], [-ux * uy, ux * ux, 0], [0, 0, 0]]
            for i in range(3):
                gradient[i] += e * row[i]
                for j in range(3):
                    hessian[i][j] += row[i] * row[j] + e / d * curved[i][j]
        da, db, dr = solved(hessian, gradient)
        a, b, r = a - da, b - db, r - dr
    u = numpy.array([[float((x - a) / r), float((y - b) / r)] for x, y in exact])
    u /= numpy.hypot(u[:, 0], u[:, 1])[:, None]
    rows = numpy.column_stack([u, numpy.ones(n)])
    values = numpy.linalg.eigvalsh(rows.T @ rows)
    return (float(a), float(b)), float(r), float(values[-1] / values[0])


def arc(points, centre):
    angles = sorted(math.atan2(y - centre[1], x - centre[0]) for x, y in points)
    gaps = [b - a for a, b in zip(angles, angles[1:])] + [angles[0] + 2 * math.pi - angles[-1]]
    return 360 - math.degrees(max(gaps))


def add_circle(found, name, circle):
    if circle:
        radius, (x, y) = circle
        found.update({f"/{name}/radius": radius, f"/{name}/x": x, f"/{name}/y": y})


def few_points(points):
    found = zone(points)
    centre, radius, condition = least_squares(points)
    add_circle(found, "least_squares", (radius, centre))
    found["/least_squares/condition"] = condition
    found["/arc_deg"] = arc(points, centre)
    add_circle(found, "minimum_circumscribed", circumscribed(points))
    if found["/arc_deg"] > 180:
        add_circle(found, "maximum_inscribed", inscribed(points))
    return found


def lobed(points):
    """r = R + a cos k theta at n = 2 k m even angles: k points on each circle, interlaced: centre 0, width 2 a."""
    radii, n = distances(points, (0, 0)), len(points)
    mean = sum(radii) / n
    size = [abs(sum(r * complex(math.cos(t), math.sin(t)) for r, t in
                    ((r, k * 2 * math.pi * i / n) for i, r in enumerate(radii)))) * 2 / n for k in range(n // 2)]
    k = max(range(1, n // 2), key=lambda one: size[one])
    a = size[k]
    if k < 2 or n % (2 * k) or max(abs(r - mean - a * math.cos(2 * math.pi * k * i / n)) for i, r in enumerate(radii)) > 1e-12 * mean:
        raise SystemExit("no lobed circle")
    found = {"/minimum_zone/width": 2 * a, "/minimum_zone/outer_radius": mean + a, "/minimum_zone/inner_radius": mean - a,
             "/minimum_zone/x": 0, "/minimum_zone/y": 0, "/least_squares/x": 0, "/least_squares/y": 0,
             "/least_squares/radius": mean, "/least_squares/condition": 2, "/arc_deg": 360 - 360 / n}
    if k > 2:  # of two lobes the circle slides sideways
        add_circle(found, "maximum_inscribed", (mean - a, (0, 0)))
    add_circle(found, "minimum_circumscribed", (mean + a, (0, 0)))
    return found


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        points = [tuple(map(float, point)) for point in json.load(file)["case"]["points"]]
    print(json.dumps(few_points(points) if len(points) <= 24 else lobed(points)))


main()
