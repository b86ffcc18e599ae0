#!/bin/sh
# Regular, random and jittered points estimate two integrals over [0, 1]: that of the smooth
# function x^2, and that of a function with a jump, 1 where x < 1/3 and 0 elsewhere. Both are
# 1/3. The RMS errors of n points are:
#
#                x^2                   x < 1/3
#     random     sqrt(4/45) n^-1/2     sqrt(2/9) n^-1/2
#     jittered   1/3 n^-3/2            sqrt(2/9) n^-1
#     regular    1/12 n^-2             1/3 n^-1          (n = 4^k)
#
# So random points do not converge faster than regular ones. In one dimension they are the
# slowest.
set -e

# regular N FUNCTION SLIDE: uses the points (i + 1/2)/n. Except for rounding, the estimate is
# 1/3 minus the error in the table.
regular() {
    stipple generate grid -n "$1" -d 1 |
        stipple analyze integration -f text --expression "$2" --exact "$3" \
            --check 'expression.error>-1e-9' --check 'expression.error<1e-9' >report.txt
    LC_ALL=C awk -v text="$1 regular points estimate the integral of $2 as" '
        $1 == "expression.estimate" { printf "%s %.6f ", text, $2 }
        $1 == "expression.exact" { printf "(slide: %.6f)\n", $2 }' report.txt
}

regular 16 'x^2' 0.3330078125
regular 64 'x^2' 0.33331298828125
regular 16 'x < 1/3' 0.3125
regular 64 'x < 1/3' 0.328125

# errors KIND N FUNCTION SLIDE LOW HIGH: checks that the RMS error of 1000 sets lies between LOW
# and HIGH. Its standard error is 2.2 % (for normal errors) or less. The bounds are the slide's
# number -+ 11 %, which is five standard errors.
errors() {
    stipple generate "$1" -n "$2" -d 1 -m 1000 -f npy |
        stipple analyze integration --average -f text --expression "$3" --exact 1/3 \
            --check "expression.rms_error>$5" --check "expression.rms_error<$6" >report.txt
    LC_ALL=C awk -v text="$2 $1 points estimate the integral of $3 with the RMS error" \
        -v slide="$4" '
        $1 == "expression.rms_error" { printf "%s %.3g (slide: %s)\n", text, $2, slide }' report.txt
}

errors random 16 'x^2' 0.0745 0.06634 0.08273
errors random 64 'x^2' 0.0373 0.03317 0.04137
errors random 16 'x < 1/3' 0.118 0.1049 0.1308
errors random 64 'x < 1/3' 0.0589 0.05245 0.06541
errors jittered 16 'x^2' 0.00521 0.004635 0.005781
errors jittered 64 'x^2' 0.000651 0.0005794 0.0007227
errors jittered 16 'x < 1/3' 0.0295 0.02622 0.03270
errors jittered 64 'x < 1/3' 0.00737 0.006555 0.008176

# The picture shows these errors over n, with logarithmic axes.
stipple study --generators 'random;jittered;grid' -n 4,16,64,256 -d 1 --seeds 200 \
    --analyze 'integration:expression=x^2,exact=1/3;integration:expression=[x < 1/3],exact=1/3' \
    -o - | stipple plot --key expression.error --labels random,jittered,regular \
    --title 'Errors of three kinds of points' \
    --axes 'points n,RMS error of x^2,RMS error of x < 1/3' --width 560 --height 640 \
    -o quadrature.svg
