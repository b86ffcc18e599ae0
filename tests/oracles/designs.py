"""Designs: optimised Latin hypercubes, weighted star discrepancies, two-level fractions, Hadamard matrices.

Independent code: all Latin hypercubes one by one, all boxes in rationals, words of fractions by products of columns, and
numbers of published tables.
"""
import itertools
import json
import math
from fractions import Fraction


def made(cases, *words):
    """Rows of a set, and what its provenance says of it, by name."""
    out = cases.run("generate", *words, "--meta", "-f", "txt")
    found = [line[len("# found: ") :] for line in out.splitlines() if line.startswith("# found: ")]
    rows = [[float(x) for x in line.split()] for line in out.splitlines() if not line.startswith("#")]
    return rows, json.loads(found[0]) if found else {}


# Latin hypercubes


def squared_centered_l2(rows):
    """By its definition, in rationals."""
    half = Fraction(1, 2)
    n, d = len(rows), len(rows[0])
    away = [[abs(x - half) for x in row] for row in rows]
    single = sum(math.prod(1 + a / 2 - a * a / 2 for a in row) for row in away)
    both = sum(
        math.prod(1 + a[k] / 2 + b[k] / 2 - abs(x[k] - y[k]) / 2 for k in range(d))
        for x, a in zip(rows, away)
        for y, b in zip(rows, away)
    )
    return Fraction(13, 12) ** d - Fraction(2, n) * single + both / n**2


def criterion_value(name, levels):
    """Of levels 0, ..., n - 1: less is better."""
    n, d = len(levels), len(levels[0])
    pairs = list(itertools.combinations(levels, 2))
    squares = [sum((a - b) ** 2 for a, b in zip(x, y)) for x, y in pairs]
    if name == "maximin":
        return (-min(squares), squares.count(min(squares)))
    if name == "phi-p":
        return math.fsum(s**-7.5 for s in squares) ** (1 / 15)
    if name == "audze-eglais":
        return math.fsum(1 / s for s in squares)
    if name == "maxpro":
        products = (math.prod((a - b) / n for a, b in zip(x, y)) for x, y in pairs)
        return (math.fsum(1 / p**2 for p in products) / len(pairs)) ** (1 / d)
    if name == "centered-l2":
        return math.sqrt(squared_centered_l2([[Fraction(2 * x + 1, 2 * n) for x in row] for row in levels]))
    means = [sum(row[k] for row in levels) / n for k in range(d)]
    length = sum((row[0] - means[0]) ** 2 for row in levels)
    return max(
        abs(sum((row[k] - means[k]) * (row[m] - means[m]) for row in levels)) / length
        for k, m in itertools.combinations(range(d), 2)
    )


criteria = ("maximin", "phi-p", "audze-eglais", "centered-l2", "maxpro", "correlation")


def levels_of(rows):
    return [[math.floor(x * len(rows)) for x in row] for row in rows]


def check_small_latin_hypercubes(cases):
    """The best of all Latin hypercubes of few points, by every criterion"""
    for n, d in ((2, 2), (3, 2), (4, 2), (5, 2), (6, 2), (7, 2), (2, 4), (3, 3), (3, 4), (4, 3), (5, 3)):
        orders = list(itertools.permutations(range(n)))
        half = [order for order in orders if order <= tuple(n - 1 - x for x in order)]  # others are their images
        best = dict.fromkeys(criteria, (math.inf, 0))
        for columns in itertools.combinations_with_replacement(half, d - 1):
            levels = list(zip(range(n), *columns))
            for name in criteria:
                if name == "centered-l2" and (n, d) == (5, 3):
                    continue  # rationals take too long
                value = criterion_value(name, levels)
                best[name] = min(best[name], value if isinstance(value, tuple) else (value, 0))
        for name, value in best.items():
            if value[0] == math.inf:
                continue
            rows, _ = made(cases, "latin-hypercube", "-n", n, "-d", d, "--centered", "--optimize", name)
            ours = criterion_value(name, levels_of(rows))
            ours = ours if isinstance(ours, tuple) else (ours, 0)
            cases.compare(f"{name} of {n}^{d}", ours[0], value[0], 1e-12, 1e-15)
            cases.expect(f"{name} of {n}^{d}, pairs", ours[1] == value[1], ours[1])


def check_latin_effort(cases):
    """More effort of a Latin hypercube's search is never worse"""
    efforts = (1e-6, 1e-5, 3e-5, 1e-4, 2e-4, 5e-4, 1e-3, 3e-3)
    for name, (n, d), seed in itertools.product(criteria, ((9, 3), (20, 4), (40, 2)), (1, 2)):
        least = None
        for effort in efforts:
            words = ("-n", n, "-d", d, "--centered", "--optimize", name, "--seed", seed, "--effort", effort)
            rows, _ = made(cases, "latin-hypercube", *words)
            value = criterion_value(name, levels_of(rows))
            cases.expect(f"{name} of {n}^{d}, seed {seed}, effort {effort}", least is None or value <= least, value)
            least = value


# Optimised sets


def weighted_star(rows, weights):
    """Largest local discrepancy of boxes at the origin, times the weights of the axes on which they end below 1."""
    n, d = len(rows), len(rows[0])
    rows = [[Fraction(x) for x in row] for row in rows]
    weights = [Fraction(w) for w in weights]
    ends = []  # of an axis: a place, whether just below 1, and the weight
    for k in range(d):
        values = sorted({row[k] for row in rows})
        ends.append([(x, weights[k]) for x in values] + [(Fraction(1), weights[k]), (Fraction(1), Fraction(1))])
    worst = Fraction(0)
    for corner in itertools.product(*ends):
        weight = math.prod(w for _, w in corner)
        volume = math.prod(x for x, _ in corner)
        inside = sum(all(x < end for x, (end, _) in zip(row, corner)) for row in rows)
        within = sum(all(x <= end for x, (end, _) in zip(row, corner)) for row in rows)
        worst = max(worst, weight * (volume - Fraction(inside, n)), weight * (Fraction(within, n) - volume))
    return worst


def check_weights(cases):
    """Weighted star discrepancies by all boxes, in rationals"""
    for n, weights in itertools.product(
        (1, 2, 5, 9),
        ((0.3,), (2,), (1, 0.25), (2, 0.5), (1.5, 0.3), (3, 7), (0.1, 0.2), (2, 1, 0.5), (0.3, 0.7, 1.1), (4, 2, 3),
         (1.5, 0.5, 0.25, 2)),
    ):
        if n > 5 and len(weights) > 3:
            continue
        words = ("-n", n, "-d", len(weights), "--weights", ",".join(map(str, weights)), "--effort", 1e-5)
        rows, found = made(cases, "optimized", *words)
        right = float(weighted_star(rows, weights))
        cases.compare(f"weights {weights}, {n} points", found["star_discrepancy"], right, 4e-16)


def check_weights_of_l2(cases):
    """Weighted L2 star discrepancies by their definition, in rationals"""
    for n, weights in itertools.product((2, 7), ((2, 0.5), (1.5, 0.3, 4))):
        words = ("-n", n, "-d", len(weights), "--weights", ",".join(map(str, weights)), "--effort", 1e-5)
        rows, found = made(cases, "optimized", "--objective", "l2-star", *words)
        rows = [[Fraction(x) for x in row] for row in rows]
        g = [Fraction(w) for w in weights]
        single = sum(math.prod(1 + w * (1 - x * x) / 2 for x, w in zip(row, g)) for row in rows)
        both = sum(math.prod(1 + w * (1 - max(x, y)) for x, y, w in zip(a, b, g)) for a in rows for b in rows)
        square = math.prod(1 + w / 3 for w in g) - Fraction(2, n) * single + both / n**2
        cases.compare(f"l2-star, weights {weights}", found["l2_star_discrepancy"], math.sqrt(square), 1e-14)


# Two-level fractions

# Least distances of the best binary linear codes with r check digits (A. E. Brouwer, T. Verhoeff, IEEE Trans. Inf. Theory
# 39 (1993) 662-677, as of 2006): from each length on.
best_distances = {
    4: "5:5 6:4 9:3", 5: "6:6 7:4 17:3", 6: "7:7 8:5 9:4 33:3", 7: "8:8 9:6 10:5 12:4", 8: "9:9 10:6 13:5 18:4",
    9: "10:10 11:7 12:6 19:5 24:4", 10: "11:11 12:8 13:7 16:6 25:5 34:4", 11: "12:12 13:8 17:7 24:6 35:5 48:4",
    12: "13:13 14:9 15:8 25:6 49:5",
}  # fmt: skip

# U. Groemping's catalogue (J. Stat. Softw. 56 (2014) 1), of Chen, Sun and Wu (1993) and Xu (2009).
catalogue = {  # runs: factors, and words of three, four and five letters
    16: """
        5:0,0,1 6:0,3,0 7:0,7,0 8:0,14,0 9:4,14,8 10:8,18,16 11:12,26,28 12:16,39,48 13:22,55,72 14:28,77,112
        15:35,105,168""",
    32: """
        6:0,0,0 7:0,1,2 8:0,3,4 9:0,6,8 10:0,10,16 11:0,25,0 12:0,38,0 13:0,55,0 14:0,77,0 15:0,105,0 16:0,140,0
        17:8,140,112 18:16,148,224 19:24,164,344 20:32,188,480 21:40,220,641 22:48,263,832 23:56,315,1064
        24:64,378,1344 25:76,442,1656 26:88,518,2032 27:100,606,2484 28:112,707,3024 29:126,819,3640 30:140,945
        31:155,1085""",
    64: """
        7:0,0,0 8:0,0,2 9:0,1,4 10:0,2,8 11:0,4,14 12:0,6,24 13:0,14,28 14:0,22,40 15:0,30,60 16:0,43,81 17:0,59,108
        18:0,78,144 19:0,100,192 20:0,125,256 21:0,204,0 22:0,250,0 23:0,304,0 24:0,365,0 25:0,435,0 26:0,515,0
        27:0,605,0 28:0,706,0 29:0,819,0 30:0,945,0 31:0,1085,0 32:0,1240,0 33:16,1240 34:32,1256 35:48,1288
        36:64,1336 37:80,1400 38:96,1480 39:112,1577 40:128,1691 41:144,1822 42:160,1970 43:176,2145
        44:192,2334 45:208,2543 46:224,2773 47:240,3025 48:256,3300 49:280,3556 50:304,3836""",
    128: """
        8:0,0,0 9:0,0,0 10:0,0,3 11:0,0,6 12:0,1,8 13:0,2,16 14:0,3,24 15:0,7,32 16:0,10,48 17:0,15,60 18:0,20,80
        19:0,27,120 20:0,36,152 21:0,51,200 22:0,65,248 23:0,83,316 24:0,102,384 25:0,124,482 26:0,152,568
        27:0,180,690 28:0,210,840 29:0,266,945 30:0,335,972 31:0,391,1134 32:0,452,1322 33:0,518,1543 34:0,589,1800
        35:0,665,2100 36:0,756,2401 37:0,854,2744 38:0,959,3136 39:0,1071,3584 40:0,1190,4096 41:0,1648,0
        42:0,1822,0 43:0,2009,0 44:0,2214,0 45:0,2430,0 46:0,2665,0 47:0,2915,0 48:0,3180,0 49:0,3466,0 50:0,3770,0""",
    256: """
        9:0,0,0 10:0,0,0 11:0,0,0 12:0,0,0 13:0,0,3 14:0,0,9 15:0,0,15 16:0,0,24 17:0,0,34 18:0,3,36 19:0,4,48
        20:0,5,64 21:0,9,104 22:0,14,137 23:0,20,172 24:0,26,216 25:0,34,262 26:0,43,325 27:0,53,395 28:0,64,476
        29:0,78,579 30:0,93,672 31:0,113,792 32:0,133,932""",
    512: """
        10:0,0,0 11:0,0,0 12:0,0,0 13:0,0,0 14:0,0,0 15:0,0,0 16:0,0,0 17:0,0,0 18:0,0,0 19:0,0,12 20:0,0,16
        21:0,0,21 22:0,0,63 23:0,0,84 24:0,2,102""",
}

letters = "ABCDEFGHJKLMNOPQRSTUVWXYZabcdefghjklmnopqrstuvwxyz"


def words_by_length(columns, digits):
    """Sets of columns with the sum 0, by size: from the weights of sums of rows, by MacWilliams' identity."""
    k = len(columns)
    rows = [sum((column >> j & 1) << i for i, column in enumerate(columns)) for j in range(digits)]
    weights = [0] * (k + 1)
    total = 0
    for i in range(1 << digits):
        weights[total.bit_count()] += 1
        total ^= rows[((i + 1) & -(i + 1)).bit_length() - 1] if i + 1 < 1 << digits else 0
    counts = [0] * (k + 1)
    for w, times in enumerate(weights):
        if times == 0:
            continue
        for t in range(k + 1):
            counts[t] += times * sum((-1) ** j * math.comb(w, j) * math.comb(k - w, t - j) for j in range(min(w, t) + 1))
    return [count >> digits for count in counts]


def columns_of(found, factors):
    """The columns that the generators name."""
    equations = dict(part.split("=") for part in found["generators"].split(","))
    basic = [letter for letter in letters[:factors] if letter not in equations]
    columns = {letter: 1 << j for j, letter in enumerate(basic)}
    for letter, word in equations.items():
        columns[letter] = sum(columns[x] for x in word)
    return [columns[letter] for letter in letters[:factors]], len(basic)


def text_of(counts):
    return ", ".join(f"{count} of {t}" for t, count in enumerate(counts) if t > 0 and count > 0)


def check_fractions_by_products(cases):
    """Words of two-level fractions by products of the columns of their points"""
    for digits in (3, 4, 5, 6):
        for factors in range(digits + 1, min(12, (1 << digits) - 1) + 1):
            rows, found = made(cases, "fractional-factorial", "-n", 1 << digits, "-d", factors)
            columns = [sum((row[k] > 0.5) << i for i, row in enumerate(rows)) for k in range(factors)]
            everything = (1 << len(rows)) - 1
            counts = [0] * (factors + 1)
            sums = [0] * (1 << factors)
            for chosen in range(1, 1 << factors):
                lowest = (chosen & -chosen).bit_length() - 1
                sums[chosen] = sums[chosen & (chosen - 1)] ^ columns[lowest]
                counts[chosen.bit_count()] += sums[chosen] in (0, everything)
            cases.expect(f"{factors} in {len(rows)}", text_of(counts) == found["word_lengths"], found["word_lengths"])


def check_resolutions(cases):
    """Resolutions of two-level fractions against the table of the best codes"""
    for digits, text in best_distances.items():
        starts = [tuple(map(int, part.split(":"))) for part in text.split()]
        ends = [start - 1 for start, _ in starts[1:]] + [min(50, (1 << digits) - 1)]
        for (start, distance), end in zip(starts, ends):
            for factors in range(start, end + 1) if digits < 10 else sorted({start, end}):
                _, found = made(cases, "fractional-factorial", "-n", 1 << digits, "-d", factors)
                columns, basic = columns_of(found, factors)
                counts = words_by_length(columns, digits)
                least = next(t for t in range(1, factors + 1) if counts[t] > 0)
                what = f"{factors} factors in {1 << digits} runs"
                cases.expect(what, basic == digits and least == distance, least)
                cases.expect(f"{what}, words", text_of(counts) == found["word_lengths"], found["word_lengths"])


def check_aberration(cases):
    """Words of three to five letters of two-level fractions against a published catalogue"""
    for runs, text in catalogue.items():
        for part in text.split():
            factors, *words = (int(word) for word in part.replace(":", ",").split(","))
            if factors > 50:
                continue
            _, found = made(cases, "fractional-factorial", "-n", runs, "-d", factors)
            ours = {int(t): int(count) for count, t in (word.split(" of ") for word in found["word_lengths"].split(", "))}
            ours = [ours.get(t, 0) for t in range(3, 3 + len(words))]
            cases.expect(f"{factors} factors in {runs} runs", ours == words if runs <= 64 else ours <= words, ours)


def check_few_generators(cases):
    """The least aberration of fractions with up to three generators, by all defining relations"""
    for generators in (1, 2, 3):
        kinds = range(1, 1 << generators)  # a factor's words, among the products of the generators
        for factors in range(generators + 2, 13):
            if factors > (1 << (factors - generators)) - 1:
                continue
            best = None
            for sizes in itertools.combinations(range(factors + len(kinds)), len(kinds)):
                numbers = [b - a - 1 for a, b in zip((-1, *sizes), sizes)]  # of each kind; others are in no word
                lengths = [sum(x for x, kind in zip(numbers, kinds) if (kind & word).bit_count() % 2) for word in kinds]
                counts = [lengths.count(t) for t in range(factors + 1)]
                best = counts if best is None else min(best, counts)
            _, found = made(cases, "fractional-factorial", "-n", 1 << (factors - generators), "-d", factors)
            cases.expect(f"{factors} factors, {generators} generators", text_of(best) == found["word_lengths"], best)
            cases.expect(f"{factors} factors, {generators} generators, said", found["search"] == "complete")


# Hadamard matrices


def check_hadamard(cases):
    """Plackett-Burman designs of orders that once were open: any two columns and any two rows are orthogonal"""
    for order in (92, 116, 156, 172, 184, 188, 232, 236, 260, 268, 292, 324, 356, 372, 376, 404, 412, 428, 436, 452, 472,
                  476, 508, 520, 532, 536, 584, 596, 604, 612, 652, 664, 12, 36, 52, 100, 724):  # fmt: skip
        rows = cases.points("generate", "plackett-burman", "-n", order)
        bits = [1 + sum((x > 0.5) << (k + 1) for k, x in enumerate(row)) for row in rows]
        whole = len(rows) == order and all(len(row) == order - 1 for row in rows)
        pairs = itertools.combinations(bits, 2)
        cases.expect(f"order {order}", whole and all(2 * (a ^ b).bit_count() == order for a, b in pairs))
