#!/bin/sh
# Points of the unit disk. The radius r = sqrt(xi) is right: P(r < 1/2) = 1/4, the share of the
# area. The radius r = xi is naive: P(r < 1/2) = 1/2, so half of the points lie in a quarter of
# the area.
#
# Given only the domain, `analyze integration` assumes uniform points, with the density 1/pi.
# Its estimate for f/pi is therefore the mean of f over the points. (With --meta it would know
# the method and use the density of the method.) Tolerance: the errors of 4096 Halton points are
# 3e-4 or less, and 1.5e-3 with rejection. The bound 0.003 is twice that.
set -e

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s)\n", text, $2, slide }' report.txt
}

# half_radius SLIDE METHOD SENTENCE
half_radius() {
    stipple generate halton -n 4096 --start 1 -w "disk:method=$2" --quiet |
        stipple analyze integration -f text --domain disk --expression '(x^2 + y^2 < 1/4)/pi' \
            --exact "$1" --check 'expression.error>-0.003' --check 'expression.error<0.003' \
            >report.txt
    say "$3" "$1"
}

half_radius 1/4 polar 'With r = sqrt(xi), a quarter of the points lie within half the radius:'
half_radius 1/4 concentric \
    'With the concentric map, a quarter of the points lie within half the radius:'
half_radius 1/4 rejection \
    'With rejection from a square, a quarter of the points lie within half the radius:'
half_radius 1/2 naive 'With r = xi (naive), half of the points lie within half the radius:'

# verdict METHOD SLIDE SENTENCE: a chi-square test with both tails. "stratified" means more even
# than random points, "non-uniform" too uneven for uniform points.
verdict() {
    stipple generate halton -n 4096 --start 1 -w "disk:method=$1" --meta |
        stipple analyze chi-square -f text --check "verdict==$2" >report.txt
    awk -v text="$3" -v slide="$2" '
        $1 == "verdict" { print text, $2, "(slide: " slide ")" }' report.txt
}

verdict polar stratified 'Chi-square verdict with r = sqrt(xi):'
verdict naive non-uniform 'Chi-square verdict with r = xi:'

for method in polar naive; do
    stipple generate halton -n 300 --start 1 -w disk:method=$method -o $method.json
done
stipple plot polar.json naive.json --labels 'r = sqrt(xi),r = xi' --width 640 --height 360 \
    -o disk.svg
