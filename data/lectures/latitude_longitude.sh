#!/bin/sh
# Directions with uniform latitude and longitude crowd at the poles: E z^2 = 1/2, the mean of
# sin^2 of the latitude. Uniform directions have a uniform height z: E z^2 = 1/3.
#
# Given only the domain, `analyze integration` assumes uniform points, with the density
# 1/(4 pi). Its estimate for f/(4 pi) is therefore the mean of f over the points. (With --meta it
# would know the method and use the density of the method.) Tolerance: the error of 4096 Halton
# points is less than 1e-6. The bound is a thousand times that, and still separates 1/2 from
# 1/3.
set -e

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s)\n", text, $2, slide }' report.txt
}

# mean_is SLIDE METHOD SENTENCE
mean_is() {
    stipple generate halton -n 4096 --start 1 -w "sphere:method=$2" |
        stipple analyze integration -f text --domain sphere --expression 'z^2/(4*pi)' \
            --exact "$1" --check 'expression.error>-0.001' --check 'expression.error<0.001' \
            >report.txt
    say "$3" "$1"
}

mean_is 1/2 naive-lat-long 'With uniform latitude and longitude, the mean of z^2 is'
mean_is 1/3 z 'With uniform height and longitude, the mean of z^2 is'

for method in naive-lat-long z; do
    stipple generate halton -n 400 --start 1 -w sphere:method=$method -o $method.json
done
stipple plot naive-lat-long.json z.json --labels 'uniform latitude,uniform height' \
    --width 640 --height 360 -o latitude_longitude.svg
