#!/bin/sh
# Directions of a hemisphere with density cos theta/pi: E cos theta = 2/3. Uniform ones, with
# density 1/(2 pi), have E cos theta = 1/2.
#
# The mean of f over the points is the integral of f times their density; f is z = cos theta.
# Tolerance: 4096 Halton points are off by 1.3e-4; 0.001 leaves room.
set -e

# mean_is EXACT METHOD DENSITY
mean_is() {
    stipple generate halton -n 4096 --start 1 -w "hemisphere:method=$2" --meta |
        stipple analyze integration -f text --expression "z*$3" --exact "$1" \
            --check 'expression.error>-0.001' --check 'expression.error<0.001'
}

mean_is 0.6666666667 cosine 'z/pi'
mean_is 0.5 uniform '1/(2*pi)'
