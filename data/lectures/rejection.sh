#!/bin/sh
# Rejection keeps the points of a square that are in its disk: pi/4 = 78.54 % of them; and those
# of a cube with 0.1 <= |v| <= 1, to be normalised to directions: pi/6 (1 - 0.1^3) = 52.30752 %.
# (The lower bound is there because directions of very short vectors are coarse.)
#
# The program reports the efficiency on stderr, and in the provenance; here the lines are counted.
# Tolerance: 100000 Halton points; errors seen are 10 and 21 points, 100 are allowed. Random
# points would be off by 130 and 158 in one standard error.
set -e

kept=$(stipple generate halton -n 1e5 --start 1 -w disk:method=rejection \
    --quiet --no-header | wc -l)
echo "Of 100000 points of a square, its disk keeps $((kept)) (slide: 78540, pi/4 of them)"
test "$kept" -ge 78440
test "$kept" -le 78640

kept=$(stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection,inner=0.1 \
    --quiet --no-header | wc -l)
echo "Of 100000 points of a cube, its hollow ball keeps $((kept)) (slide: 52308)"
test "$kept" -ge 52208
test "$kept" -le 52408

# What is kept is uniform: E z^4 = 1/5 (density 1/(4 pi)). Tolerance: the error seen is
# 1.7e-4, and 0.001 is allowed. A loop that returns when a vector is bad, where it should draw
# another, keeps the other 47.7 %, too.
stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection --quiet --meta |
    stipple analyze integration -f text --expression 'z^4/(4*pi)' --exact 1/5 \
        --check 'expression.error>-0.001' --check 'expression.error<0.001' >report.txt
LC_ALL=C awk '$1 == "expression.estimate" {
    printf "The mean of z^4 over the directions kept is %.4f (slide: 1/5)\n", $2
}' report.txt

# The points of the square, kept and rejected ones in two colours.
stipple generate halton -n 700 --start 1 --bounds=-1..1,-1..1 --no-header |
    LC_ALL=C awk -F , '{ print >($1*$1 + $2*$2 < 1 ? "kept.csv" : "rejected.csv") }'
stipple plot kept.csv rejected.csv --overlay --labels kept,rejected \
    --title '700 points of the square' --width 440 --height 440 -o rejection.svg
