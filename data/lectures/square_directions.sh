#!/bin/sh
# Directions of the points of a square, normalised: biased towards the diagonals. The density of
# the angle is 1/(8 cos^2 theta) for |theta| < pi/4, and the same on the other sides, so that
# E cos 4 theta = 3 - pi = -0.1415927; for uniform directions it is 0.
#
# Told the domain alone (not --meta, whose method it would make up for), integration takes the points
# for uniform: the mean of f is the integral of f/(2 pi).
# Tolerance: 65536 Halton points are off by 5e-5; ten times that.
set -e

# mean_is EXACT METHOD COORDINATES
mean_is() {
    stipple generate halton -n 65536 -d "$3" --start 1 -w "circle:method=$2" |
        stipple analyze integration -f text --domain circle --expression 'cos(4*atan2(y, x))/(2*pi)' \
            --exact "$1" --check 'expression.error>-0.0005' --check 'expression.error<0.0005'
}

mean_is -0.1415926536 square-normalize 2
mean_is 0 angle 1
