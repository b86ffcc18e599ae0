#!/bin/sh
# Radical inverses in base 2: write i in base 2 and mirror its digits at the point, so that
# 1 = 1 becomes .1 = 1/2, 2 = 10 becomes .01 = 1/4, 3 = 11 becomes .11 = 3/4, and so on.
set -e

# radical_inverse I: the one point with index I; the mean of x over one point is the point.
radical_inverse() {
    stipple generate van-der-corput -n 1 --start "$1" | stipple analyze integration \
        --expression x -f text "$2" "$3"
}

# The first eight, as on the slide. Halves of halves are exact, so they are compared with ==.
radical_inverse 0 --check 'expression.estimate==0'
radical_inverse 1 --check 'expression.estimate==0.5'
radical_inverse 2 --check 'expression.estimate==0.25'
radical_inverse 3 --check 'expression.estimate==0.75'
radical_inverse 4 --check 'expression.estimate==0.125'
radical_inverse 5 --check 'expression.estimate==0.625'
radical_inverse 6 --check 'expression.estimate==0.375'
radical_inverse 7 --check 'expression.estimate==0.875'

# Together they are i/8 in another order, so their star discrepancy is 1/8; that of the
# textbook's five, 1/2 1/4 3/4 1/8 5/8, is 1/4: all of them lie in [0, 3/4].
stipple generate van-der-corput -n 8 |
    stipple analyze star-discrepancy -f text --check 'value==0.125'
stipple generate van-der-corput -n 5 --start 1 |
    stipple analyze star-discrepancy -f text --check 'value==0.25'
