#!/bin/sh
# Points of the unit disk. r = sqrt(xi) is right: P(r < 1/2) = 1/4, the share of the area.
# r = xi is naive: P(r < 1/2) = 1/2, as many points in a quarter of the area.
#
# Told the domain alone (not --meta, whose method it would make up for), integration takes the points
# for uniform: the mean of f is the integral of f/pi.
# Tolerance: 4096 Halton points are off by 3e-4 and less, where points are dropped by 1.5e-3;
# 0.003 is twice that.
set -e

# half_radius EXACT METHOD
half_radius() {
    stipple generate halton -n 4096 --start 1 -w "disk:method=$2" |
        stipple analyze integration -f text --domain disk --expression '(x^2 + y^2 < 1/4)/pi' --exact "$1" \
            --check 'expression.error>-0.003' --check 'expression.error<0.003'
}

half_radius 0.25 polar
half_radius 0.25 concentric
half_radius 0.25 rejection
half_radius 0.5 naive

# Chi-square with both tails tells: the right one is more even than random, the naive one is wrong.
stipple generate halton -n 4096 --start 1 -w disk --meta |
    stipple analyze chi-square -f text --expect stratified
stipple generate halton -n 4096 --start 1 -w disk:method=naive --meta |
    stipple analyze chi-square -f text --check 'verdict==non-uniform'
