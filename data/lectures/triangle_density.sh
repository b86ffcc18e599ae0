#!/bin/sh
# Uniform points of the triangle x, y >= 0, x + y <= 1 by marginal and conditional:
#
#     p(x) = 2 - 2x         x = 1 - sqrt(xi1)
#     p(y|x) = 1/(1 - x)    y = xi2 (1 - x)
#
# (1 - sqrt(1 - xi1) has the same density, but turns the order of the strata.)
#
# Means are 1/3, variances 1/18, and the covariance is -1/36.
#
# The mean of f over the points is the integral of f times their density, which is 2.
# Tolerance: 4096 Halton points are off by up to 5e-4 here, and twice that is allowed; random
# points are off by some 5e-3.
set -e
stipple generate halton -n 4096 --start 1 -w 'triangle:vertices=[1,0 0,0 0,1]' -o triangle.json

# mean_is EXACT F
mean_is() {
    stipple analyze integration triangle.json -f text --expression "2*($2)" --exact "$1" \
        --check 'expression.error>-0.001' --check 'expression.error<0.001'
}

mean_is 0.3333333333 'x'
mean_is 0.3333333333 'y'
mean_is 0.0555555556 '(x - 1/3)^2'
mean_is 0.0555555556 '(y - 1/3)^2'
mean_is -0.0277777778 '(x - 1/3)*(y - 1/3)'

# The marginal: P(x < 1/2) = 1 - (1 - 1/2)^2. The conditional: y/(1 - x) is uniform on [0, 1].
mean_is 0.75 'x < 1/2'
mean_is 0.5 'y/(1 - x)'
mean_is 0.3333333333 '(y/(1 - x))^2'
mean_is 0.25 'y/(1 - x) < 1/4'

# The mistake: to draw y from F(x, y)/F(x, 1), which is P(Y <= y | X <= x). At given x the part
# of it above the slanted side is x/(2 - x); over all x that puts 3 - 4 ln 2 of the points outside.
mean_is 0.2274112777 'x/(2 - x)'
