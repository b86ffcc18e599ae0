%part reserved
False None True and as assert async await break class continue def del elif else except finally for from global if import in is
lambda nonlocal not or pass raise return try while with yield match case type
%part file
# SPDX-License-Identifier: MIT. Copyright (c) 2026 The stipple authors.
"""
{{title}}

@@(index, dimension, seed) is coordinate `dimension`, from 0 to {{last}}, of point `index`.
%if warped
@point(index, seed) is a list of all coordinates of a point, with their images under warps.
%end

Written by stipple {{version}}:

    {{command}}

The numbers are those of 'stipple generate', to the last bit, for all seeds and for indices below
{{end}}, in Python 3 without packages.

Points as stipple prints them:

    {{points}}

Source: {{source}}
"""
%if cached
from functools import lru_cache
%end
%if warped
import math
import struct

%else
%if cached

%end
%end
WORD = 0xffffffffffffffff  # 64 bits


{{parts}}
%part point
def @point(index, seed):
    """Point `index`, with its images under warps."""
    point = [0.0] * {{out}}
    {{statements}}
    return point
%part philox
def @random(seed, stream, i):
    """64 random bits, number i of a stream: Philox 4x32 with ten rounds.

    Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, SC11 (2011), doi:10.1145/2063384.2063405.
    """
    mask = 0xffffffff
    a, b, c, d = i // 2 & mask, i // 2 >> 32, stream & mask, stream >> 32
    low, high = seed & mask, seed >> 32
    for _ in range(10):
        p, q = 0xd2511f53 * a, 0xcd9e8d57 * c
        a, b, c, d = (q >> 32) ^ b ^ low, q & mask, (p >> 32) ^ d ^ high, p & mask
        low, high = low + 0x9e3779b9 & mask, high + 0xbb67ae85 & mask
    return d << 32 | c if i % 2 else b << 32 | a
%part unit
def @unit(fraction):
    """The first 53 binary digits of a fraction of 64 bits."""
    return (fraction >> 11) * 2.0**-53
%part ratio
def @ratio(a, b):
    """a / b to the nearest double, at most 1 - 2^-53."""
    return min(a / b, 1 - 2.0**-53)
%part owen
%use cached
%need philox
def @hash(x, key):
    """A bijective hash of 32 bits with a key in the middle (constants: C. Wellons, lowbias32)."""
    x ^= x >> 16
    x = x * 0x7feb352d & 0xffffffff
    x ^= x >> 15
    x = (x + key) * 0x846ca68b & 0xffffffff
    return x ^ x >> 16


def @flips(random, digits):
    """Flips for five digits: one random bit for each node on their path down a binary tree."""
    path = 32 | digits
    return sum((random >> (path >> (5 - level)) & 1) << (4 - level) for level in range(5))


{{cache}}
def @keys(dimension, seed):
    """Keys of the hashes for groups of five digits, and for the first thirty digits."""
    keys = [@random(seed, 0x100000003, 12 * dimension + g) for g in range(12)]
    return [key >> 32 for key in keys], [key & 0xffffffff for key in keys]


def @owen(fraction, dimension, seed):
    """Nested uniform scrambling: flips each binary digit at random, depending on the digits before it.

    Thirty digits, and then twenty-five, are scrambled in groups of five. Source: A. B. Owen (1995),
    doi:10.1007/978-1-4612-2552-2_19.
    """
    high, low = fraction >> 34, fraction >> 9 & 0x1ffffff
    before, between = @keys(dimension, seed)
    new_high, new_low = high, low
    for g in range(6):
        shift = 25 - 5 * g
        new_high ^= @flips(@hash(high >> (shift + 5) ^ before[g], between[g]), high >> shift & 31) << shift
    above = @hash(high ^ before[11], between[11])
    for g in range(5):
        shift = 20 - 5 * g
        node = (low >> (shift + 5) ^ before[6 + g]) + above * (2 * before[g] + 1) & 0xffffffff
        new_low ^= @flips(@hash(node, between[6 + g]), low >> shift & 31) << shift
    return new_high << 34 | new_low >> 2 << 11
%part sobol
%use directions
%need unit
%if scramble owen
%need owen
%end
%if scramble digital-shift matrix
%need philox
%end
# Columns of the generating matrices, 52 for each dimension; the first digit is the top bit of 64.
@COLUMNS = [
    {{columns}}
]


%if scramble matrix
%use cached
{{cache}}
def @matrix(dimension, seed):
    """Columns of a random lower triangular matrix. Source: J. Matousek (1998), doi:10.1006/jcom.1998.0489."""
    digits = [1 << (63 - j) for j in range(53)]
    return [digit | @random(seed, 0x100000002, 64 * dimension + j) & (digit - 1) for j, digit in enumerate(digits)]


def @product(fraction, dimension, seed):
    """A random matrix times the digits."""
    product = 0
    for j, column in enumerate(@matrix(dimension, seed)):
        if fraction >> (63 - j) & 1:
            product ^= column
    return product


%end
def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index`, in [0, 1)."""
%if order gray
    index ^= index >> 1  # Gray code
%end
    fraction = 0
    for j in range(52):
        if index >> j & 1:
            fraction ^= @COLUMNS[52 * dimension + j]
%if scramble digital-shift
    fraction ^= @random(seed, 0x100000001, dimension)
%end
%if scramble matrix
    fraction = @product(fraction, dimension, seed) ^ @random(seed, 0x100000001, dimension)
%end
%if scramble owen
    fraction = @owen(fraction, dimension, seed)
%end
    return @unit(fraction)
%part van-der-corput
%need ratio
def @@(index, dimension, seed):
    """Point `index`, in [0, 1): its digits in base {{base}}, mirrored at the point."""
    reverse, power = 0, 1
    while index:
        reverse = reverse * {{base}} + index % {{base}}
        power *= {{base}}
        index //= {{base}}
    return @ratio(reverse, power)
%part hammersley
%need ratio
@BASES = [
    {{bases}}
]


def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index` of {{count}}, in [0, 1)."""
%if sweep first
    if dimension == 0:
%else
    if dimension == {{last}}:
%end
%if offset 0
        return @ratio(index, {{count}})
%else
        return @ratio(2 * index + 1, 2 * {{count}})
%end
    base, reverse, power = @BASES[dimension], 0, 1
    while index:
        reverse = reverse * base + index % base
        power *= base
        index //= base
    return @ratio(reverse, power)
%part halton
%if scramble owen
%need nested
%else
%if scramble permutation
%need permuted_inverse
%else
%need ratio
%end
%end
@BASES = [
    {{bases}}
]
%if scramble faure

# Faure's permutations of the digits of each base, and where each begins.
@IMAGES = [
    {{images}}
]
@BEGINS = [
    {{begins}}
]
%end


def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index`, in [0, 1)."""
%if scramble owen
    return @nested(index, @BASES[dimension], dimension, seed)
%else
%if scramble permutation
    return @permuted_inverse(index, @BASES[dimension], dimension, seed)
%else
    base, reverse, power = @BASES[dimension], 0, 1
    while index:
%if scramble none
        reverse = reverse * base + index % base
%end
%if scramble faure
        reverse = reverse * base + @IMAGES[@BEGINS[dimension] + index % base]
%end
%if scramble reverse
        reverse = reverse * base + -index % base
%end
        power *= base
        index //= base
    return @ratio(reverse, power)
%end
%end
%part permuted_inverse
%use cached
%need philox
%need unit
{{cache}}
def @images(position, base, dimension, seed):
    """The random permutation of the digits at a position: Fisher and Yates's shuffle."""
    images = list(range(base))
    for left in range(base, 1, -1):
        other = @random(seed, dimension, position * base + left - 1) * left >> 64
        images[left - 1], images[other] = images[other], images[left - 1]
    return images


def @permuted_inverse(index, base, dimension, seed):
    """Radical inverse with a random permutation of the digits for each position.

    Source: A. B. Owen, arXiv:1706.02808 (2017).
    """
    low, block, position = 0, 1, 0
    while position == 0 or block * base <= 1024:  # the low digits, as an integer
        low = low * base + @images(position, base, dimension, seed)[index % base]
        block, position, index = block * base, position + 1, index // base
    end, reach = position, block
    while reach < 2**53:
        end, reach = end + 1, reach * base
    whole, power = 0, 1
    while index:  # the other digits; each of the zeros that follow is permuted, too
        whole = whole * base + @images(position, base, dimension, seed)[index % base]
        power, position, index = power * base, position + 1, index // base
    zeros = @unit(@random(seed, dimension, end * base))
    for at in range(end - 1, position - 1, -1):
        zeros = (@images(at, base, dimension, seed)[0] + zeros) / base
    margin = block * 2.0**-51
    rest = min(max((whole + zeros) / power, margin), 1 - margin)
    return (low + rest) / block
%part nested
%need owen
%need unit
%need ratio
def @digit_hash(digit, prefix):
    """Hash of a digit after a prefix."""
    return @hash((prefix & 0xffffffff) + digit * 0x9e3779b9 & 0xffffffff, prefix >> 32)


def @nested(index, base, dimension, seed):
    """Radical inverse with nested uniform scrambling.

    There is a random permutation of each digit for each choice of the digits before it. The digits after
    the last one form a uniform number.
    """
    if base == 2:
        return @unit(@owen(int(f"{index:064b}"[::-1], 2), dimension, seed))
    key = [@random(seed, 0x100000006, 3 * dimension + j) for j in range(3)]
    rest, prefix, place, image, leading, depth = index, 0, 1, 0, 1, 0
    while True:
        random = (prefix ^ key[0]) * 0xbf58476d1ce4e5b9 & WORD  # splitmix64, with two keys
        random = (random ^ random >> 32) + key[1] & WORD
        random = random * 0x94d049bb133111eb & WORD
        random = (random ^ random >> 29) * 0xbf58476d1ce4e5b9 & WORD
        random ^= random >> 32
        if rest == 0:
            break
        # `leading` is base^(number of zeros at the end of the prefix).
        digit = rest % base
        turned = (random * leading & WORD) * base >> 64
        if digit > 0:
            node = random ^ key[2] * (2 * depth + 1) & WORD
            own = @digit_hash(digit, node), digit
            turned += 1 + sum((@digit_hash(other, node), other) < own for other in range(1, base))
        image = image * base + turned % base
        prefix += digit * place
        place *= base
        leading = 1 if digit > 0 else leading * base
        rest //= base
        depth += 1
    if place > 2**50:
        return @ratio(2 * image + 1, 2 * place)
    margin = place * 2.0**-51
    return (image + (margin + (1 - 2 * margin) * @unit(random))) / place
%part kronecker
%need unit
# Steps along each coordinate, as high and low halves of fractions of 128 bits; and point 0.
@STEPS = [
    {{steps}}
]
@BEGIN = [
    {{begin}}
]


def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index`, in [0, 1)."""
    high, low = @STEPS[2 * dimension : 2 * dimension + 2]
    position = (@BEGIN[0] << 64 | @BEGIN[1]) + index * (high << 64 | low)
    return @unit(position >> 64 & WORD)
%use alpha offset
%part rank1-lattice
# Generating vector.
@VECTOR = [
    {{z}}
]


def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index` of {{count}}, in [0, 1)."""
    return index * @VECTOR[dimension] % {{count}} / {{count}}
%use rule multiplier vector vector-file decay weights effort
%part stratum
def @stratum(low, width, parts, u):
    """The point low + width u of [0, parts), divided by parts.

    It is the middle where rounding would reach an edge of [low, low + width).
    """
    x = (low + width * u) / parts
    return x if low < x * parts < low + width else (2 * low + width) / (2 * parts)
%part jittered
%limit count 4398046511104
%if cell random
%need philox
%need unit
%need stratum
%end
%if sides
@SIDES = [
    {{sides}}
]


%end
def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index` of {{count}}, in [0, 1)."""
%if sides
    low, width, parts = index, 1, @SIDES[dimension]
    for side in @SIDES[:dimension]:
        low //= side
    low %= parts
%else
    # Row r of rows has the cells r n / rows to (r + 1) n / rows - 1, rounded down.
    n, rows = {{count}}, {{rows}}
    row = ((index + 1) * rows - 1) // n
    begin = row * n // rows
    cells = (row + 1) * n // rows - begin
    low, width, parts = (index - begin, 1, cells) if dimension == 0 else (begin, cells, n)
%end
%if cell random
    return @stratum(low, width, parts, @unit(@random(seed, 0, {{dimension}} * index + dimension)))
%else
    return (low + width / 2) / parts
%end
%use shape
%part permuted
def @numbers(state):
    """Numbers of SplitMix64. Source: G. L. Steele, D. Lea, C. H. Flood, OOPSLA (2014)."""
    while True:
        state = state + 0x9e3779b97f4a7c15 & WORD
        z = (state ^ state >> 30) * 0xbf58476d1ce4e5b9 & WORD
        z = (z ^ z >> 27) * 0x94d049bb133111eb & WORD
        yield z ^ z >> 31


def @permuted(i, size, key):
    """Image of i under a random permutation of 0, ..., size - 1.

    A small one is shuffled; else it is a cipher that is repeated until the image is below size.
    """
    numbers = @numbers(key)
    if size <= 64:
        images = list(range(size))
        for last in range(size):
            j = next(numbers) * (last + 1) >> 64
            images[last] = images[j]
            images[j] = last
        return images[i]
    width = (size - 1).bit_length()
    keys = [next(numbers) >> (64 - width) for _ in range(24)]
    while True:
        for flip, factor in zip(keys[::2], keys[1::2]):
            i = (i ^ flip) * (factor | 1) % 2**width
            i ^= i >> (width + 1) // 2
        if i < size:
            return i
%part multi-jittered
%limit count 1125899906842624
%need philox
%need permuted
%if centered false
%need unit
%need stratum
%end
def @strip(i, dimension, seed):
    """The strip along axis `dimension`, of {{count}}, of the point in cell i."""
    n, columns = {{count}}, {{columns}}
    row, column = divmod(i, columns)
    rows = n // columns
%if rest
    rest = n % columns
    # The points of the last row are evenly spread over the columns.
    phase = @random(seed, 4, 1) * columns >> 64
    turn = @random(seed, 4, 2) * n >> 64
    if row == rows:
        column = ((column + 1) * columns - phase - 1) // rest
        if dimension == 1:
            return row * columns + @permuted(i % columns, rest, @random(seed, 4, 0))
%end
    if dimension == 1:
        return row * columns + @permuted(column, columns, @random(seed, 3, row))
%if rest
    before = (column * rest + phase) // columns
    if ((column + 1) * rest + phase) // columns > before:
        row = @permuted(row, rows + 1, @random(seed, 2, column))
    else:
        row = @permuted(row, rows, @random(seed, 1, column))
    return (column * rows + before + row + turn) % n
%else
    return column * rows + @permuted(row, rows, @random(seed, 1, column))
%end


def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index` of {{count}}, in [0, 1)."""
%if order shuffled
    strip = @strip(@permuted(index, {{count}}, @random(seed, 0, 0)), dimension, seed)
%else
    strip = @strip(index, dimension, seed)
%end
%if centered true
    return (strip + 0.5) / {{count}}
%else
    return @stratum(strip, 1, {{count}}, @unit(@random(seed, 2**31 + dimension, index)))
%end
%use shape
%part correlated-multi-jittered
%limit count 1125899906842624
%need philox
%need permuted
%if centered false
%need unit
%need stratum
%end
def @@(index, dimension, seed):
    """Coordinate `dimension` of point `index` of {{count}}, in [0, 1)."""
    columns = {{columns}}
    rows = -(-{{count}} // columns)
%if order shuffled
    strip, strips = @permuted(index, {{count}}, @random(seed, 0, 0)), {{count}}
%else
    strip, strips = index, {{count}}
%end
    if dimension == 0:
        row, column = divmod(strip, columns)
        strip = @permuted(column, columns, @random(seed, 1, 0)) * rows
        strip += @permuted(row, rows, @random(seed, 2, 0))
        strips = columns * rows
%if centered true
    return (strip + 0.5) / strips
%else
    return @stratum(strip, 1, strips, @unit(@random(seed, 2**31 + dimension, index)))
%end
%use shape
%part cos_sin
def @cos_sin_eighth(t):
    """Cosine and sine of an angle in [-1/8, 1/8] turns, within a unit in the last place."""
    head, tail = 6.283185243606567, 6.357301909411278e-08  # 2 pi in 26 bits, and the rest of it
    bits = struct.unpack("<Q", struct.pack("<d", t))[0]
    upper = struct.unpack("<d", struct.pack("<Q", bits & ~0x7ffffff))[0]
    rest = (t - upper) * head + t * tail
    y = upper * head + rest
    y_low = (upper * head - y) + rest
    z = y * y
    half = 0.5 * z
    s = c = 0.0  # 1/17!, 1/15!, ..., 1/3! and 1/16!, 1/14!, ..., 1/4! with alternating signs
    for n in range(17, 1, -2):
        s = s * z + (1 if n % 4 == 1 else -1) / math.factorial(n)
    for n in range(16, 2, -2):
        c = c * z + (1 if n % 4 == 0 else -1) / math.factorial(n)
    near1 = 1 - half
    cosine = near1 + (((1 - near1) - half) + (z * z * c - y * y_low))
    return cosine, y + (y * z * s + y_low * near1)
%part cos_sin_turns
%need cos_sin
def @cos_sin(turns):
    """Cosine and sine of an angle in [0, 1] turns."""
    quarter = round(4 * turns)
    c, s = @cos_sin_eighth(turns - 0.25 * quarter)
    c, s = ((c, s), (-s, c), (-c, -s), (s, -c))[quarter % 4]
    return c + 0.0, s + 0.0
%part concentric
%need cos_sin
def @concentric(u, v):
    """Concentric map of the unit square to the unit disk.

    Source: P. Shirley, K. Chiu (1997), doi:10.1080/10867651.1997.10487479.
    """
    a, b = 2 * u - 1, 2 * v - 1
    wide = abs(a) > abs(b)
    r, across = (a, b) if wide else (b, a)
    c, s = @cos_sin_eighth(0.125 * (across / (r or 1)))
    return (r * c, r * s) if wide else (r * s, r * c)
%part polar
%need cos_sin_turns
def @polar(u, v):
    """Polar map of the unit square to the unit disk."""
    r = math.sqrt(u)
    c, s = @cos_sin(v)
    return r * c, r * s
%part disk
%if method concentric
%need concentric
%else
%need polar
%end
%if method rejection naive
%refuse --warp {{name}}: method {{method}} cannot be emitted; polar and concentric can
%end
def {{function}}(u, v):
    """{{summary}}: method {{method}}, centre {{center}}, radius {{radius}}."""
%if method concentric
    x, y = @concentric(u, v)
%else
    x, y = @polar(u, v)
%end
    return {{center.0}} + {{radius}} * x, {{center.1}} + {{radius}} * y
%part triangle
def {{function}}(u, v):
    """{{summary}}: method {{method}}, vertices {{vertices.text}}."""
    vertex = [
        {{vertices}}
    ]
%if method sqrt
    root = math.sqrt(u)
    l0, l1, l2 = 1 - root, root * v, root * (1 - v)
%else
    most, half = max(u, v), 0.5 * min(u, v)
    l0 = 1 - most
    l1, l2 = (most - half, half) if u > v else (half, most - half)
%end
    a, b, c = vertex[:{{dims}}], vertex[{{dims}} : 2 * {{dims}}], vertex[2 * {{dims}} :]
    return tuple(l0 * p + l1 * q + l2 * r for p, q, r in zip(a, b, c))
%part direction
%need cos_sin_turns
def @direction(below, above, longitude):
    """Direction with 1 - cos and 1 + cos of its angle from the z axis, and a longitude in turns."""
    r = math.sqrt(below * above)
    c, s = @cos_sin(longitude)
    return r * c, r * s, 0.5 * (above - below)
%part sphere
%need direction
%if method z
%else
%refuse --warp {{name}}: method {{method}} cannot be emitted; z can
%end
def {{function}}(u, v):
    """{{summary}}: centre {{center}}, radius {{radius}}."""
    x, y, z = @direction(2 * u, 2 * (1 - u), v)
    return (
        {{center.0}} + {{radius}} * x,
        {{center.1}} + {{radius}} * y,
        {{center.2}} + {{radius}} * z,
    )
%part hemisphere
%if axis 0,0,1
%else
%refuse --warp {{name}}: axis {{axis}} cannot be emitted; 0,0,1 can
%end
%if method cosine-power
%refuse --warp {{name}}: method {{method}} cannot be emitted; uniform and cosine can
%end
%if method uniform
%need direction
%else
%if disk concentric
%need concentric
%else
%need polar
%end
%end
def {{function}}(u, v):
    """{{summary}}: method {{method}}, about the z axis."""
%if method uniform
    x, y, z = @direction(u, 1 + (1 - u), v)
%else
%if disk concentric
    r = max(abs(2 * u - 1), abs(2 * v - 1))
    x, y = @concentric(u, v)
    z = math.sqrt((1 - r) * (1 + r))
%else
    x, y = @polar(u, v)
    z = math.sqrt(1 - u)
%end
%end
    return x + 0.0, y + 0.0, z  # makes -0 to 0
%part cone
%need direction
%if axis 0,0,1
%else
%refuse --warp {{name}}: axis {{axis}} cannot be emitted; 0,0,1 can
%end
def {{function}}(u, v):
    """{{summary}}: half-angle {{half-angle}} degrees, about the z axis."""
    rim_cos, rim_sin = @cos_sin({{half-angle}} / 360)
    half_cos, half_sin = @cos_sin({{half-angle}} / 720)
    below = 2 * half_sin * half_sin if rim_cos > 0.5 else 1 - rim_cos  # 1 - cos of the half-angle
    above = 2 * half_cos * half_cos if rim_cos < -0.5 else 1 + rim_cos
    x, y, z = @direction(below * u, above + below * (1 - u), v)
    return x + 0.0, y + 0.0, z  # makes -0 to 0
