#!/bin/sh
# Uniform points of the triangle x, y >= 0, x + y <= 1 by the marginal density of x and the
# conditional density of y:
#
#     p(x) = 2 - 2x         x = 1 - sqrt(xi1)
#     p(y|x) = 1/(1 - x)    y = xi2 (1 - x)
#
# (1 - sqrt(1 - xi1) has the same density, but reverses the order of the strata.)
#
# The means are 1/3, the variances are 1/18, and the covariance is -1/36.
#
# The mean of f over the points estimates the integral of f times their density, which is 2.
# Tolerance: the errors of 4096 Halton points are up to 5e-4 here; twice that is allowed. The
# errors of random points are about 5e-3.
set -e
stipple generate halton -n 4096 --start 1 -w 'triangle:vertices=[1,0 0,0 0,1]' -o triangle.json

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
    stipple analyze integration triangle.json -f text --expression "2*($2)" --exact "$1" \
        --check 'expression.error>-0.001' --check 'expression.error<0.001' >report.txt
    say "$3" "$1"
}

mean_is 1/3 x 'The mean of x is'
mean_is 1/3 y 'The mean of y is'
mean_is 1/18 '(x - 1/3)^2' 'The variance of x is'
mean_is 1/18 '(y - 1/3)^2' 'The variance of y is'
mean_is -1/36 '(x - 1/3)*(y - 1/3)' 'The covariance of x and y is'

# The marginal density gives P(x < 1/2) = 1 - (1 - 1/2)^2. By the conditional density, y/(1 - x)
# is uniform on [0, 1].
mean_is 3/4 'x < 1/2' 'Marginal: the share of the points with x < 1/2 is'
mean_is 1/2 'y/(1 - x)' 'Conditional: y/(1 - x) is uniform on [0, 1]; its mean is'
mean_is 1/3 '(y/(1 - x))^2' 'The mean of (y/(1 - x))^2 is'
mean_is 1/4 'y/(1 - x) < 1/4' 'The share of the points with y/(1 - x) < 1/4 is'

# The mistake is to draw y from F(x, y)/F(x, 1), which is P(Y <= y | X <= x). For a given x, it
# puts the share x/(2 - x) of the points above the slanted side. The mean of this share over all
# x is 3 - 4 ln 2.
mean_is '3 - 4*ln(2)' 'x/(2 - x)' \
    'The share of the points that the mistake puts outside the triangle is'

# The picture shows both. The mistake is solved for y: F(x, y)/F(x, 1) is 2 y/(2 - x) below the
# slanted side, and 1 - (1 - y)^2/(2 x - x^2) above it.
stipple generate halton -n 400 --start 1 -w 'triangle:vertices=[1,0 0,0 0,1]' --no-header \
    -o right.csv
stipple generate halton -n 400 --start 1 --no-header | LC_ALL=C awk -F , '{
    x = 1 - sqrt($1)
    y = $2*(2 - x)/2
    if (y > 1 - x) y = 1 - sqrt((1 - $2)*(2*x - x*x))
    print x "," y
}' >mistake.csv
stipple plot right.csv mistake.csv --labels 'conditional,joint cumulative function' \
    --width 640 --height 360 -o triangle_density.svg
