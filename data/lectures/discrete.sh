#!/bin/sh
# A discrete variable with the probabilities 0.2, 0, 0.3, 0.5 by inversion: the first outcome
# whose cumulative probability, 0.2, 0.2, 0.5, 1, is above xi. The one with probability 0 never
# comes, not even for xi = 0.2 exactly, which must give outcome 2.
#
# Tolerance: 1000 regular xi, (i + 1/2)/1000, fall on the outcomes in exact proportion; only
# rounding remains.
set -e
stipple generate grid -n 1000 -d 1 -w 'discrete:probabilities=[0.2,0,0.3,0.5]' -o discrete.json

# say SENTENCE SLIDE: the sentence, the estimate in report.txt, and the number on the slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s)\n", text, $2, slide }' report.txt
}

# share SLIDE OUTCOME: the mean of an indicator is the sum of it times the probabilities p.
share() {
    p='(x == 0 ? 0.2 : x == 2 ? 0.3 : x == 3 ? 0.5 : 0)'
    stipple analyze integration discrete.json -f text --expression "(x == $2)*$p" --exact "$1" \
        --check 'expression.error>-1e-12' --check 'expression.error<1e-12' >report.txt
    say "The share of outcome $2 is" "$1"
}

share 0.2 0
share 0.3 2
share 0.5 3

# Outcome 1 never comes. (grep -c fails if it counts 0, hence "|| true".)
stipple analyze chi-square discrete.json -f text --check 'impossible_points==0' >report.txt
ones=$(grep -c '^\[1\]' discrete.json || true)
echo "Outcome 1 comes $ones times in 1000 (slide: 0)"
test "$ones" -eq 0

# The value xi = 0.2 itself, and the double below it.
printf '0.2\n0.19999999999999998\n' |
    stipple warp discrete --probabilities 0.2,0,0.3,0.5 --no-header >edge.txt
echo "xi = 0.2 gives outcome $(sed -n 1p edge.txt) (slide: 2)"
echo "The double below 0.2 gives outcome $(sed -n 2p edge.txt) (slide: 0)"
printf '2\n0\n' | cmp - edge.txt

# Inversion as a picture: 100 values of xi on the vertical axis, and their outcomes.
stipple generate grid -n 100 -d 1 --no-header -o xi.csv
stipple warp discrete --probabilities 0.2,0,0.3,0.5 xi.csv --no-header -o outcomes.csv
paste -d , outcomes.csv xi.csv | stipple plot --from csv --axes outcome,xi \
    --title 'Inversion: the outcome of each xi' --width 560 --height 280 -o discrete.svg
