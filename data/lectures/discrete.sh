#!/bin/sh
# Inversion of a discrete distribution with the probabilities 0.2, 0, 0.3, 0.5. The cumulative
# probabilities are 0.2, 0.2, 0.5, 1; the first one above xi determines the outcome. Outcome 1
# has the probability 0 and must never occur, not even for xi = 0.2 exactly, which must give
# outcome 2.
#
# Tolerance: 1000 regular values of xi, (i + 1/2)/1000, give each outcome in exact proportion,
# so only rounding errors remain.
set -e
stipple generate grid -n 1000 -d 1 -w 'discrete:probabilities=[0.2,0,0.3,0.5]' -o discrete.json

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s)\n", text, $2, slide }' report.txt
}

# share SLIDE OUTCOME: estimates the sum over all x of the indicator of OUTCOME times p(x), the
# probability of x. This sum is the share of OUTCOME.
share() {
    p='(x == 0 ? 0.2 : x == 2 ? 0.3 : x == 3 ? 0.5 : 0)'
    stipple analyze integration discrete.json -f text --expression "(x == $2)*$p" --exact "$1" \
        --check 'expression.error>-1e-12' --check 'expression.error<1e-12' >report.txt
    say "The share of outcome $2 is" "$1"
}

share 0.2 0
share 0.3 2
share 0.5 3

# Outcome 1 never occurs. (grep -c fails if it counts 0, hence "|| true".)
stipple analyze chi-square discrete.json -f text --check 'impossible_points==0' >report.txt
ones=$(grep -c '^\[1\]' discrete.json || true)
echo "Outcome 1 occurs $ones times in 1000 (slide: 0)"
test "$ones" -eq 0

# The outcomes of xi = 0.2 itself and of the next smaller floating-point number.
printf '0.2\n0.19999999999999998\n' |
    stipple warp discrete --probabilities 0.2,0,0.3,0.5 --no-header >edge.txt
echo "xi = 0.2 gives outcome $(sed -n 1p edge.txt) (slide: 2)"
echo "The next smaller floating-point number gives outcome $(sed -n 2p edge.txt) (slide: 0)"
printf '2\n0\n' | cmp - edge.txt

# The picture shows 100 values of xi on the vertical axis, and their outcomes on the horizontal
# one.
stipple generate grid -n 100 -d 1 --no-header -o xi.csv
stipple warp discrete --probabilities 0.2,0,0.3,0.5 xi.csv --no-header -o outcomes.csv
paste -d , outcomes.csv xi.csv | stipple plot --from csv --axes outcome,xi \
    --title 'Inversion: the outcome of each xi' --width 560 --height 280 -o discrete.svg
