#!/bin/sh
# A discrete variable with the probabilities 0.2, 0, 0.3, 0.5 by inversion: the first outcome
# whose cumulative probability, 0.2, 0.2, 0.5, 1, is above xi. The one with probability 0 never
# comes, not even for xi = 0.2 exactly, which must give outcome 2.
#
# Tolerance: 1000 regular xi, (i + 1/2)/1000, fall on the outcomes in exact proportion; what is
# left is rounding.
set -e
stipple generate grid -n 1000 -d 1 -w 'discrete:probabilities=[0.2,0,0.3,0.5]' -o discrete.json

# share EXACT OUTCOME: the mean of an indicator is the sum of it times the probabilities p.
share() {
    p='(x == 0 ? 0.2 : x == 2 ? 0.3 : x == 3 ? 0.5 : 0)'
    stipple analyze integration discrete.json -f text --expression "(x == $2)*$p" --exact "$1" \
        --check 'expression.error>-1e-12' --check 'expression.error<1e-12'
}

share 0.2 0
share 0.3 2
share 0.5 3
stipple analyze chi-square discrete.json -f text --check 'impossible_points==0'
test "$(grep -c '^\[1\]' discrete.json)" -eq 0

# The value xi = 0.2 itself, and the double below it.
printf '0.2\n0.19999999999999998\n' |
    stipple warp discrete --probabilities 0.2,0,0.3,0.5 --no-header >edge.txt
printf '2\n0\n' | cmp - edge.txt
