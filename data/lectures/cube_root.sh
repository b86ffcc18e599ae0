#!/bin/sh
# The density p(x) = 3/2 x^2 on [-1, 1] by inversion: F(x) = (x^3 + 1)/2, so x = cbrt(2 xi - 1).
# It takes cbrt, as pow of a negative number and 1/3 is no number. E x^2 = 3/5, and
# P(|x| < 1/2) = 1/8.
#
# The mean of f over the points is the integral of f p. Tolerance: 4096 points of the van der
# Corput sequence are one in each of 4096 strata, so that the share of an interval is off by at
# most two of them, 0.0005; twice that.
set -e
stipple generate van-der-corput -n 4096 -w 'power:exponent=2,range=[-1,1]' -o power.json

# mean_is EXACT F
mean_is() {
    stipple analyze integration power.json -f text --expression "($2)*3/2*x^2" --exact "$1" \
        --check 'expression.error>-0.001' --check 'expression.error<0.001'
}

mean_is 0 'x'
mean_is 0.6 'x^2'
mean_is 0.125 'abs(x) < 1/2'
