#!/bin/sh
# Regular, random and jittered points for the integral over [0, 1] of a smooth function, x^2, and
# of a discontinuous one, 1 where x < 1/3; both integrals are 1/3. RMS errors of n points:
#
#                x^2                   x < 1/3
#     random     sqrt(4/45) n^-1/2     sqrt(2/9) n^-1/2
#     jittered   1/3 n^-3/2            sqrt(2/9) n^-1
#     regular    1/12 n^-2             1/3 n^-1          (n = 4^k)
#
# So random points do not converge faster than regular ones: in one dimension they are the worst.
set -e

# regular N FUNCTION ESTIMATE: the points are (i + 1/2)/n, and the estimate is 1/3 less the error
# of the table but for rounding.
regular() {
    stipple generate grid -n "$1" -d 1 |
        stipple analyze integration -f text --expression "$2" --exact "$3" \
            --check 'expression.error>-1e-9' --check 'expression.error<1e-9'
}

regular 16 'x^2' 0.3330078125
regular 64 'x^2' 0.33331298828125
regular 16 'x < 1/3' 0.3125
regular 64 'x < 1/3' 0.328125

# errors KIND N FUNCTION LOW HIGH: the RMS error of 1000 sets is between LOW and HIGH.
errors() {
    stipple generate "$1" -n "$2" -d 1 -m 1000 -f npy |
        stipple analyze integration --average -f text --expression "$3" \
            --exact 0.33333333333333333 --check "expression.rms_error>$4" \
            --check "expression.rms_error<$5"
}

# For 1000 sets the RMS error itself has a standard error of 2.2 % (normal errors) or less; the
# bounds are the formula's value -+ 11 %, five of these.
errors random 16 'x^2' 0.06634 0.08273
errors random 64 'x^2' 0.03317 0.04137
errors random 16 'x < 1/3' 0.1049 0.1308
errors random 64 'x < 1/3' 0.05245 0.06541
errors jittered 16 'x^2' 0.004635 0.005781
errors jittered 64 'x^2' 0.0005794 0.0007227
errors jittered 16 'x < 1/3' 0.02622 0.03270
errors jittered 64 'x < 1/3' 0.006555 0.008176
