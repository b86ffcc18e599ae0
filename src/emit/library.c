%part reserved
alignas alignof and and_eq asm auto bitand bitor bool break case catch char char16_t char32_t char8_t class compl concept
const const_cast consteval constexpr constinit continue co_await co_return co_yield decltype default delete do double
dynamic_cast else enum explicit export extern false float for friend goto if inline int int16_t int32_t int64_t int8_t
intmax_t intptr_t long main mutable namespace new noexcept not not_eq nullptr operator or or_eq private protected public
register reinterpret_cast requires restrict return short signed size_t sizeof static static_assert static_cast std struct
switch template this thread_local throw true try typedef typeid typename typeof uint16_t uint32_t uint64_t uint8_t
uintmax_t uintptr_t union unsigned using virtual void volatile wchar_t while xor xor_eq
acos acosh asin asinh atan atan2 atanh cbrt ceil copysign cos cosh double_t drem erf erfc exp exp10 exp2 expm1 fabs fdim
finite float_t floor fma fmax fmin fmod fpclassify frexp gamma hypot ilogb isfinite isgreater isgreaterequal isinf isless
islessequal islessgreater isnan isnormal isunordered j0 j1 jn ldexp lgamma llrint llround log log10 log1p log2 logb lrint
lround modf nan nearbyint nextafter nexttoward pow remainder remquo rint round scalb scalbln scalbn signbit signgam
significand sin sincos sinh sqrt tan tanh tgamma trunc y0 y1 yn HUGE_VAL INFINITY NAN NULL
bcmp bcopy bzero ffs index memccpy memchr memcmp memcpy memmem memmove memset rindex stpcpy strcasecmp strcat strchr
strcmp strcoll strcpy strcspn strdup strerror strlen strncasecmp strncat strncmp strncpy strndup strnlen strpbrk strrchr
strsep strsignal strspn strstr strtok strxfrm
EOF INT16_* INT32_* INT64_* INT8_* INTMAX_* INTPTR_* M_* UINT16_* UINT32_* UINT64_* UINT8_* UINTMAX_* UINTPTR_*
abort abs calloc exit fprintf free getchar gets int_* linux malloc printf putchar puts qsort rand realloc remove rename
scanf sprintf srand stderr stdin stdout uint_* unix vprintf
_Alignas _Alignof _Atomic _Bool _Complex _Decimal* _Float* _Generic _Imaginary _Noreturn _Static_assert _Thread_local *__*
%part file
/* SPDX-License-Identifier: MIT. Copyright (c) 2026 The stipple authors.
 *
 * {{title}}
 *
 * @@(index, dimension, seed) is coordinate `dimension`, from 0 to {{last}}, of point `index`.
%if keyed
 * For many points of one seed, @at(index, &key) is faster, with
 *     @key key = @key_of(dimension, seed);
%end
%if warped
 * @point(index, seed, point) sets all coordinates of a point, with their images under warps.
%end
 *
 * Written by stipple {{version}}:
 *
 *     {{command}}
 *
 * The numbers are those of 'stipple generate', to the last bit, for all seeds and for indices below
 * {{end}}, in C99 and C++ on machines with IEEE 754 arithmetic.
%if fusible
 * Compile without -ffast-math and with -ffp-contract=off: fused multiplications and additions round
 * differently.
%else
%if integers
%else
 * Compile without -ffast-math.
%end
%end
 *
 * Points as stipple prints them:
 *
 *     {{points}}
 *
 * Source: {{source}}
 */
#ifndef @INCLUDED
#define @INCLUDED

#include <math.h>
#include <stdint.h>
#include <string.h>

{{parts}}

#endif
%part point
/* Point `index`, with its images under warps. */
static inline void @point(uint64_t index, uint64_t seed, double point[{{out}}]) {
    {{statements}}
}
%part philox
/* Numbers 2 i and 2 i + 1 of a stream, each 64 random bits: Philox 4x32 with ten rounds. Source:
 * J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, SC11 (2011), doi:10.1145/2063384.2063405. */
static inline void @two_random(uint64_t seed, uint64_t stream, uint64_t i, uint64_t two[2]) {
    uint32_t a = (uint32_t)i, b = (uint32_t)(i >> 32);
    uint32_t c = (uint32_t)stream, d = (uint32_t)(stream >> 32);
    uint32_t low = (uint32_t)seed, high = (uint32_t)(seed >> 32);
    int round;
    for (round = 0; round < 10; ++round) {
        const uint64_t p = (uint64_t)0xd2511f53 * a;
        const uint64_t q = (uint64_t)0xcd9e8d57 * c;
        a = (uint32_t)(q >> 32) ^ b ^ low;
        b = (uint32_t)q;
        c = (uint32_t)(p >> 32) ^ d ^ high;
        d = (uint32_t)p;
        low += 0x9e3779b9;
        high += 0xbb67ae85;
    }
    two[0] = ((uint64_t)b << 32) | a;
    two[1] = ((uint64_t)d << 32) | c;
}

/* Number i of a stream. */
static inline uint64_t @random(uint64_t seed, uint64_t stream, uint64_t i) {
    uint64_t two[2];
    @two_random(seed, stream, i / 2, two);
    return two[i % 2];
}
%part unit
/* The first 53 binary digits of a fraction, whose first digit is the top bit. */
static inline double @unit(uint64_t fraction) {
    return (double)(fraction >> 11) * (1.0 / 9007199254740992.0);
}
%part high_product
/* The upper 64 bits of a product. */
static inline uint64_t @high_product(uint64_t a, uint64_t b) {
    const uint64_t a0 = (uint32_t)a, a1 = a >> 32, b0 = (uint32_t)b, b1 = b >> 32;
    const uint64_t middle = a1 * b0 + (a0 * b0 >> 32);
    return a1 * b1 + (middle >> 32) + ((a0 * b1 + (uint32_t)middle) >> 32);
}
%part ratio
/* a / b to the nearest double, at most 1 - 2^-53, for a < b < 2^62. */
static inline double @ratio(uint64_t a, uint64_t b) {
    uint64_t quotient = 0;
    int bit, shift = 0;
    double rounded;
    if (a == 0 || b <= 9007199254740992u) return (double)a / (double)b;
    for (; a < b; a *= 2) ++shift;
    for (bit = 0; bit < 55; ++bit) { /* two bits more than a double has */
        quotient *= 2;
        if (a >= b) a -= b, ++quotient;
        a *= 2;
    }
    rounded = ldexp((double)(quotient * 2 + (a != 0)), -55 - shift);
    return rounded < 1 ? rounded : 1 - 1.0 / 9007199254740992.0;
}
%part owen
%need philox
/* A bijective hash with a key in the middle (constants: C. Wellons, lowbias32). */
static inline uint32_t @hash(uint32_t x, uint32_t key) {
    x ^= x >> 16;
    x *= 0x7feb352d;
    x ^= x >> 15;
    x = (x + key) * 0x846ca68b;
    return x ^ (x >> 16);
}

/* Flips for five digits: one random bit for each node on their path down a binary tree. */
static inline uint32_t @flips(uint32_t random, uint32_t digits) {
    return ((random >> 1) & 1) << 4 | ((random >> (2 | digits >> 4)) & 1) << 3 |
           ((random >> (4 | digits >> 3)) & 1) << 2 | ((random >> (8 | digits >> 2)) & 1) << 1 |
           ((random >> (16 | digits >> 1)) & 1);
}

/* Keys of the hashes for groups of five digits, and for the first thirty digits. */
typedef struct {
    uint32_t before[12], between[12];
} @hash_keys;

static inline @hash_keys @hash_keys_of(unsigned dimension, uint64_t seed) {
    @hash_keys keys;
    int g;
    for (g = 0; g < 12; g += 2) {
        uint64_t two[2];
        @two_random(seed, 0x100000003, 6 * (uint64_t)dimension + (uint64_t)(g / 2), two);
        keys.before[g] = (uint32_t)(two[0] >> 32);
        keys.between[g] = (uint32_t)two[0];
        keys.before[g + 1] = (uint32_t)(two[1] >> 32);
        keys.between[g + 1] = (uint32_t)two[1];
    }
    return keys;
}

/* Nested uniform scrambling: flips each binary digit at random, depending on the digits before it.
 * Thirty digits, and then twenty-five, are scrambled in groups of five. Source: A. B. Owen (1995),
 * doi:10.1007/978-1-4612-2552-2_19. */
static inline uint64_t @owen(uint64_t fraction, const @hash_keys *keys) {
    const uint32_t *before = keys->before, *between = keys->between;
    const uint32_t high = (uint32_t)(fraction >> 34);
    const uint32_t low = (uint32_t)(fraction >> 9) & 0x1ffffff;
    uint32_t above, new_high = high, new_low = low;
    int g;
    for (g = 0; g < 6; ++g) {
        const int shift = 25 - 5 * g;
        const uint32_t prefix = g == 0 ? 0 : high >> (shift + 5);
        new_high ^= @flips(@hash(prefix ^ before[g], between[g]), (high >> shift) & 31) << shift;
    }
    above = @hash(high ^ before[11], between[11]);
    for (g = 0; g < 5; ++g) {
        const int shift = 20 - 5 * g;
        const uint32_t prefix = g == 0 ? 0 : low >> (shift + 5);
        const uint32_t node = (prefix ^ before[6 + g]) + above * (2 * before[g] + 1);
        new_low ^= @flips(@hash(node, between[6 + g]), (low >> shift) & 31) << shift;
    }
    return ((uint64_t)new_high << 34) | ((uint64_t)(new_low >> 2) << 11);
}
%part sobol
%use directions integers
%need unit
%if scramble owen
%need owen
%end
%if scramble digital-shift matrix
%need philox
%end
/* Columns of the generating matrices, 52 for each dimension; the first digit is the top bit. */
static const uint64_t @columns[{{columns.size}}] = {
    {{columns}}
};

/* Coordinate `dimension` of the plain sequence, as a binary fraction. */
static inline uint64_t @digits(uint64_t index, const uint64_t *column) {
    uint64_t fraction = 0;
%if order gray
    index ^= index >> 1; /* Gray code */
%end
    for (; index != 0; index >>= 1, ++column) fraction ^= *column & (0 - (index & 1));
    return fraction;
}

%if scramble none
/* Coordinate `dimension` of point `index`, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    (void)seed;
    return @unit(@digits(index, @columns + 52 * dimension));
}
%else
%use keyed
/* What depends on dimension and seed alone. */
typedef struct {
%if scramble owen
    unsigned dimension;
    @hash_keys hash_keys;
%end
%if scramble digital-shift
    unsigned dimension;
    uint64_t shift;
%end
%if scramble matrix
    uint64_t columns[52], shift; /* of the scrambled matrix */
%end
} @key;

%if scramble matrix
/* Column j of a random lower triangular matrix. Source: J. Matousek (1998),
 * doi:10.1006/jcom.1998.0489. */
static inline uint64_t @random_column(unsigned j, uint64_t random) {
    const uint64_t digit = (uint64_t)1 << (63 - j);
    return digit | ((digit - 1) & random);
}

%end
static inline @key @key_of(unsigned dimension, uint64_t seed) {
    @key key;
%if scramble owen
    key.dimension = dimension;
    key.hash_keys = @hash_keys_of(dimension, seed);
%end
%if scramble digital-shift
    key.dimension = dimension;
    key.shift = @random(seed, 0x100000001, dimension);
%end
%if scramble matrix
    uint64_t two[2];
    unsigned j, k;
    for (k = 0; k < 52; ++k) key.columns[k] = 0;
    for (j = 0; j < 53; ++j) {
        if (j % 2 == 0) @two_random(seed, 0x100000002, 32 * (uint64_t)dimension + j / 2, two);
        for (k = 0; k < 52; ++k) {
            const uint64_t digit = (@columns[52 * dimension + k] >> (63 - j)) & 1;
            key.columns[k] ^= @random_column(j, two[j % 2]) & (0 - digit);
        }
    }
    key.shift = @random(seed, 0x100000001, dimension);
%end
    return key;
}

/* Coordinate of point `index`, in [0, 1), for the dimension and the seed of the key. */
static inline double @at(uint64_t index, const @key *key) {
%if scramble owen
    return @unit(@owen(@digits(index, @columns + 52 * key->dimension), &key->hash_keys));
%end
%if scramble digital-shift
    return @unit(@digits(index, @columns + 52 * key->dimension) ^ key->shift);
%end
%if scramble matrix
    return @unit(@digits(index, key->columns) ^ key->shift);
%end
}

/* Coordinate `dimension` of point `index`, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
%if scramble matrix
    const uint64_t fraction = @digits(index, @columns + 52 * dimension);
    uint64_t product = @random(seed, 0x100000001, dimension);
    unsigned j;
    for (j = 0; j < 53; ++j)
        if ((fraction >> (63 - j)) & 1)
            product ^= @random_column(j, @random(seed, 0x100000002, 64 * (uint64_t)dimension + j));
    return @unit(product);
%else
    const @key key = @key_of(dimension, seed);
    return @at(index, &key);
%end
}
%end
%part van-der-corput
%need ratio
/* Point `index`, in [0, 1): its digits in base {{base}}, mirrored at the point. */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    uint64_t reversed = 0, power = 1;
    (void)dimension, (void)seed;
    for (; index != 0; index /= {{base}}) {
        reversed = reversed * {{base}} + index % {{base}};
        power *= {{base}};
    }
    return @ratio(reversed, power);
}
%part hammersley
%need ratio
static const unsigned @bases[{{dimension}}] = {
    {{bases}}
};

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const unsigned base = @bases[dimension];
    uint64_t reversed = 0, power = 1;
    (void)seed;
%if sweep first
    if (dimension == 0)
%else
    if (dimension == {{last}})
%end
%if offset 0
        return @ratio(index, {{count}});
%else
        return @ratio(2 * index + 1, 2 * (uint64_t){{count}});
%end
    for (; index != 0; index /= base) {
        reversed = reversed * base + index % base;
        power *= base;
    }
    return @ratio(reversed, power);
}
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
static const unsigned @bases[{{dimension}}] = {
    {{bases}}
};
%if scramble faure

/* Faure's permutations of the digits of each base, and where each begins. */
static const unsigned @images[{{images.size}}] = {
    {{images}}
};
static const unsigned @begins[{{dimension}}] = {
    {{begins}}
};
%end

%if scramble owen permutation
static inline @key @key_of(unsigned dimension, uint64_t seed) {
    return @key_in(@bases[dimension], dimension, seed);
}

/* Coordinate `dimension` of point `index`, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const @key key = @key_of(dimension, seed);
    return @at(index, &key);
}
%else
/* Coordinate `dimension` of point `index`, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const unsigned base = @bases[dimension];
    uint64_t reversed = 0, power = 1;
    (void)seed;
    for (; index != 0; index /= base) {
        const unsigned digit = (unsigned)(index % base);
%if scramble none
        reversed = reversed * base + digit;
%end
%if scramble faure
        reversed = reversed * base + @images[@begins[dimension] + digit];
%end
%if scramble reverse
        reversed = reversed * base + (digit == 0 ? 0 : base - digit);
%end
        power *= base;
    }
    return @ratio(reversed, power);
}
%end
%part permuted_inverse
%use keyed
%need philox
%need unit
%need high_product
/* What depends on dimension and seed alone: for each position of a digit its random permutation,
 * and the value of the zeros from there on, which are permuted, too. */
typedef struct {
    unsigned base, end;
    unsigned char images[{{all_images}}];
    double zeros[64];
} @key;

static inline @key @key_in(unsigned base, unsigned dimension, uint64_t seed) {
    @key key;
    unsigned position, left;
    uint64_t power = 1, two[2] = {0, 0}, known = ~(uint64_t)0; /* two: numbers 2 known, 2 known + 1 */
    uint64_t rest = ((uint64_t)1 << 62) - 1; /* the digits of numbers below 2^62 */
    key.base = base;
    key.end = 0;
    for (position = 0; rest > 0; ++position, power *= base, rest /= base) {
        unsigned char *images = key.images + position * base;
        for (left = 0; left < base; ++left) images[left] = (unsigned char)left;
        for (left = base; left > 1; --left) { /* Fisher and Yates's shuffle */
            const uint64_t i = position * (uint64_t)base + left - 1;
            unsigned other;
            unsigned char image;
            if (i / 2 != known) @two_random(seed, dimension, known = i / 2, two);
            other = (unsigned)@high_product(two[i % 2], left);
            image = images[left - 1];
            images[left - 1] = images[other];
            images[other] = image;
        }
        if (power < 9007199254740992u) key.end = position + 1;
    }
    key.zeros[63] = @unit(@random(seed, dimension, key.end * (uint64_t)base));
    for (position = 63; position-- > 0;)
        if (position >= key.end)
            key.zeros[position] = key.zeros[63];
        else
            key.zeros[position] = (key.images[position * base] + key.zeros[position + 1]) / base;
    return key;
}

/* Coordinate of point `index`, in [0, 1), for the dimension and the seed of the key: the radical
 * inverse with a random permutation of the digits for each position. Source: A. B. Owen,
 * arXiv:1706.02808 (2017). */
static inline double @at(uint64_t index, const @key *key) {
    const unsigned base = key->base;
    const unsigned char *images = key->images;
    uint64_t low = 0, block = 1, whole = 0, power = 1;
    unsigned position = 0;
    double margin, rest;
    /* The low digits, as an integer. */
    do {
        low = low * base + images[index % base];
        block *= base;
        index /= base;
        ++position;
        images += base;
    } while (block * base <= 1024);
    for (; index != 0; index /= base, power *= base, ++position, images += base)
        whole = whole * base + images[index % base];
    rest = ((double)whole + key->zeros[position]) / (double)power;
    margin = (double)block * (1.0 / 2251799813685248.0);
    rest = rest < margin ? margin : rest > 1 - margin ? 1 - margin : rest;
    return ((double)low + rest) / (double)block;
}
%part nested
%use keyed fusible
%need owen
%need unit
%need high_product
%need ratio
/* Hash of a digit after a prefix. */
static inline uint32_t @digit_hash(uint32_t digit, uint64_t prefix) {
    return @hash((uint32_t)prefix + digit * 0x9e3779b9, (uint32_t)(prefix >> 32));
}

/* What depends on dimension and seed alone: keys of the hashes in base 2, or in other bases. */
typedef struct {
    unsigned base;
    uint64_t keys[3];
    @hash_keys hash_keys;
} @key;

static inline @key @key_in(unsigned base, unsigned dimension, uint64_t seed) {
    @key key;
    unsigned j;
    memset(&key, 0, sizeof key);
    key.base = base;
    if (base == 2) key.hash_keys = @hash_keys_of(dimension, seed);
    for (j = 0; j < 3 && base != 2; ++j)
        key.keys[j] = @random(seed, 0x100000006, 3 * (uint64_t)dimension + j);
    return key;
}

/* Coordinate of point `index`, in [0, 1), for the dimension and the seed of the key: the radical
 * inverse with nested uniform scrambling, a random permutation of each digit for each choice of the
 * digits before it. The digits after the last one form a uniform number. */
static inline double @at(uint64_t index, const @key *keyed) {
    const uint64_t *key = keyed->keys, base = keyed->base;
    uint64_t rest, random, prefix = 0, place = 1, image = 0, leading = 1;
    unsigned depth = 0, j;
    double length, margin;
    if (base == 2) {
        uint64_t reversed = 0;
        for (j = 0; j < 64; ++j) reversed |= ((index >> j) & 1) << (63 - j);
        return @unit(@owen(reversed, &keyed->hash_keys));
    }
    for (rest = index;; rest /= base) {
        unsigned digit = (unsigned)(rest % base), turned, other;
        random = (prefix ^ key[0]) * 0xbf58476d1ce4e5b9u; /* splitmix64, with two keys */
        random = (random ^ (random >> 32)) + key[1];
        random *= 0x94d049bb133111ebu;
        random = (random ^ (random >> 29)) * 0xbf58476d1ce4e5b9u;
        random ^= random >> 32;
        if (rest == 0) break;
        /* `leading` is base^(number of zeros at the end of the prefix). */
        turned = (unsigned)@high_product(random * leading, base);
        if (digit > 0) {
            const uint64_t node = random ^ (key[2] * (2 * (uint64_t)depth + 1));
            const uint32_t own = @digit_hash(digit, node);
            ++turned;
            for (other = 1; other < base; ++other) {
                const uint32_t hash = @digit_hash(other, node);
                turned += other != digit && (hash < own || (hash == own && other < digit));
            }
        }
        image = image * base + turned % base;
        prefix += digit * place;
        place *= base;
        leading = digit > 0 ? 1 : leading * base;
        ++depth;
    }
    if (place > (uint64_t)1 << 50) return @ratio(2 * image + 1, 2 * place);
    length = (double)place;
    margin = length * (1.0 / 2251799813685248.0);
    return ((double)image + (margin + (1 - 2 * margin) * @unit(random))) / length;
}
%part kronecker
%use integers
%need unit
%need high_product
/* Steps along each coordinate, as high and low halves of fractions of 128 bits; and point 0. */
static const uint64_t @steps[{{steps.size}}] = {
    {{steps}}
};
static const uint64_t @begin[2] = {
    {{begin}}
};

/* Coordinate `dimension` of point `index`, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const uint64_t *step = @steps + 2 * dimension;
    const uint64_t low = step[1] * index + @begin[1];
    const uint64_t carry = low < @begin[1];
    (void)seed;
    return @unit(@begin[0] + step[0] * index + @high_product(step[1], index) + carry);
}
%use alpha
%use offset
%part rank1-lattice
/* Generating vector. */
static const uint64_t @vector[{{dimension}}] = {
    {{z}}
};

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const uint64_t n = {{count}};
    uint64_t residue = 0, z = @vector[dimension];
    (void)seed;
    if (n <= (uint64_t)1 << 32) {
        residue = index * z % n;
    } else {
        for (; index != 0; index >>= 1, z = 2 * z % n) /* the product has more than 64 bits */
            if (index & 1) residue = (residue + z) % n;
    }
    return (double)residue / (double)n;
}
%use rule multiplier vector vector-file decay weights effort
%part stratum
%use fusible
/* The point low + width u of [0, parts), divided by parts; the middle where rounding would reach an
 * edge of [low, low + width). */
static inline double @stratum(uint64_t low, uint64_t width, uint64_t parts, double u) {
    const double x = ((double)low + (double)width * u) / (double)parts;
    const double there = x * (double)parts;
    if (there > (double)low && there < (double)(low + width)) return x;
    return (double)(2 * low + width) / (double)(2 * parts);
}
%part jittered
%limit count 4398046511104
%if cell random
%need philox
%need unit
%need stratum
%end
%if sides
static const uint64_t @sides[{{dimension}}] = {
    {{sides}}
};

%end
/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
%if sides
    uint64_t low = index;
    const uint64_t width = 1, parts = @sides[dimension];
    unsigned k;
    for (k = 0; k < dimension; ++k) low /= @sides[k];
    low %= parts;
%else
    /* Row r of rows has the cells r n / rows to (r + 1) n / rows - 1, rounded down. */
    const uint64_t n = {{count}}, rows = {{rows}};
    const uint64_t row = ((index + 1) * rows - 1) / n;
    const uint64_t begin = row * n / rows, cells = (row + 1) * n / rows - begin;
    const uint64_t low = dimension == 0 ? index - begin : begin;
    const uint64_t width = dimension == 0 ? 1 : cells;
    const uint64_t parts = dimension == 0 ? cells : n;
%end
%if cell random
    return @stratum(low, width, parts, @unit(@random(seed, 0, {{dimension}} * index + dimension)));
%else
    (void)seed;
    return ((double)low + (double)width / 2) / (double)parts;
%end
}
%use shape
%part permuted
%need high_product
/* Next number of SplitMix64. Source: G. L. Steele, D. Lea, C. H. Flood, OOPSLA (2014). */
static inline uint64_t @next(uint64_t *state) {
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}

/* Image of i under a random permutation of 0, ..., size - 1: shuffled if it is small, else a cipher
 * that is repeated until the image is below size. */
static inline uint64_t @permuted(uint64_t i, uint64_t size, uint64_t key) {
    uint64_t keys[24], mask = 1;
    int width = 0, t;
    if (size <= 64) {
        unsigned char images[64] = {0};
        uint64_t last;
        for (last = 0; last < size; ++last) {
            const uint64_t j = @high_product(@next(&key), last + 1);
            images[last] = images[j];
            images[j] = (unsigned char)last;
        }
        return images[i];
    }
    while ((size - 1) >> width != 0) ++width;
    mask = ((uint64_t)1 << width) - 1;
    for (t = 0; t < 24; ++t) keys[t] = @next(&key) >> (64 - width);
    do
        for (t = 0; t < 24; t += 2) {
            i = ((i ^ keys[t]) * (keys[t + 1] | 1)) & mask;
            i ^= i >> (width + 1) / 2;
        }
    while (i >= size);
    return i;
}
%part multi-jittered
%limit count 1125899906842624
%need philox
%need permuted
%if centered false
%need unit
%need stratum
%end
/* The strip along axis `dimension`, of {{count}}, of the point in cell i. */
static inline uint64_t @strip(uint64_t i, unsigned dimension, uint64_t seed) {
    const uint64_t n = {{count}}, columns = {{columns}}, rows = n / columns;
%if rest
    const uint64_t rest = n % columns; /* points of the last row, evenly spread over the columns */
    const uint64_t phase = @high_product(@random(seed, 4, 1), columns);
    const uint64_t turn = @high_product(@random(seed, 4, 2), n);
    uint64_t column = i % columns, row = i / columns, before, after;
    if (row == rows) column = ((column + 1) * columns - phase - 1) / rest;
    if (dimension == 1) {
        if (row == rows) return row * columns + @permuted(i % columns, rest, @random(seed, 4, 0));
        return row * columns + @permuted(column, columns, @random(seed, 3, row));
    }
    before = (column * rest + phase) / columns;
    after = ((column + 1) * rest + phase) / columns;
    if (after > before)
        row = @permuted(row, rows + 1, @random(seed, 2, column));
    else
        row = @permuted(row, rows, @random(seed, 1, column));
    return (column * rows + before + row + turn) % n;
%else
    const uint64_t column = i % columns, row = i / columns;
    if (dimension == 1) return row * columns + @permuted(column, columns, @random(seed, 3, row));
    return column * rows + @permuted(row, rows, @random(seed, 1, column));
%end
}

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const uint64_t n = {{count}};
%if order shuffled
    const uint64_t i = @permuted(index, n, @random(seed, 0, 0));
%else
    const uint64_t i = index;
%end
%if centered true
    return ((double)@strip(i, dimension, seed) + 0.5) / (double)n;
%else
    const double u = @unit(@random(seed, 0x80000000u + dimension, index));
    return @stratum(@strip(i, dimension, seed), 1, n, u);
%end
}
%use shape
%part correlated-multi-jittered
%limit count 1125899906842624
%need philox
%need permuted
%if centered false
%need unit
%need stratum
%end
/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
static inline double @@(uint64_t index, unsigned dimension, uint64_t seed) {
    const uint64_t n = {{count}}, columns = {{columns}}, rows = (n + columns - 1) / columns;
%if order shuffled
    uint64_t strip = @permuted(index, n, @random(seed, 0, 0));
%else
    uint64_t strip = index;
%end
    const uint64_t strips = dimension == 0 ? columns * rows : n;
    if (dimension == 0)
        strip = @permuted(strip % columns, columns, @random(seed, 1, 0)) * rows +
                @permuted(strip / columns, rows, @random(seed, 2, 0));
%if centered true
    return ((double)strip + 0.5) / (double)strips;
%else
    return @stratum(strip, 1, strips, @unit(@random(seed, 0x80000000u + dimension, index)));
%end
}
%use shape
%part cos_sin
%use fusible
/* Cosine and sine of an angle in [-1/8, 1/8] turns, within a unit in the last place. */
static inline void @cos_sin_eighth(double t, double *cosine, double *sine) {
    const double head = 6.283185243606567; /* 2 pi in 26 bits, and the rest of it */
    const double tail = 6.357301909411278e-08;
    double upper, y, y_low, rest, z, s, c, half, near1;
    uint64_t bits;
    memcpy(&bits, &t, 8);
    bits &= ~(uint64_t)0x7ffffff;
    memcpy(&upper, &bits, 8);
    rest = (t - upper) * head + t * tail;
    y = upper * head + rest;
    y_low = (upper * head - y) + rest;
    z = y * y;
    half = 0.5 * z;
    s = 1 / 355687428096000.0; /* 1/17!, 1/15!, ..., 1/3! with alternating signs */
    s = s * z + -1 / 1307674368000.0;
    s = s * z + 1 / 6227020800.0;
    s = s * z + -1 / 39916800.0;
    s = s * z + 1 / 362880.0;
    s = s * z + -1 / 5040.0;
    s = s * z + 1 / 120.0;
    s = s * z + -1 / 6.0;
    c = 1 / 20922789888000.0; /* 1/16!, 1/14!, ..., 1/4! with alternating signs */
    c = c * z + -1 / 87178291200.0;
    c = c * z + 1 / 479001600.0;
    c = c * z + -1 / 3628800.0;
    c = c * z + 1 / 40320.0;
    c = c * z + -1 / 720.0;
    c = c * z + 1 / 24.0;
    near1 = 1 - half;
    *cosine = near1 + (((1 - near1) - half) + (z * z * c - y * y_low));
    *sine = y + (y * z * s + y_low * near1);
}
%part cos_sin_turns
%need cos_sin
/* Cosine and sine of an angle in [0, 1] turns. */
static inline void @cos_sin(double turns, double *cosine, double *sine) {
    const int quarter = (int)rint(4 * turns);
    double c, s;
    @cos_sin_eighth(turns - 0.25 * quarter, &c, &s);
    *cosine = 0.0 + (quarter % 4 == 0 ? c : quarter % 4 == 1 ? -s : quarter % 4 == 2 ? -c : s);
    *sine = 0.0 + (quarter % 4 == 0 ? s : quarter % 4 == 1 ? c : quarter % 4 == 2 ? -s : -c);
}
%part concentric
%need cos_sin
/* Concentric map of the unit square to the unit disk. Source: P. Shirley, K. Chiu (1997),
 * doi:10.1080/10867651.1997.10487479. */
static inline void @concentric(double u, double v, double *x, double *y) {
    const double a = 2 * u - 1, b = 2 * v - 1;
    const int wide = fabs(a) > fabs(b);
    const double r = wide ? a : b, across = wide ? b : a;
    double c, s;
    @cos_sin_eighth(0.125 * (across / (r == 0 ? 1 : r)), &c, &s);
    *x = wide ? r * c : r * s;
    *y = wide ? r * s : r * c;
}
%part polar
%need cos_sin_turns
/* Polar map of the unit square to the unit disk. */
static inline void @polar(double u, double v, double *x, double *y) {
    const double r = sqrt(u);
    double c, s;
    @cos_sin(v, &c, &s);
    *x = r * c;
    *y = r * s;
}
%part placed
/* center + radius x. GCC 12 would fuse two of them in a vector in spite of -ffp-contract=off. */
static inline double @placed(double center, double radius, double x) {
    const volatile double product = radius * x;
    return center + product;
}
%part disk
%need placed
%if method concentric
%need concentric
%else
%need polar
%end
%if method rejection naive
%refuse --warp {{name}}: method {{method}} cannot be emitted; polar and concentric can
%end
/* {{summary}}: method {{method}}, centre {{center}}, radius {{radius}}. */
static inline void {{function}}(double u, double v, double point[2]) {
    double x, y;
%if method concentric
    @concentric(u, v, &x, &y);
%else
    @polar(u, v, &x, &y);
%end
    point[0] = @placed({{center.0}}, {{radius}}, x);
    point[1] = @placed({{center.1}}, {{radius}}, y);
}
%part triangle
%use fusible
/* {{summary}}: method {{method}}, vertices {{vertices.text}}. */
static inline void {{function}}(double u, double v, double point[{{dims}}]) {
    static const double vertex[{{vertices.size}}] = {
        {{vertices}}
    };
%if method sqrt
    const double root = sqrt(u);
    const double l0 = 1 - root, l1 = root * v, l2 = root * (1 - v);
%else
    const double most = u > v ? u : v, half = 0.5 * (u > v ? v : u);
    const double l0 = 1 - most, l1 = u > v ? most - half : half, l2 = u > v ? half : most - half;
%end
    int k;
    for (k = 0; k < {{dims}}; ++k)
        point[k] = l0 * vertex[k] + l1 * vertex[k + {{dims}}] + l2 * vertex[k + 2 * {{dims}}];
}
%part direction
%need cos_sin_turns
/* Direction with 1 - cos and 1 + cos of its angle from the z axis, and a longitude in turns. */
static inline void @direction(double below, double above, double longitude, double point[3]) {
    const double r = sqrt(below * above);
    double c, s;
    @cos_sin(longitude, &c, &s);
    point[0] = r * c;
    point[1] = r * s;
    point[2] = 0.5 * (above - below);
}
%part sphere
%need placed
%need direction
%if method z
/* {{summary}}: centre {{center}}, radius {{radius}}. */
%else
%refuse --warp {{name}}: method {{method}} cannot be emitted; z can
%end
static inline void {{function}}(double u, double v, double point[3]) {
    @direction(2 * u, 2 * (1 - u), v, point);
    point[0] = @placed({{center.0}}, {{radius}}, point[0]);
    point[1] = @placed({{center.1}}, {{radius}}, point[1]);
    point[2] = @placed({{center.2}}, {{radius}}, point[2]);
}
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
/* {{summary}}: method {{method}}, about the z axis. */
static inline void {{function}}(double u, double v, double point[3]) {
%if method uniform
    @direction(u, 1 + (1 - u), v, point);
    point[0] += 0.0; /* makes -0 to 0 */
    point[1] += 0.0;
%else
    double x, y;
%if disk concentric
    const double a = fabs(2 * u - 1), b = fabs(2 * v - 1);
    const double r = a > b ? a : b;
    @concentric(u, v, &x, &y);
    point[2] = sqrt((1 - r) * (1 + r));
%else
    @polar(u, v, &x, &y);
    point[2] = sqrt(1 - u);
%end
    point[0] = x + 0.0; /* makes -0 to 0 */
    point[1] = y + 0.0;
%end
}
%part cone
%need direction
%if axis 0,0,1
%else
%refuse --warp {{name}}: axis {{axis}} cannot be emitted; 0,0,1 can
%end
/* {{summary}}: half-angle {{half-angle}} degrees, about the z axis. */
static inline void {{function}}(double u, double v, double point[3]) {
    double rim_cos, rim_sin, half_cos, half_sin, below, above;
    @cos_sin({{half-angle}} / 360.0, &rim_cos, &rim_sin);
    @cos_sin({{half-angle}} / 720.0, &half_cos, &half_sin);
    below = rim_cos > 0.5 ? 2 * half_sin * half_sin : 1 - rim_cos; /* 1 - cos of the half-angle */
    above = rim_cos < -0.5 ? 2 * half_cos * half_cos : 1 + rim_cos;
    @direction(below * u, above + below * (1 - u), v, point);
    point[0] += 0.0; /* makes -0 to 0 */
    point[1] += 0.0;
}
