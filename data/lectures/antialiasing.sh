#!/bin/sh
# Antialiasing: half of a pixel lies below an edge, y < 0.3 + 0.4 x. With 16 random samples, the
# estimate of this share has an RMS error of sqrt(1/2 1/2/16) = 0.125. With 16 jittered samples,
# one in each of 4 x 4 cells, the error comes only from the four cells that the edge cuts. The
# parts of these cells below the edge are 0.4, 0.8, 0.2 and 0.6, so the RMS error is
# sqrt(0.24 + 0.16 + 0.16 + 0.24)/16 = 0.0559.
#
# Tolerance: for 1000 pixels the RMS error has a standard error of 2.2 % (for normal errors) or
# less. Its bounds are the value -+ 11 %, which is five standard errors. The mean share of
# random samples has the standard error 0.125/sqrt(1000); five of these are 0.02.
set -e

# errors KIND SLIDE LOW HIGH
errors() {
    stipple generate "$1" -n 16 -m 1000 -f npy |
        stipple analyze integration --average -f text --expression 'y < 0.3 + 0.4*x' \
            --exact 1/2 --check 'expression.error>-0.02' --check 'expression.error<0.02' \
            --check "expression.rms_error>$3" --check "expression.rms_error<$4" >report.txt
    LC_ALL=C awk -v kind="$1" -v slide="$2" '
        $1 == "expression.estimate" {
            printf "16 %s samples in each of 1000 pixels: ", kind
            printf "the mean share below the edge is %.3f (slide: 1/2)\n", $2
        }
        $1 == "expression.rms_error" {
            printf "16 %s samples: the RMS error of a pixel is %.4f (slide: %s)\n", kind, $2, slide
        }' report.txt
}

errors random 0.125 0.111 0.139
errors jittered 0.0559 0.0497 0.0621

# One pixel with random samples and, to its right, one with jittered samples. Colours separate
# the samples below the edge from those above; dots draw the edge and the pixel.
stipple generate random -n 16 --no-header -o samples.csv
stipple generate jittered -n 16 --bounds 1.2..2.2,0..1 --no-header >>samples.csv
LC_ALL=C awk -F , '{
    x = $1 < 1.1 ? $1 : $1 - 1.2
    print >($2 < 0.3 + 0.4*x ? "below.csv" : "above.csv")
}' samples.csv
stipple generate grid -n 40 -d 1 --no-header | LC_ALL=C awk '{
    for (left = 0; left < 2; left += 1.2) {
        print left + $1 "," 0.3 + 0.4*$1
        print left + $1 ",0\n" left + $1 ",1\n" left "," $1 "\n" left + 1 "," $1
    }
}' >edge.csv
stipple plot edge.csv below.csv above.csv --overlay \
    --labels 'edge and pixel,below the edge,above it' \
    --title '16 random samples of a pixel; 16 jittered ones' --width 640 --height 360 \
    -o antialiasing.svg
