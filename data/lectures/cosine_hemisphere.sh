#!/bin/sh
# Directions of a hemisphere with the density cos theta/pi have E cos theta = 2/3. Uniform
# directions, with the density 1/(2 pi), have E cos theta = 1/2.
#
# The mean of f over the points estimates the integral of f times their density. Here f is
# z = cos theta. Tolerance: the error of 4096 Halton points is 1.3e-4; 0.001 is allowed.
set -e

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s", text, $2, slide }
        $1 == "expression.exact" { print (slide == $2 ? "" : sprintf(" = %.4f", $2)) ")" }
    ' report.txt
}

# mean_is SLIDE METHOD DENSITY SENTENCE
mean_is() {
    stipple generate halton -n 4096 --start 1 -w "hemisphere:method=$2" --meta |
        stipple analyze integration -f text --expression "z*$3" --exact "$1" \
            --check 'expression.error>-0.001' --check 'expression.error<0.001' >report.txt
    say "$4" "$1"
}

mean_is 2/3 cosine 'z/pi' 'The mean cos theta of cosine-weighted directions is'
mean_is 1/2 uniform '1/(2*pi)' 'The mean cos theta of uniform directions is'

# The picture shows the directions from above. Cosine-weighted directions fill the disk evenly.
for method in cosine uniform; do
    stipple generate halton -n 300 --start 1 -w hemisphere:method=$method -o $method.json
done
stipple plot cosine.json uniform.json --column x,y --domain disk \
    --labels 'cosine-weighted (from above),uniform (from above)' --width 640 --height 360 \
    -o cosine_hemisphere.svg
