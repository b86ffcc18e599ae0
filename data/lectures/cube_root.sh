#!/bin/sh
# Inversion of the density p(x) = 3/2 x^2 on [-1, 1]: F(x) = (x^3 + 1)/2, so x = cbrt(2 xi - 1).
# Use a real cube root such as cbrt: pow(-1, 1.0/3) gives NaN in most languages. E x^2 = 3/5,
# and P(|x| < 1/2) = 1/8.
#
# The mean of f over the points estimates the integral of f p. Tolerance: the first 4096 points
# of the van der Corput sequence lie in 4096 strata, one in each. The count in an interval is
# therefore wrong by at most two points, and the share by 0.0005. The bounds are twice that.
set -e
stipple generate van-der-corput -n 4096 -w 'power:exponent=2,range=[-1,1]' -o power.json

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s", text, $2, slide }
        $1 == "expression.exact" { print (slide == $2 ? "" : sprintf(" = %.4f", $2)) ")" }
    ' report.txt
}

# mean_is SLIDE F SENTENCE
mean_is() {
    stipple analyze integration power.json -f text --expression "($2)*3/2*x^2" --exact "$1" \
        --check 'expression.error>-0.001' --check 'expression.error<0.001' >report.txt
    say "$3" "$1"
}

mean_is 0 x 'The mean of x is'
mean_is 3/5 'x^2' 'The mean of x^2 is'
mean_is 1/8 'abs(x) < 1/2' 'The share of the points with |x| < 1/2 is'

stipple plot power.json --chart histogram --title 'x = cbrt(2 xi - 1) has the density 3/2 x^2' \
    --width 640 --height 320 -o cube_root.svg
