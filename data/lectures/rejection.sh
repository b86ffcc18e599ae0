#!/bin/sh
# Rejection keeps the points of a square that are in its disk: pi/4 = 78.54 % of them; and those
# of a cube with 0.1 <= |v| <= 1, to be normalised to directions: pi/6 (1 - 0.1^3) = 52.30752 %.
# (The lower bound is there because directions of very short vectors are coarse.)
#
# A set says its efficiency in its meta and on stderr; here the lines are counted.
# Tolerance: 100000 Halton points; errors seen are 10 and 21 points, 100 are allowed. Random
# points would be off by 130 and 158 in one standard error.
set -e

kept=$(stipple generate halton -n 1e5 --start 1 -w disk:method=rejection --no-header | wc -l)
test "$kept" -ge 78440
test "$kept" -le 78640
echo "2-D: kept $kept of 100000; pi/4 of them are 78539.8"

kept=$(stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection,inner=0.1 \
    --no-header | wc -l)
test "$kept" -ge 52208
test "$kept" -le 52408
echo "3-D: kept $kept of 100000; pi/6 (1 - 0.001) of them are 52307.5"

# What is kept is uniform: E z^4 = 1/5 (density 1/(4 pi)). Tolerance: the error seen is
# 1.7e-4, and 0.001 is allowed. A loop that returns when a vector is bad, where it should draw
# another, keeps the other 47.7 %, too.
stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection --meta |
    stipple analyze integration -f text --expression 'z^4/(4*pi)' --exact 0.2 \
        --check 'expression.error>-0.001' --check 'expression.error<0.001'
