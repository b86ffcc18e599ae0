#!/bin/sh
# Directions from uniform latitude and longitude crowd at the poles: E z^2 = E sin^2 = 1/2.
# Uniform ones have uniform height z: E z^2 = 1/3.
#
# Told the domain alone (not --meta, whose method it would make up for), integration takes the points
# for uniform: the mean of f is the integral of f/(4 pi). Tolerance: 4096 Halton points are off by less than 1e-6; a
# thousand times that still tells 1/2 from 1/3.
set -e

# mean_is EXACT METHOD
mean_is() {
    stipple generate halton -n 4096 --start 1 -w "sphere:method=$2" |
        stipple analyze integration -f text --domain sphere --expression 'z^2/(4*pi)' --exact "$1" \
            --check 'expression.error>-0.001' --check 'expression.error<0.001'
}

mean_is 0.5 naive-lat-long
mean_is 0.3333333333 z
