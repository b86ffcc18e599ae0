"""Domains and designs in them: polygons, faces of meshes, densities that go along, bases, lattices, elimination.

Rationals and brute force; the measures of curves and surfaces are textbook ones.
"""
import math
import os
import random
import tempfile
from fractions import Fraction


# ---------------------------------------------------------------- exact plane geometry

def turn(a, b, c):
    value = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    return (value > 0) - (value < 0)


def on_segment(a, b, c):
    return (turn(a, b, c) == 0 and min(a[0], b[0]) <= c[0] <= max(a[0], b[0])
            and min(a[1], b[1]) <= c[1] <= max(a[1], b[1]))


def sides(ring):
    return [(ring[i], ring[(i + 1) % len(ring)]) for i in range(len(ring))]


def meeting(a, b, c, d):
    """How two segments meet: "cross", "overlap", the point where they touch, or None."""
    if turn(a, b, c) * turn(a, b, d) < 0 and turn(c, d, a) * turn(c, d, b) < 0:
        return "cross"
    shared = {p for p, q, r in ((c, a, b), (d, a, b), (a, c, d), (b, c, d)) if on_segment(q, r, p)}
    return "overlap" if len(shared) > 1 else shared.pop() if shared else None


def is_simple(ring):
    edges = sides(ring)
    for i, (a, b) in enumerate(edges):
        for j in range(i + 1, len(edges)):
            how = meeting(a, b, *edges[j])
            follows = (j == i + 1 and how == b) or (i == 0 and j == len(edges) - 1 and how == a)
            if how is not None and not follows:
                return False
    return True


def twice_area(ring):
    return sum(a[0] * b[1] - b[0] * a[1] for a, b in sides(ring))


def surrounds(ring, p):
    odd = False
    for a, b in sides(ring):
        if (a[1] > p[1]) != (b[1] > p[1]):
            odd ^= p[0] < a[0] + Fraction((b[0] - a[0]) * (p[1] - a[1]), 1) / (b[1] - a[1])
    return odd


def pieces(ring, others):
    """Midpoints of a ring's edges, split at the vertices of others."""
    middles = []
    for a, b in sides(ring):
        cuts = {a, b} | {p for other in others for p in other if on_segment(a, b, p)}
        cuts = sorted(cuts, key=lambda p: abs(p[0] - a[0]) + abs(p[1] - a[1]))
        middles += [(Fraction(p[0] + q[0], 2), Fraction(p[1] + q[1], 2)) for p, q in zip(cuts, cuts[1:])]
    return middles


def may_touch(one, other):
    """Whether two rings share only points in which they do not cross."""
    for a, b in sides(one):
        for c, d in sides(other):
            if meeting(a, b, c, d) in ("cross", "overlap"):
                return False
    return all(len({surrounds(y, p) for p in pieces(x, [y])}) == 1 for x, y in ((one, other), (other, one)))


def random_ring(rng, corners, size):
    while True:
        ring = [(rng.randrange(size), rng.randrange(size)) for _ in range(corners)]
        if len(set(ring)) == corners and is_simple(ring):
            return ring


def spec_of(rings):
    return "polygon:vertices=[" + " / ".join(" ".join(f"{x},{y}" for x, y in ring) for ring in rings) + "]"


def check_polygons(cases):
    """Polygons whose rings touch or cross: areas, points inside, refusals (rationals)"""
    rng = random.Random(1)
    for _ in range(250):
        count = rng.choice((1, 2, 2, 3))
        rings = [random_ring(rng, rng.choice((3, 4, 5)), 6) for _ in range(count)]
        valid = all(may_touch(rings[i], rings[j]) for i in range(count) for j in range(i))
        if not valid and rng.random() < 0.85:
            continue
        words = ["generate", "random", "-n", 60, "-w", spec_of(rings), "--with-pdf"]
        try:
            rows = cases.points(*words)
        except RuntimeError as error:
            cases.expect(f"{spec_of(rings)} is refused", not valid and "edge" in str(error), str(error))
            continue
        if not valid:
            cases.expect(f"{spec_of(rings)} is refused", False)
            continue
        area = Fraction(0)
        for i, ring in enumerate(rings):
            others = rings[:i] + rings[i + 1:]
            middle = pieces(ring, others)[0]
            depth = sum(surrounds(other, middle) for other in others)
            area += Fraction(abs(twice_area(ring)), 2) * (1 - 2 * (depth % 2))
        cases.compare(spec_of(rings), 1 / rows[0][2], float(area), 1e-13)
        inside = [sum(surrounds(ring, (Fraction(x), Fraction(y))) for ring in rings) % 2 for x, y, _ in rows]
        cases.expect(f"points in {spec_of(rings)}", all(inside))


def comb(teeth, rng):
    ring = [(0, 0), (teeth, 0)]
    for k in reversed(range(teeth)):
        height = 1 + rng.random()
        ring += [(k + 0.9, 0.5), (k + 0.6, height), (k + 0.4, height), (k + 0.1, 0.5)]
    return ring


def check_large_polygons(cases):
    """A comb of 24 000 vertices, straight and turned, and 20 000 islands: seconds and memory"""
    rng = random.Random(2)
    straight = [(x / 6000, y) for x, y in comb(6000, rng)]
    c, s = math.cos(0.7), math.sin(0.7)
    turned = [(c * x - s * y, s * x + c * y) for x, y in straight]
    islands = [[(i + 0.4 * math.cos(a), j + 0.4 * math.sin(a))
                for a in sorted(rng.uniform(0, 2 * math.pi) for _ in range(4))] for i in range(141) for j in range(141)]
    for name, rings in (("comb", [straight]), ("turned comb", [turned]), ("islands", islands)):
        with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
            file.write("\n\n".join("\n".join(f"{x!r},{y!r}" for x, y in ring) for ring in rings) + "\n")
            file.flush()
            before = os.times()
            rows = cases.points("generate", "random", "-n", 1000, "-w", f"polygon:file={file.name}", "--with-pdf",
                                "--max-memory", "300M")
            after = os.times()
        area = sum(abs(sum(a[0] * b[1] - b[0] * a[1] for a, b in sides(ring))) for ring in rings) / 2
        cases.compare(f"area of the {name}", 1 / rows[0][2], area, 1e-10)
        seconds = after.children_user + after.children_system - before.children_user - before.children_system
        cases.expect(f"{name} takes two seconds at most", seconds < 2, f"{seconds:.2f} s")


# ---------------------------------------------------------------- meshes

def check_faces(cases):
    """Faces that are not convex: area of OBJ and PLY faces, points inside, refusals (rationals)"""
    rng = random.Random(3)
    for case in range(120):
        corners = rng.choice((4, 4, 5, 6, 8))
        ring = [(rng.randrange(7), rng.randrange(7)) for _ in range(corners)]
        if len(set(ring)) < corners or twice_area(ring) == 0:
            continue
        lift = rng.choice((lambda x, y: (x, y, 0), lambda x, y: (2, y, x), lambda x, y: (x, 3 * x - y, y)))
        corner = [lift(x, y) for x, y in ring]
        if case % 2 == 0:
            text = "".join(f"v {x} {y} {z}\n" for x, y, z in corner)
            text += "f " + " ".join(str(k + 1) for k in range(corners)) + "\n"
        else:
            text = ("ply\nformat ascii 1.0\n" + f"element vertex {corners}\n"
                    + "property float x\nproperty float y\nproperty float z\nelement face 1\n"
                    + "property list uchar int vertex_indices\nend_header\n"
                    + "".join(f"{x} {y} {z}\n" for x, y, z in corner)
                    + f"{corners} " + " ".join(str(k) for k in range(corners)) + "\n")
        factor = math.sqrt(11) if lift(1, 0)[1] == 3 else 1  # |(1, 3, 0) x (0, -1, 1)|
        with tempfile.NamedTemporaryFile("w", suffix=".obj" if case % 2 == 0 else ".ply") as file:
            file.write(text)
            file.flush()
            try:
                rows = cases.points("generate", "random", "-n", 40, "-w", f"mesh:file={file.name}", "--with-pdf")
            except RuntimeError as error:
                cases.expect(f"{ring} is refused", not is_simple(ring) and "face 1" in str(error), str(error))
                continue
        cases.expect(f"{ring} is taken", is_simple(ring))
        cases.compare(f"area of {ring}", 1 / rows[0][3], factor * abs(twice_area(ring)) / 2, 1e-13)
        plane = [(x, y) if lift(1, 0) == (1, 0, 0) else (z, y) if lift(1, 0)[0] == 2 else (x, z)
                 for x, y, z, _ in rows]
        cases.expect(f"points in {ring}", all(surrounds(ring, (Fraction(x), Fraction(y))) for x, y in plane))


def check_coincident_faces(cases):
    """Faces upon each other: chi-square accepts random points (p above 1e-5)"""
    square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nv 0.5 0.5 0\n"
    for faces in ("f 1 2 3\nf 1 2 3\n", "f 1 2 3\nf 3 1 2\nf 2 4 3\nf 1 2 4\n", "f 1 2 4 3\nf 1 2 5\nf 5 2 1\n"):
        with tempfile.NamedTemporaryFile("w", suffix=".obj") as file:
            file.write(square + faces)
            file.flush()
            for seed in (1, 2, 3):
                text = cases.run("generate", "random", "-n", 20000, "-s", seed, "-w", f"mesh:file={file.name}", "-f",
                                 "json")
                p = cases.results("chi-square", "-", text=text)["p_value"]
                cases.expect(f"{faces!r}, seed {seed}", p > 1e-5, p)


# ---------------------------------------------------------------- densities that go along

def check_densities(cases):
    """Columns pdf and weight through warps and back: density times that of the warp (closed forms)"""
    rng = random.Random(4)
    uniform = {"sphere": 1 / (4 * math.pi), "disk": 1 / math.pi, "disk:radius=2": 1 / (4 * math.pi),
               "triangle": 2.0, "hemisphere": None, "cylinder": None, "torus-surface": None}
    rows = [(rng.random(), rng.random(), rng.uniform(0.1, 3)) for _ in range(20)]
    table = "x,y,pdf\n" + "".join(f"{x!r},{y!r},{p!r}\n" for x, y, p in rows)
    weights = "x,y,weight\n" + "".join(f"{x!r},{y!r},{p!r}\n" for x, y, p in rows)
    plain = "x,y\n" + "".join(f"{x!r},{y!r}\n" for x, y, _ in rows)
    for warp, density in uniform.items():
        name, *settings = warp.replace("=", ":").split(":")
        words = ["warp", name] + (["--" + settings[0], settings[1]] if settings else [])
        own = [row[-1] for row in cases.points(*words, "-", "--with-pdf", text=plain)]
        for (_, _, p), image, weight, f in zip(rows, cases.points(*words, "-", text=table),
                                               cases.points(*words, "-", text=weights), own):
            if density is not None:
                cases.compare(f"density of {warp}", f, density, 1e-12)
            cases.compare(f"pdf by {warp}", image[-1], p * f, 1e-12)
            cases.compare(f"weight by {warp}", weight[-1], p / f, 1e-12)
        there = cases.run(*words, "-", "-f", "json", text=table)
        for (_, _, p), back in zip(rows, cases.points(*words, "--inverse", "-", text=there)):
            cases.compare(f"pdf back from {warp}", back[-1], p, 1e-12)


# ---------------------------------------------------------------- bases and lattices

def holds_one_each(rows, base, power):
    """Whether each elementary interval of b^power points in a base contains one (two coordinates)."""
    for first in range(power + 1):
        cells = {(int(x * base**first + 1e-9), int(y * base**(power - first) + 1e-9)) for x, y in rows}
        if len(cells) != base**power:
            return False
    return True


def check_bases(cases):
    """Scrambles of generators in bases other than 2 keep their nets (elementary intervals)"""
    for generator, base, power in (("faure --base 3", 3, 4), ("faure --base 5", 5, 3), ("niederreiter --base 3", 3, 4),
                                   ("niederreiter --base 7", 7, 2), ("sobol", 2, 7)):
        for scramble in ("owen", "digital-shift", "matrix"):
            for seed in range(1, 5):
                words = generator.split() + ["-n", base**power, "-s", seed]
                rows = cases.points("generate", *words, "-w", scramble)
                cases.expect(f"{generator} by {scramble}, seed {seed}", holds_one_each(rows, base, power))
                made = cases.run("generate", *words, "-f", "json")
                rows = cases.points("warp", scramble, "-", "-s", seed, text=made)
                cases.expect(f"file of {generator} by {scramble}, seed {seed}", holds_one_each(rows, base, power))
    for seed in range(1, 5):  # blocks of 2^a 3^b points of Halton meet each box once
        rows = cases.points("generate", "halton", "-n", 72, "-s", seed, "-w", "owen")
        cases.expect(f"halton, seed {seed}", len({(int(8 * x + 1e-9), int(9 * y + 1e-9)) for x, y in rows}) == 72)


def best_lattice(n, width):
    """Largest minimum distance of all lattices of n points in a box of this width and height 1."""
    best = 0
    for in_row in range(1, n + 1):
        if n % in_row:
            continue
        gap = n // in_row
        for shift in range(gap):
            least = min(width, 1)
            for row in range(gap):
                y = min(row * in_row, n - row * in_row) / n
                for x in range(row * shift % gap, n, gap):
                    if x or row:
                        least = min(least, math.hypot(width * min(x, n - x) / n, y))
            best = max(best, least)
    return best


def check_hexagonal(cases):
    """Hexagonal lattices in boxes: smallest distance on the torus (all lattices tried)"""
    for width in (1, 2, 0.4, 11, 0.57735):
        for n in list(range(1, 14)) + [24, 37]:
            rows = cases.points("generate", "hexagonal", "-n", n, "--bounds", f"0..{width},0..1")
            least = min([math.hypot(min(x, width - x), min(y, 1 - y)) for x, y in rows[1:]] + [width, 1])
            cases.compare(f"{n} points in {width} x 1", least, best_lattice(n, width), 1e-12)


def check_rank1_lattices(cases):
    """Rank-1 lattices by components: no coordinate is another where components suffice"""
    for n, d in ((128, 12), (128, 32), (64, 16), (101, 20), (256, 40), (1000, 60)):
        rows = cases.points("generate", "rank1-lattice", "-n", n, "-d", d)
        columns = {tuple(row[k] for row in rows) for k in range(d)}
        cases.expect(f"{n} points, {d} coordinates", len(columns) == d, len(columns))


# ---------------------------------------------------------------- sample elimination

def shapes():
    turn_around = 2 * math.pi

    def sphere(u, v, _):
        r = math.sqrt(max(0, 1 - (2 * u - 1)**2))
        return r * math.cos(turn_around * v), r * math.sin(turn_around * v), 2 * u - 1

    def torus(u, v, w):  # by area: v is drawn again where it is too small for the outer half
        a = turn_around * v
        if w * 1.3 > 1 + 0.3 * math.cos(a):
            a = math.pi - a
        r = 1 + 0.3 * math.cos(a)
        return r * math.cos(turn_around * u), r * math.sin(turn_around * u), 0.3 * math.sin(a)

    def tent(u, v, _):  # two squares with an edge in common, at a right angle
        return (2 * u, v, 0) if u < 0.5 else (1, v, 2 * u - 1)

    return {
        "sphere": (2, 4 * math.pi, sphere),
        "torus": (2, 4 * math.pi**2 * 0.3, torus),
        "folded sheet": (2, 2, tent),
        "circle": (1, turn_around, lambda u, v, w: (math.cos(turn_around * u), math.sin(turn_around * u))),
        "curve": (1, math.hypot(4 * math.pi, 3),
                  lambda u, v, w: (math.cos(2 * turn_around * u), math.sin(2 * turn_around * u), 3 * u)),
        "square": (2, 1, lambda u, v, w: (u, v)),
        "cube": (3, 1, lambda u, v, w: (u, v, w)),
    }


def mean_nearest(rows):
    return sum(min(math.dist(p, q) for j, q in enumerate(rows) if j != i) for i, p in enumerate(rows)) / len(rows)


def check_elimination(cases):
    """Elimination from points of curves, surfaces and bodies: as spread as where it is told (0.9)"""
    rng = random.Random(6)
    for name, (dimension, measure, point) in shapes().items():
        for n in (120, 1000):
            rows = [point(rng.random(), rng.random(), rng.random()) for _ in range(n)]
            with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
                file.write("".join(",".join(map(repr, row)) + "\n" for row in rows))
                file.flush()
                for ratio in (1.5, 2, 5, 20):
                    kept = int(n / ratio)
                    words = ["generate", "sample-elimination", "-n", kept, "--from", file.name]
                    found = mean_nearest(cases.points(*words))
                    told = mean_nearest(cases.points(*words, "--manifold-dimension", dimension, "--measure", measure))
                    drawn = sum(mean_nearest(rng.sample(rows, kept)) for _ in range(3)) / 3
                    cases.expect(f"{kept} of {n} on the {name}: told", found > 0.9 * told, (found, told))
                    cases.expect(f"{kept} of {n} on the {name}: drawn", found > drawn, (found, drawn))


def check_copies(cases):
    """Elimination from points with copies: copies go first"""
    rng = random.Random(7)
    for n in (5, 40, 200):
        different = [(rng.random(), rng.random()) for _ in range(n)]
        rows = [row for row in different for _ in range(rng.choice((1, 2, 3)))]
        rng.shuffle(rows)
        for kept in (1, n // 2, n, (n + len(rows)) // 2):
            text = "".join(f"{x!r},{y!r}\n" for x, y in rows)
            with tempfile.NamedTemporaryFile("w", suffix=".csv") as file:
                file.write(text)
                file.flush()
                left = cases.points("generate", "sample-elimination", "-n", kept, "--from", file.name)
            found = {tuple(row) for row in left}
            cases.expect(f"{kept} of {n} with copies", len(left) == kept and len(found) == min(kept, n), len(found))


def check_white(cases):
    """Capacity-constrained points of a density: none where it is 0"""
    rng = random.Random(8)
    for size, n in ((8, 50), (16, 300), (32, 1000)):
        values = [[rng.choice((0, 0, 1, 3)) if x < 0.6 * size else 0 for x in range(size)] for _ in range(size)]
        with tempfile.NamedTemporaryFile("wb", suffix=".npy") as file:
            header = f"{{'descr': '|u1', 'fortran_order': False, 'shape': ({size}, {size}), }}".ljust(117) + "\n"
            file.write(b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header.encode()
                       + bytes(v for row in values for v in row))
            file.flush()
            rows = cases.points("generate", "capacity-constrained", "-n", n, "--density", file.name, "--iterations", 20)
        white = [(x, y) for x, y in rows if values[int(y * size)][int(x * size)] == 0]
        cases.expect(f"{n} points of {size} x {size} pixels", len(rows) == n and not white, white[:3])
