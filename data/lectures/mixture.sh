#!/bin/sh
# A mixture takes a point from one density with probability 0.6, and from another with
# probability 0.4. The coordinate that selects the density is rescaled to [0, 1) and used again,
# so a point of the mixture needs no more coordinates than a point of its components.
set -e

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s)\n", text, $2, slide }' report.txt
}

# Two components that do not overlap: uniform on [0, 1] and on [2, 3]. The mean of f over the
# points estimates the integral of f p, where p is 0.6 on [0, 1] and 0.4 on [2, 3]. Tolerance:
# the count in an interval among 4096 points of the van der Corput sequence is wrong by at most
# two points, and the share by 0.0005.
low='power:exponent=0,range=[0,1]'
high='power:exponent=0,range=[2,3]'
stipple generate van-der-corput -n 4096 -w "mixture:weights=[0.6,0.4],components=[$low|$high]" \
    -o mixture.json

# share SLIDE CONDITION
share() {
    stipple analyze integration mixture.json -f text --exact "$1" \
        --expression "($2)*(x < 3/2 ? 0.6 : 0.4)" \
        --check 'expression.error>-0.0005' --check 'expression.error<0.0005' >report.txt
    say "The share of the points with $2 is" "$1"
}

share 0.6 'x < 3/2'
share 0.4 'x > 3/2'
share 0.3 'x < 1/2'
share 0.8 'x < 5/2'

# Two lobes of a phase function, g = 0.7 forward and g = -0.3 backward. The mean cosine of a
# lobe is its g, so E cos theta = 0.6 0.7 - 0.4 0.3 = 0.3. The density is
# 0.6 H(0.7) + 0.4 H(-0.3), where H(g) = (1 - g^2)/(4 pi (1 + g^2 - 2 g z)^(3/2)). Tolerance: the
# error of 4096 Halton points is 3e-4; 0.002 is allowed.
density='(0.6*0.51/(1.49 - 1.4*z)^1.5 + 0.4*0.91/(1.09 + 0.6*z)^1.5)/(4*pi)'
stipple generate halton -n 4096 --start 1 --meta -o lobes.csv -w \
    'mixture:weights=[0.6,0.4],components=[henyey-greenstein:g=0.7|henyey-greenstein:g=-0.3]'
stipple analyze integration lobes.csv -f text --expression "z*$density" --exact 0.3 \
    --check 'expression.error>-0.002' --check 'expression.error<0.002' >report.txt
say 'The mean cos theta of the two lobes is' 0.3

# The picture is a histogram of z = cos theta: -1 is backward, 1 is forward.
stipple plot lobes.csv --column z --chart histogram --axes 'cos theta' \
    --title 'Two lobes, 0.6 forward and 0.4 backward' --width 640 --height 320 -o mixture.svg
