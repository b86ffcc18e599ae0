#!/bin/sh
# The 100-point Halton set in bases 2 and 3. Textbooks begin at index 1, libraries at 0, the
# origin. Its star discrepancy D* happens to be the same for both: 0.05024, where 100 random
# points have about 0.12. Its L2 star discrepancy differs: 0.01527 from index 0, 0.01283 from 1.
set -e

# say SENTENCE SLIDE KEY DIGITS: the sentence, the result KEY in report.txt, and the slide's number.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" -v key="$3" -v digits="$4" \
        '$1 == key { printf "%s %." digits "f (slide: %s)\n", text, $2, slide }' report.txt
}

# D* is computed exactly; the bounds are half a unit of the last digit quoted.
for start in 0 1; do
    stipple generate halton -n 100 --start $start -o halton_$start.csv
    stipple analyze star-discrepancy halton_$start.csv -f text \
        --check 'value>0.050235' --check 'value<0.050245' >report.txt
    say "The star discrepancy of 100 Halton points from index $start is" 0.05024 value 5
done

# The root of Warnock's formula, exact sums; half a unit of the last digit again.
stipple analyze l2-discrepancy halton_0.csv --kind star -f text \
    --check 'star.value>0.015265' --check 'star.value<0.015275' >report.txt
say 'The L2 star discrepancy from index 0 is' 0.01527 star.value 5
stipple analyze l2-discrepancy halton_1.csv --kind star -f text \
    --check 'star.value>0.012825' --check 'star.value<0.012835' >report.txt
say 'The L2 star discrepancy from index 1 is' 0.01283 star.value 5

# Twenty random sets, with fixed seeds: five standard errors below their mean is 0.094.
stipple generate random -n 100 -m 20 -f npy |
    stipple analyze star-discrepancy --average -f text --check 'value>0.09' >report.txt
say 'The mean star discrepancy of 20 sets of 100 random points is' 'about 0.12' value 3

stipple generate random -n 100 -o random.csv
stipple plot halton_0.csv halton_1.csv random.csv --labels 'Halton from 0,Halton from 1,random' \
    --width 720 --height 280 -o halton_100.svg
