"""The points of tests/bench/circle_points.hpp by shape, for every peer alike."""
import math
import random


def circle(count, arc_deg):
    noise, points = random.Random(17), []
    for i in range(count):
        t = 0.3 + i / count * math.radians(arc_deg)
        r = 100 + 0.004 * math.cos(2 * t) + 0.002 * math.cos(3 * t + 1) + noise.gauss(0, 0.0005)
        r -= 0.003 if math.fmod(t, math.pi / 2) < 0.01 else 0
        points.append((3 + r * math.cos(t), -2 + r * math.sin(t)))
    return points


ZONES = [(f"minimum zone, {arc} deg, 1e{power}", 10 ** power, arc) for power in (6, 5, 3) for arc in (360, 220)]
