#!/bin/sh
# Antialiasing: the share of a pixel that lies below an edge, y < 0.3 + 0.4 x, is 1/2. Of
# n^2 = 16 samples, random ones see it with an RMS error of sqrt(1/2 1/2/16) = 0.125. Jittered
# ones, one in each of 4 x 4 cells, err only in the four cells that the edge cuts. It covers
# 0.4, 0.8, 0.2 and 0.6 of these, so that the error is sqrt(0.24 + 0.16 + 0.16 + 0.24)/16 = 0.0559.
#
# Tolerance: for 1000 pixels the RMS error itself has a standard error of 2.2 % (normal errors)
# or less; the bounds are the value -+ 11 %, five of these. Five of those of the mean of random
# samples, 0.125/sqrt(1000), are 0.02.
set -e

# errors KIND LOW HIGH
errors() {
    stipple generate "$1" -n 16 -m 1000 -f npy |
        stipple analyze integration --average -f text --expression 'y < 0.3 + 0.4*x' \
            --exact 0.5 --check 'expression.error>-0.02' --check 'expression.error<0.02' \
            --check "expression.rms_error>$2" --check "expression.rms_error<$3"
}

errors random 0.111 0.139
errors jittered 0.0497 0.0621

# The samples of an image of 8 x 8 pixels, 16 in each: jittered points in 32 x 32 cells.
stipple generate jittered -n 1024 -w pixel:resolution=8x8 -o antialiasing.svg
