#!/bin/sh
# Radical inverses in base 2: write i in base 2 and reverse its digits behind the binary point.
# 1 is 1, which becomes 0.1 = 1/2; 2 is 10, which becomes 0.01 = 1/4; 3 is 11, which becomes
# 0.11 = 3/4.
set -e

# radical_inverse I SLIDE: compares the point of index I of the van der Corput sequence with the
# slide's number. Binary fractions are exact, so they are compared as text.
radical_inverse() {
    x=$(stipple generate van-der-corput -n 1 --start "$1" --no-header)
    echo "The radical inverse of $1 is $x (slide: $2)"
    test "$x" = "$2"
}

radical_inverse 0 0
radical_inverse 1 0.5
radical_inverse 2 0.25
radical_inverse 3 0.75
radical_inverse 4 0.125
radical_inverse 5 0.625
radical_inverse 6 0.375
radical_inverse 7 0.875

# star_discrepancy SLIDE SENTENCE: prints the exact star discrepancy of the points on standard
# input.
star_discrepancy() {
    stipple analyze star-discrepancy -f text --check "value==$1" >report.txt
    awk -v text="$2" -v slide="$1" '
        $1 == "value" { print text, $2, "(slide: " slide ")" }' report.txt
}

# The first eight numbers are i/8 in another order, so their star discrepancy is 1/8. The
# textbook's five numbers, 1/2 1/4 3/4 1/8 5/8, all lie in [0, 3/4]. The share of the points in
# this interval is 1, which is 1/4 more than its length.
stipple generate van-der-corput -n 8 |
    star_discrepancy 0.125 'The eight numbers from index 0 have the star discrepancy'
stipple generate van-der-corput -n 5 --start 1 |
    star_discrepancy 0.25 'The five numbers from index 1 have the star discrepancy'

# The Hammersley set of 8 points: i/8 to the right, the radical inverse of i upwards.
stipple plot --generate hammersley -n 8 --axes 'i/8,radical inverse of i' \
    --title 'Radical inverses in base 2' --width 400 --height 400 -o radical_inverses.svg
