#!/bin/sh
# Rejection keeps the points of a square that lie in its disk, pi/4 = 78.54 % of them. It keeps
# the points v of a cube with 0.1 <= |v| <= 1, pi/6 (1 - 0.1^3) = 52.30752 % of them, which are
# then divided by their length to get directions. (Shorter vectors are rejected because the
# rounding of their coordinates makes their directions inaccurate.)
#
# The program reports the efficiency on stderr and in the provenance. This script counts the
# lines. Tolerance: the errors of 100000 Halton points are 10 and 21 points; 100 points are
# allowed. For random points, one standard error would be 130 and 158 points.
set -e

kept=$(stipple generate halton -n 1e5 --start 1 -w disk:method=rejection \
    --quiet --no-header | wc -l)
echo "Of 100000 points of a square, $((kept)) lie in its disk (slide: 78540, pi/4 of them)"
test "$kept" -ge 78440
test "$kept" -le 78640

kept=$(stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection,inner=0.1 \
    --quiet --no-header | wc -l)
echo "Of 100000 points of a cube, $((kept)) lie in its hollow ball (slide: 52308)"
test "$kept" -ge 52208
test "$kept" -le 52408

# The directions are uniform: E z^4 = 1/5 (their density is 1/(4 pi)). Tolerance: the error is
# 1.7e-4; 0.001 is allowed. (A common mistake is a loop that returns a vector outside the ball
# instead of drawing another one. It also keeps the other 47.7 % of the vectors.)
stipple generate halton -n 1e5 -d 3 --start 1 -w sphere:method=rejection --quiet --meta |
    stipple analyze integration -f text --expression 'z^4/(4*pi)' --exact 1/5 \
        --check 'expression.error>-0.001' --check 'expression.error<0.001' >report.txt
LC_ALL=C awk '$1 == "expression.estimate" {
    printf "The mean of z^4 over the directions is %.4f (slide: 1/5)\n", $2
}' report.txt

# The picture shows the points of the square, kept and rejected ones in two colours.
stipple generate halton -n 700 --start 1 --bounds=-1..1,-1..1 --no-header |
    LC_ALL=C awk -F , '{ print >($1*$1 + $2*$2 < 1 ? "kept.csv" : "rejected.csv") }'
stipple plot kept.csv rejected.csv --overlay --labels kept,rejected \
    --title '700 points of the square' --width 440 --height 440 -o rejection.svg
