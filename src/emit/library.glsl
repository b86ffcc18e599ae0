%part reserved
main struct void bool true false int uint float double half fixed long short char string unsigned vec2 vec3 vec4 bvec2 bvec3
bvec4 ivec2 ivec3 ivec4 uvec2 uvec3 uvec4 dvec2 dvec3 dvec4 mat2 mat3 mat4 mat2x2 mat2x3 mat2x4 mat3x2 mat3x3 mat3x4 mat4x2
mat4x3 mat4x4 float2 float3 float4 int2 int3 int4 uint2 uint3 uint4 bool2 bool3 bool4 matrix vector
break case continue default discard do else for if return subroutine switch while
active asm atomic_uint attribute auto buffer cast catch cbuffer centroid class coherent column_major common compile const
const_cast delete dword dynamic_cast enum explicit export extern external filter flat friend goto groupshared highp in
inline inout input interface invariant layout line lineadj linear lowp mediump mutable namespace new noinline nointerpolation
noise noperspective operator out output packoffset partition pass patch pixelfragment point precise precision private
protected public readonly register reinterpret_cast resource restrict row_major sample sampler shared signed sizeof smooth
snorm stateblock static static_cast superp tbuffer technique template texture this throw triangle triangleadj try typedef
typename uniform union unorm using varying vertexfragment virtual volatile writeonly
asfloat asint asuint firstbithigh
AppendStructuredBuffer Buffer* ByteAddressBuffer ConstantBuffer ConsumeStructuredBuffer InputPatch LineStream OutputPatch
PointStream RW* RasterizerOrdered* RaytracingAccelerationStructure Sampler* StructuredBuffer SubpassInput* Texture*
TriangleStream int16_t* int64_t* float16_t* float32_t* float64_t* int32_t* uint16_t* uint32_t* uint64_t* f16* f32* f64*
i8vec* i16vec* i32vec* i64vec* u8vec* u16vec* u32vec* u64vec* min10* min12* min16* double2* double3* double4* half2* half3*
half4* bool1* float1* int1* uint1* image* iimage* uimage* isampler* usampler* sampler1D* sampler2D* sampler3D* samplerB*
samplerC* sampler_state samplerShadow subpassInput* isubpassInput* usubpassInput* texture1D* texture2D* texture3D*
textureB* textureC* itexture* utexture* accelerationStructureEXT rayQueryEXT hitObject* precise dispatch numthreads
pointStream gl_* *__*
%part file
/* SPDX-License-Identifier: MIT. Copyright (c) 2026 The stipple authors.
 *
 * {{title}}
 *
 * @@(index, dimension, seed) is coordinate `dimension`, from 0 to {{last}}, of point `index`.
%if keyed
 * For many points of one seed, @at(index, key) is faster, with
 *     @key key = @key_of(dimension, seed);
%end
%if warped
 * @point(index, seed, p) sets p to all coordinates, with their images under warps.
%end
 *
 * Written by stipple {{version}}:
 *
 *     {{command}}
 *
 * The numbers are those of 'stipple generate', cut to float32 (as by its --dtype f32), for indices
 * below {{end}} and seeds below 2^32. They are computed in integers of 32 bits, so that they do not
 * depend on the GPU, and are below 1.
%if language GLSL
 * This needs GLSL 4.00 or later.
%end
%if rare
 * Exception: stipple moves a number that rounding puts at the edge of its stratum to the middle;
 * here that may be missed, for about one number in 2^52 / {{count}}.
%end
%if warped
 * Warps work in float32 on coordinates cut to float32: near a rim or a pole, where a warp magnifies
 * the digits that are cut, images differ by up to 1e-4, elsewhere by the errors of the GPU's sin,
 * cos and sqrt.
%end
 *
 * Points as stipple makes them, in float32:
 *
 *     {{points}}
 *
 * Source: {{source}}
 */

#ifndef @INCLUDED
#define @INCLUDED

{{parts}}

#endif
%part point
/* Point `index`, with its images under warps. */
void @point(uint index, uint seed, out float p[{{out}}]) {
    {{statements}}
}
%part high_product
/* The upper 32 bits of a product. */
uint @high_product(uint a, uint b) {
    uint a0 = a & 0xffffu, a1 = a >> 16, b0 = b & 0xffffu, b1 = b >> 16;
    uint middle = a1 * b0 + (a0 * b0 >> 16);
    return a1 * b1 + (middle >> 16) + ((a0 * b1 + (middle & 0xffffu)) >> 16);
}
%part wide
%need high_product
/* Integers of 64 bits, as low and high words. */
uvec2 @plus(uvec2 a, uint b) { return uvec2(a.x + b, a.y + (a.x + b < b ? 1u : 0u)); }
uvec2 @times(uvec2 a, uint b) { return uvec2(a.x * b, a.y * b + @high_product(a.x, b)); }

/* The upper 32 bits of the product with 32 bits, of 96. */
uint @below(uvec2 a, uint b) {
    uint low = a.y * b;
    uint sum = low + @high_product(a.x, b);
    return @high_product(a.y, b) + (sum < low ? 1u : 0u);
}
%part philox
%need high_product
/* Numbers 2 i and 2 i + 1 of stream (low, high), each 64 random bits, low and high word: Philox 4x32
 * with ten rounds. Source: J. K. Salmon, M. A. Moraes, R. O. Dror, D. E. Shaw, SC11 (2011),
 * doi:10.1145/2063384.2063405. */
void @two_random(uint seed, uvec2 stream, uint i, out uvec2 first, out uvec2 second) {
    uint a = i, b = 0u, c = stream.x, d = stream.y;
    uint low = seed, high = 0u;
    for (int round = 0; round < 10; ++round) {
        uint p = @high_product(0xd2511f53u, a), q = @high_product(0xcd9e8d57u, c);
        uint p_low = 0xd2511f53u * a, q_low = 0xcd9e8d57u * c;
        a = q ^ b ^ low;
        b = q_low;
        c = p ^ d ^ high;
        d = p_low;
        low += 0x9e3779b9u;
        high += 0xbb67ae85u;
    }
    first = uvec2(a, b);
    second = uvec2(c, d);
}

/* Number i of a stream. */
uvec2 @random(uint seed, uvec2 stream, uint i) {
    uvec2 first, second;
    @two_random(seed, stream, i >> 1, first, second);
    return (i & 1u) == 0u ? first : second;
}
%part unit
/* The first 53 binary digits of a fraction, whose first digit is the top bit of its high word, cut
 * to float32. */
float @unit(uvec2 fraction) {
    uint high = fraction.y, low = fraction.x & 0xfffff800u;
    int exponent = 125;
    if (high == 0u) {
        high = low;
        low = 0u;
        exponent -= 32;
    }
    if (high == 0u) return 0.0;
    int shift = 31 - int(findMSB(high));
    if (shift > 0) high = (high << shift) | (low >> (32 - shift));
    return uintBitsToFloat((uint(exponent - shift) << 23) + (high >> 8));
}
%part ratio
%need wide
bool @less(uvec2 a, uvec2 b) { return a.y < b.y || (a.y == b.y && a.x < b.x); }
uvec2 @minus(uvec2 a, uvec2 b) { return uvec2(a.x - b.x, a.y - b.y - (a.x < b.x ? 1u : 0u)); }

/* The double nearest to (a / b) 2^exponent, cut to float32; a, b < 2^62, the result is below 1. */
float @ratio(uvec2 a, uvec2 b, int exponent) {
    uint quotient = 0u;
    if (a.x == 0u && a.y == 0u) return 0.0;
    for (; a.y < 0x20000000u; a = @times(a, 2u)) --exponent;
    for (; b.y < 0x20000000u; b = @times(b, 2u)) ++exponent;
    for (; @less(a, b); a = @times(a, 2u)) --exponent;
    for (int bit = 0; bit < 24; ++bit) {
        if (bit > 0) a = @times(a, 2u);
        quotient <<= 1;
        if (!@less(a, b)) {
            a = @minus(a, b);
            quotient |= 1u;
        }
    }
    /* A double has 29 bits more; they may round up to the next float. */
    if (!@less(uvec2((b.x >> 30) | (b.y << 2), b.y >> 30), @minus(b, a))) ++quotient;
    return uintBitsToFloat((uint(exponent + 126) << 23) + quotient);
}
%part owen
%need philox
/* A bijective hash with a key in the middle (constants: C. Wellons, lowbias32). */
uint @hash(uint x, uint key) {
    x ^= x >> 16;
    x *= 0x7feb352du;
    x ^= x >> 15;
    x = (x + key) * 0x846ca68bu;
    return x ^ (x >> 16);
}

/* Flips for five digits: one random bit for each node on their path down a binary tree. */
uint @flips(uint bits, uint digits) {
    return ((bits >> 1) & 1u) << 4 | ((bits >> (2u | digits >> 4)) & 1u) << 3 |
           ((bits >> (4u | digits >> 3)) & 1u) << 2 | ((bits >> (8u | digits >> 2)) & 1u) << 1 |
           ((bits >> (16u | digits >> 1)) & 1u);
}

/* What depends on dimension and seed alone: keys of the hashes for groups of five digits and for the
 * first thirty digits, each with its parts between and before. */
struct @key {
    uint dimension;
    uvec2 keys[12];
};

@key @key_of(uint dimension, uint seed) {
    @key key;
    key.dimension = dimension;
    for (int k = 0; k < 12; k += 2) {
        uvec2 first, second;
        @two_random(seed, uvec2(3u, 1u), 6u * dimension + uint(k / 2), first, second);
        key.keys[k] = first;
        key.keys[k + 1] = second;
    }
    return key;
}

/* Nested uniform scrambling: flips each binary digit at random, depending on the digits before it.
 * Thirty digits, and then twenty-five, are scrambled in groups of five. Source: A. B. Owen (1995),
 * doi:10.1007/978-1-4612-2552-2_19. */
uvec2 @owen(uvec2 fraction, @key key) {
    uint high = fraction.y >> 2, low = ((fraction.y & 3u) << 23) | (fraction.x >> 9);
    uint new_high = high, new_low = low;
    for (int g = 0; g < 6; ++g) {
        int shift = 25 - 5 * g;
        uint prefix = g == 0 ? 0u : high >> (shift + 5);
        uint bits = @hash(prefix ^ key.keys[g].y, key.keys[g].x);
        new_high ^= @flips(bits, (high >> shift) & 31u) << shift;
    }
    uint above = @hash(high ^ key.keys[11].y, key.keys[11].x);
    for (int f = 0; f < 5; ++f) {
        int shift = 20 - 5 * f;
        uint prefix = f == 0 ? 0u : low >> (shift + 5);
        uint node = (prefix ^ key.keys[6 + f].y) + above * (2u * key.keys[f].y + 1u);
        new_low ^= @flips(@hash(node, key.keys[6 + f].x), (low >> shift) & 31u) << shift;
    }
    return uvec2(new_low << 9, (new_high << 2) | (new_low >> 23));
}
%part sobol
%if directions
%refuse --directions: the numbers of a file cannot be emitted in {{language}}; the program's own can
%end
%need unit
%if scramble owen
%need owen
%end
%if scramble digital-shift matrix
%need philox
%end
/* Columns of the generating matrices, 32 for each dimension; the first digit is the top bit. */
const uint @columns[{{upper.size}}] = uint[{{upper.size}}](
    {{upper}}
);

/* Coordinate `dimension` of the plain sequence, as a binary fraction. */
uint @digits(uint index, uint dimension) {
    uint fraction = 0u;
%if order gray
    index ^= index >> 1; /* Gray code */
%end
    for (uint j = 32u * dimension; index != 0u; index >>= 1, ++j)
        fraction ^= @columns[j] & (0u - (index & 1u));
    return fraction;
}

%if scramble none
/* Coordinate `dimension` of point `index`, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    return @unit(uvec2(0u, @digits(index, dimension)));
}
%else
%use keyed
%if scramble digital-shift
/* What depends on dimension and seed alone. */
struct @key {
    uint dimension;
    uvec2 shift;
};

@key @key_of(uint dimension, uint seed) {
    @key key;
    key.dimension = dimension;
    key.shift = @random(seed, uvec2(1u, 1u), dimension);
    return key;
}

%end
%if scramble matrix
/* What depends on dimension and seed alone: columns of a random lower triangular matrix, and a
 * shift. Source: J. Matousek (1998), doi:10.1006/jcom.1998.0489. */
struct @key {
    uint dimension;
    uvec2 shift;
    uvec2 columns[32];
};

@key @key_of(uint dimension, uint seed) {
    @key key;
    key.dimension = dimension;
    key.shift = @random(seed, uvec2(1u, 1u), dimension);
    for (uint j = 0u; j < 32u; j += 2u) {
        uint digit = 0x80000000u >> j;
        uvec2 first, second;
        @two_random(seed, uvec2(2u, 1u), 32u * dimension + j / 2u, first, second);
        key.columns[j] = uvec2(first.x, digit | (first.y & (digit - 1u)));
        digit >>= 1;
        key.columns[j + 1u] = uvec2(second.x, digit | (second.y & (digit - 1u)));
    }
    return key;
}

%end
/* Coordinate of point `index`, in [0, 1), for the dimension and the seed of the key. */
float @at(uint index, @key key) {
    uint digits = @digits(index, key.dimension);
%if scramble owen
    return @unit(@owen(uvec2(0u, digits), key));
%end
%if scramble digital-shift
    return @unit(uvec2(key.shift.x, digits ^ key.shift.y));
%end
%if scramble matrix
    uvec2 product = key.shift;
    for (uint j = 0u; j < 32u; ++j) {
        uint chosen = 0u - ((digits >> (31u - j)) & 1u);
        product = uvec2(product.x ^ (key.columns[j].x & chosen), product.y ^ (key.columns[j].y & chosen));
    }
    return @unit(product);
%end
}

/* Coordinate `dimension` of point `index`, in [0, 1). */
float @@(uint index, uint dimension, uint seed) { return @at(index, @key_of(dimension, seed)); }
%end
%part inverse
%need ratio
/* Radical inverse: the digits of `index` in a base, mirrored at the point. */
float @inverse(uint index, uint base) {
    uvec2 reversed = uvec2(0u, 0u), power = uvec2(1u, 0u);
    for (; index != 0u; index /= base) {
        reversed = @plus(@times(reversed, base), index % base);
        power = @times(power, base);
    }
    return @ratio(reversed, power, 0);
}
%part van-der-corput
%need inverse
/* Point `index`, in [0, 1): its digits in base {{base}}, mirrored at the point. */
float @@(uint index, uint dimension, uint seed) { return @inverse(index, {{base}}u); }
%part hammersley
%need inverse
const uint @bases[{{dimension}}] = uint[{{dimension}}](
    {{bases}}
);

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
%if sweep first
    if (dimension > 0u) return @inverse(index, @bases[dimension]);
%else
    if (dimension < {{last}}u) return @inverse(index, @bases[dimension]);
%end
    uvec2 at = uvec2(index, 0u), n = uvec2({{count}}u, 0u);
%if offset half
    at = @plus(@times(at, 2u), 1u);
    n = @times(n, 2u);
%end
    return @ratio(at, n, 0);
}
%part halton
%if scramble permutation owen
%refuse --scramble: {{scramble}} takes double precision, which is not emitted in {{language}}; none, faure and reverse are
%end
%need ratio
const uint @bases[{{dimension}}] = uint[{{dimension}}](
    {{bases}}
);
%if scramble faure

/* Faure's permutations of the digits of each base, and where each begins. */
const uint @images[{{images.size}}] = uint[{{images.size}}](
    {{images}}
);
const uint @begins[{{dimension}}] = uint[{{dimension}}](
    {{begins}}
);
%end

/* Coordinate `dimension` of point `index`, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    uint base = @bases[dimension];
    uvec2 reversed = uvec2(0u, 0u), power = uvec2(1u, 0u);
    for (; index != 0u; index /= base) {
        uint digit = index % base;
%if scramble faure
        digit = @images[@begins[dimension] + digit];
%end
%if scramble reverse
        digit = digit == 0u ? 0u : base - digit;
%end
        reversed = @plus(@times(reversed, base), digit);
        power = @times(power, base);
    }
    return @ratio(reversed, power, 0);
}
%part kronecker
%need unit
%need wide
/* Steps along each coordinate, as high and low halves of fractions of 128 bits; and point 0. Each
 * half is a low and a high word. */
const uvec2 @steps[{{steps.size}}] = uvec2[{{steps.size}}](
    {{steps}}
);
const uvec2 @begin[2] = uvec2[2](
    {{begin}}
);

/* Coordinate `dimension` of point `index`, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    uvec2 step_high = @steps[2u * dimension], step_low = @steps[2u * dimension + 1u];
    uvec2 low = @plus(@times(step_low, index), @begin[1].x);
    low.y += @begin[1].y;
    uint carry = @below(step_low, index);
    if (low.y < @begin[1].y || (low.y == @begin[1].y && low.x < @begin[1].x)) ++carry;
    uvec2 high = @plus(@times(step_high, index), carry);
    high = @plus(high, @begin[0].x);
    high.y += @begin[0].y;
    return @unit(high);
}
%use alpha offset
%part rank1-lattice
%need ratio
/* Generating vector. */
const uint @vector[{{dimension}}] = uint[{{dimension}}](
    {{z.words}}
);

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    uint n = {{count}}u, z = @vector[dimension], residue = 0u;
    for (; index != 0u; index >>= 1) { /* adds and doubles modulo n */
        if ((index & 1u) != 0u) residue = residue >= n - z ? residue - (n - z) : residue + z;
        z = z >= n - z ? z - (n - z) : z + z;
    }
    return @ratio(uvec2(residue, 0u), uvec2(n, 0u), 0);
}
%use rule multiplier vector vector-file decay weights effort
%part stratum
%use rare
%need ratio
/* Rounds the number whole + fraction / 2^64 to 53 bits, to the nearest even. */
void @round53(inout uint whole, inout uvec2 fraction) {
    if (whole == 0u) return;
    int drop = int(findMSB(whole)) + 12; /* 12 to 43 bits */
    uvec2 odd = drop < 32 ? uvec2((fraction.x >> drop) & 1u, 0u)
                          : uvec2((fraction.y >> (drop - 32)) & 1u, 0u);
    uvec2 half_ulp = drop <= 32 ? uvec2((1u << (drop - 1)) - 1u, 0u)
                                : uvec2(0xffffffffu, (1u << (drop - 33)) - 1u);
    uvec2 sum = @plus(@plus(fraction, half_ulp.x), odd.x);
    uint carry = sum.y < fraction.y ? 1u : 0u;
    sum.y += half_ulp.y;
    if (sum.y < half_ulp.y) carry = 1u;
    whole += carry;
    fraction = drop < 32 ? uvec2(sum.x & ~((1u << drop) - 1u), sum.y)
                         : uvec2(0u, sum.y & ~((1u << (drop - 32)) - 1u));
}

/* The middle of [low, low + width), divided by parts. */
float @middle(uint low, uint width, uint parts) {
    uvec2 twice = @plus(@times(uvec2(low, 0u), 2u), width);
    return @ratio(twice, @times(uvec2(parts, 0u), 2u), 0);
}

/* The point low + width u of [0, parts), divided by parts, with the 53 high bits of `bits` as u;
 * the middle where rounding reaches an edge of [low, low + width). */
float @stratum(uint low, uint width, uint parts, uvec2 bits) {
    uvec2 u = uvec2(bits.x & 0xfffff800u, bits.y);
    uint whole = @below(u, width);
    uvec2 fraction = @times(u, width);
    int exponent = -32;
    @round53(whole, fraction);
    whole += low;
    @round53(whole, fraction);
    if (fraction.x == 0u && fraction.y == 0u && (whole == low || whole == low + width))
        return @middle(low, width, parts);
    for (; whole < 0x20000000u; --exponent) { /* all 53 bits to the upper two words */
        whole = (whole << 1) | (fraction.y >> 31);
        fraction = @times(fraction, 2u);
    }
    if (whole >= 0x40000000u) {
        exponent += 2;
        fraction.y = (fraction.y >> 2) | (whole << 30);
        whole >>= 2;
    }
    return @ratio(uvec2(fraction.y, whole), uvec2(parts, 0u), exponent);
}
%part jittered
%limit count 268435456
%need stratum
%if cell random
%need philox
%end
%if sides
const uint @sides[{{dimension}}] = uint[{{dimension}}](
    {{sides}}
);

%end
/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
%if sides
    uint low = index, width = 1u, parts = @sides[dimension];
    for (uint k = 0u; k < dimension; ++k) low /= @sides[k];
    low %= parts;
%else
    /* Row r of rows has the cells r n / rows to (r + 1) n / rows - 1, rounded down. A guess in
     * floating point, put right. */
    uint n = {{count}}u, rows = {{rows}}, quotient = n / rows, rest = n % rows;
    uint row = min(uint(float(index) * (float(rows) / float(n))), rows - 1u);
    while (row * quotient + row * rest / rows > index) --row;
    while ((row + 1u) * quotient + (row + 1u) * rest / rows <= index) ++row;
    uint begin = row * quotient + row * rest / rows;
    uint cells = (row + 1u) * quotient + (row + 1u) * rest / rows - begin;
    uint low = dimension == 0u ? index - begin : begin;
    uint width = dimension == 0u ? 1u : cells;
    uint parts = dimension == 0u ? cells : n;
%end
%if cell random
    uvec2 bits = @random(seed, uvec2(0u, 0u), {{dimension}}u * index + dimension);
    return @stratum(low, width, parts, bits);
%else
    return @middle(low, width, parts);
%end
}
%use shape
%part permuted
%need wide
/* Next number of SplitMix64. Source: G. L. Steele, D. Lea, C. H. Flood, OOPSLA (2014). */
uvec2 @mixed(uvec2 z, int shift, uvec2 factor) {
    z = uvec2(z.x ^ ((z.x >> shift) | (z.y << (32 - shift))), z.y ^ (z.y >> shift));
    uvec2 product = @times(z, factor.x);
    return uvec2(product.x, product.y + z.x * factor.y);
}
uvec2 @next(inout uvec2 state) {
    state = @plus(state, 0x7f4a7c15u);
    state.y += 0x9e3779b9u;
    uvec2 z = @mixed(state, 30, uvec2(0x1ce4e5b9u, 0xbf58476du));
    return @mixed(@mixed(z, 27, uvec2(0x133111ebu, 0x94d049bbu)), 31, uvec2(1u, 0u));
}

/* Image of i under a random permutation of 0, ..., size - 1: shuffled if it is small, else a cipher
 * that is repeated until the image is below size. */
uint @permuted(uint i, uint size, uvec2 key) {
    if (size <= 64u) {
        uint images[64];
        for (uint last = 0u; last < size; ++last) {
            uint j = @below(@next(key), last + 1u);
            images[last] = images[j];
            images[j] = last;
        }
        return images[i];
    }
    uint keys[24];
    int width = int(findMSB(size - 1u)) + 1;
    uint mask = 0xffffffffu >> (32 - width);
    for (int t = 0; t < 24; ++t) keys[t] = @next(key).y >> (32 - width);
    do {
        for (int r = 0; r < 24; r += 2) {
            i = ((i ^ keys[r]) * (keys[r + 1] | 1u)) & mask;
            i ^= i >> ((width + 1) / 2);
        }
    } while (i >= size);
    return i;
}
%part multi-jittered
%limit count 268435456
%need philox
%need permuted
%need stratum
/* The strip along axis `dimension`, of {{count}}, of the point in cell i. */
uint @strip(uint i, uint dimension, uint seed) {
    uint n = {{count}}u, columns = {{columns}}, rows = n / columns;
    uint column = i % columns, row = i / columns;
%if rest
    uint rest = n % columns; /* points of the last row, evenly spread over the columns */
    uint phase = @below(@random(seed, uvec2(4u, 0u), 1u), columns);
    uint turn = @below(@random(seed, uvec2(4u, 0u), 2u), n);
    if (row == rows) {
        column = ((column + 1u) * columns - phase - 1u) / rest;
        if (dimension == 1u)
            return row * columns + @permuted(i % columns, rest, @random(seed, uvec2(4u, 0u), 0u));
    }
%end
    if (dimension == 1u)
        return row * columns + @permuted(column, columns, @random(seed, uvec2(3u, 0u), row));
%if rest
    uint before = (column * rest + phase) / columns;
    if (((column + 1u) * rest + phase) / columns > before)
        row = @permuted(row, rows + 1u, @random(seed, uvec2(2u, 0u), column));
    else
        row = @permuted(row, rows, @random(seed, uvec2(1u, 0u), column));
    return (column * rows + before + row + turn) % n;
%else
    return column * rows + @permuted(row, rows, @random(seed, uvec2(1u, 0u), column));
%end
}

/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    uint n = {{count}}u;
%if order shuffled
    uint i = @permuted(index, n, @random(seed, uvec2(0u, 0u), 0u));
%else
    uint i = index;
%end
    uint strip = @strip(i, dimension, seed);
%if centered true
    return @middle(strip, 1u, n);
%else
    return @stratum(strip, 1u, n, @random(seed, uvec2(0x80000000u + dimension, 0u), index));
%end
}
%use shape
%part correlated-multi-jittered
%limit count 268435456
%need philox
%need permuted
%need stratum
/* Coordinate `dimension` of point `index` of {{count}}, in [0, 1). */
float @@(uint index, uint dimension, uint seed) {
    uint n = {{count}}u, columns = {{columns}}, rows = (n + columns - 1u) / columns;
%if order shuffled
    uint strip = @permuted(index, n, @random(seed, uvec2(0u, 0u), 0u)), strips = n;
%else
    uint strip = index, strips = n;
%end
    if (dimension == 0u) {
        uint row = @permuted(strip / columns, rows, @random(seed, uvec2(2u, 0u), 0u));
        strip = @permuted(strip % columns, columns, @random(seed, uvec2(1u, 0u), 0u)) * rows + row;
        strips = columns * rows;
    }
%if centered true
    return @middle(strip, 1u, strips);
%else
    return @stratum(strip, 1u, strips, @random(seed, uvec2(0x80000000u + dimension, 0u), index));
%end
}
%use shape
%part concentric
/* Concentric map of the unit square to the unit disk. Source: P. Shirley, K. Chiu (1997),
 * doi:10.1080/10867651.1997.10487479. */
vec2 @concentric(float u, float v) {
    float a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    bool wide = abs(a) > abs(b);
    float r = wide ? a : b, across = wide ? b : a;
    float angle = 0.785398163 * (across / (r == 0.0 ? 1.0 : r));
    float along = r * cos(angle), beside = r * sin(angle);
    return wide ? vec2(along, beside) : vec2(beside, along);
}
%part polar
/* Polar map of the unit square to the unit disk. */
vec2 @polar(float u, float v) {
    float r = sqrt(u);
    return vec2(r * cos(6.28318531 * v), r * sin(6.28318531 * v));
}
%part disk
%if method concentric
%need concentric
%else
%need polar
%end
%if method rejection naive
%refuse --warp {{name}}: method {{method}} cannot be emitted; polar and concentric can
%end
/* {{summary}}: method {{method}}, centre {{center}}, radius {{radius}}. */
vec2 {{function}}(float u, float v) {
%if method concentric
    vec2 q = @concentric(u, v);
%else
    vec2 q = @polar(u, v);
%end
    float radius = {{radius}};
    return vec2(float({{center.0}}) + radius * q.x, float({{center.1}}) + radius * q.y);
}
%part triangle
/* {{summary}}: method {{method}}, vertices {{vertices.text}}. */
vec{{dims}} {{function}}(float u, float v) {
    const float vertex[{{vertices.size}}] = float[{{vertices.size}}](
        {{vertices}}
    );
%if method sqrt
    float root = sqrt(u);
    float l0 = 1.0 - root, l1 = root * v, l2 = root * (1.0 - v);
%else
    float most = max(u, v), less = 0.5 * min(u, v), l0 = 1.0 - most;
    float l1 = u > v ? most - less : less, l2 = u > v ? less : most - less;
%end
    vec{{dims}} p;
    for (int k = 0; k < {{dims}}; ++k)
        p[k] = l0 * vertex[k] + l1 * vertex[k + {{dims}}] + l2 * vertex[k + 2 * {{dims}}];
    return p;
}
%part direction
/* Direction with 1 - cos and 1 + cos of its angle from the z axis, and a longitude in turns. */
vec3 @direction(float below, float above, float longitude) {
    float r = sqrt(below * above), angle = 6.28318531 * longitude;
    return vec3(r * cos(angle), r * sin(angle), 0.5 * (above - below));
}
%part sphere
%need direction
%if method z
%else
%refuse --warp {{name}}: method {{method}} cannot be emitted; z can
%end
/* {{summary}}: centre {{center}}, radius {{radius}}. */
vec3 {{function}}(float u, float v) {
    vec3 q = @direction(2.0 * u, 2.0 * (1.0 - u), v);
    float radius = {{radius}};
    return vec3(float({{center.0}}) + radius * q.x, float({{center.1}}) + radius * q.y,
                float({{center.2}}) + radius * q.z);
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
vec3 {{function}}(float u, float v) {
%if method uniform
    return @direction(u, 1.0 + (1.0 - u), v);
%else
%if disk concentric
    float r = max(abs(2.0 * u - 1.0), abs(2.0 * v - 1.0));
    vec2 q = @concentric(u, v);
    return vec3(q.x, q.y, sqrt((1.0 - r) * (1.0 + r)));
%else
    vec2 q = @polar(u, v);
    return vec3(q.x, q.y, sqrt(1.0 - u));
%end
%end
}
%part cone
%need direction
%if axis 0,0,1
%else
%refuse --warp {{name}}: axis {{axis}} cannot be emitted; 0,0,1 can
%end
/* {{summary}}: half-angle {{half-angle}} degrees, about the z axis. */
vec3 {{function}}(float u, float v) {
    float angle = radians(float({{half-angle}}));
    float below = 2.0 * sin(0.5 * angle) * sin(0.5 * angle); /* 1 - cos of the half-angle */
    float above = 2.0 * cos(0.5 * angle) * cos(0.5 * angle);
    return @direction(below * u, above + below * (1.0 - u), v);
}
