#!/bin/sh
# Points of a square, divided by their length, are directions with a bias towards the diagonals.
# The density of the angle is 1/(8 cos^2 theta) for |theta| < pi/4, and the same for the other
# three sides. So E cos 4 theta = 3 - pi = -0.1415927. For uniform directions it is 0.
#
# Given only the domain, `analyze integration` assumes uniform points, with the density
# 1/(2 pi). Its estimate for f/(2 pi) is therefore the mean of f over the points. (With --meta it
# would know the method and use the density of the method.) Tolerance: the error of 65536 Halton
# points is 5e-5; ten times that is allowed.
set -e

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" {
            number = sprintf("%.4f", $2)
            sub(/^-0.0000$/, "0.0000", number)  # a small negative number, rounded
            printf "%s %s (slide: %s", text, number, slide
        }
        $1 == "expression.exact" { print (slide == $2 ? "" : sprintf(" = %.4f", $2)) ")" }
    ' report.txt
}

# mean_is SLIDE METHOD COORDINATES SENTENCE
mean_is() {
    stipple generate halton -n 65536 -d "$3" --start 1 -w "circle:method=$2" |
        stipple analyze integration -f text --domain circle \
            --expression 'cos(4*atan2(y, x))/(2*pi)' --exact "$1" \
            --check 'expression.error>-0.0005' --check 'expression.error<0.0005' >report.txt
    say "$4" "$1"
}

mean_is '3 - pi' square-normalize 2 \
    'Over normalised points of a square, the mean of cos 4 theta is'
mean_is 0 angle 1 'Over uniform directions, the mean of cos 4 theta is'

# The picture is a histogram of the angles in degrees. The diagonals are at 45, 135,
# -45 and -135.
stipple generate halton -n 65536 --start 1 -w circle:method=square-normalize --no-header |
    LC_ALL=C awk -F , '{ print 180/3.14159265358979*atan2($2, $1) }' >angles.csv
stipple plot angles.csv --chart histogram --axes 'angle in degrees' \
    --title 'Directions of the points of a square' --width 640 --height 320 \
    -o square_directions.svg
