#!/bin/sh
# 100 Halton points in bases 2 and 3. Textbooks begin with index 1, many libraries with index 0,
# whose point is the origin. Both sets happen to have the same star discrepancy D*, 0.05024; 100
# random points have about 0.12. Their L2 star discrepancies differ: 0.01527 from index 0,
# 0.01283 from index 1.
set -e

# say SENTENCE SLIDE KEY DIGITS: prints the sentence, the result KEY of report.txt, and the
# slide's number.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" -v key="$3" -v digits="$4" \
        '$1 == key { printf "%s %." digits "f (slide: %s)\n", text, $2, slide }' report.txt
}

# D* is computed exactly. The bounds are half a unit of the slide's last digit.
for start in 0 1; do
    stipple generate halton -n 100 --start $start -o halton_$start.csv
    stipple analyze star-discrepancy halton_$start.csv -f text \
        --check 'value>0.050235' --check 'value<0.050245' >report.txt
    say "The star discrepancy of 100 Halton points from index $start is" 0.05024 value 5
done

# The L2 star discrepancy is the root of Warnock's formula. The bounds are again half a unit of
# the last digit.
stipple analyze l2-discrepancy halton_0.csv --kind star -f text \
    --check 'star.value>0.015265' --check 'star.value<0.015275' >report.txt
say 'The L2 star discrepancy of 100 Halton points from index 0 is' 0.01527 star.value 5
stipple analyze l2-discrepancy halton_1.csv --kind star -f text \
    --check 'star.value>0.012825' --check 'star.value<0.012835' >report.txt
say 'The L2 star discrepancy of 100 Halton points from index 1 is' 0.01283 star.value 5

# Twenty random sets, with fixed seeds. Their mean minus five standard errors is 0.094.
stipple generate random -n 100 -m 20 -f npy |
    stipple analyze star-discrepancy --average -f text --check 'value>0.09' >report.txt
say 'The mean star discrepancy of 20 sets of 100 random points is' 'about 0.12' value 3

stipple generate random -n 100 -o random.csv
stipple plot halton_0.csv halton_1.csv random.csv --labels 'Halton from 0,Halton from 1,random' \
    --width 720 --height 280 -o halton_100.svg
