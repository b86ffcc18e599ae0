#!/bin/sh
# The 100-point Halton set in bases 2 and 3. Textbooks begin at index 1, libraries at 0, the
# origin. Its star discrepancy D* happens to be the same for both: 0.05024, where 100 random
# points have about 0.12. Its L2 star discrepancy is not: 0.01527 from index 0, 0.01283 from 1.
set -e

# D* is computed exactly; the bounds are half a unit of the last digit quoted.
for start in 0 1; do
    stipple generate halton -n 100 --start $start -o halton_$start.csv
    stipple analyze star-discrepancy halton_$start.csv -f text \
        --check 'value>0.050235' --check 'value<0.050245'
done

# The root of Warnock's formula, exact sums; half a unit of the last digit again.
stipple analyze l2-discrepancy halton_0.csv --kind star -f text \
    --check 'star.value>0.015265' --check 'star.value<0.015275'
stipple analyze l2-discrepancy halton_1.csv --kind star -f text \
    --check 'star.value>0.012825' --check 'star.value<0.012835'

# Twenty random sets, with fixed seeds: five standard errors below their mean is 0.094.
stipple generate random -n 100 -m 20 -f npy |
    stipple analyze star-discrepancy --average -f text --check 'value>0.09'
