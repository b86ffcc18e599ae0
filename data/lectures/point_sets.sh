#!/bin/sh
# Random, jittered (stratified) and Poisson-disk sets of 400 points each. The distance of a
# point to its nearest neighbour measures the difference that the eye sees in the picture.
#
# The least distance is divided by the largest possible one, that of the densest packing of the
# torus. This ratio is 0.78 for Poisson-disk sets. Random and jittered sets have pairs of points
# that almost meet. The mean distance of random points is 1/(2 sqrt(n)) = 0.025. Tolerance: five
# standard errors, 0.0007, for this mean. The other bounds separate the three kinds.
set -e

# distances KIND SLIDE CHECK CHECK: prints means over 16 sets.
distances() {
    stipple generate "$1" -n 400 -m 16 -f npy |
        stipple analyze nearest-neighbor --average -f text --check "$3" --check "$4" >report.txt
    LC_ALL=C awk -v kind="$1" -v slide="$2" '
        $1 == "mean" { mean = $2 }
        $1 == "relative_radius" {
            printf "%s: mean distance %.3f, least distance ", kind, mean
            printf "%.2f of the largest possible (slide: %s)\n", $2, slide
        }' report.txt
}

distances random 0.04 'mean>0.0243' 'mean<0.0257'
distances jittered 0.10 'mean>0.029' 'relative_radius<0.2'
distances poisson-disk 0.78 'mean>0.04' 'relative_radius>0.7'

# The picture has sets of 300 points, which are easier to see.
stipple plot --generate random --generate jittered --generate poisson-disk -n 300 \
    --width 720 --height 280 -o point_sets.svg
