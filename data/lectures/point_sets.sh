#!/bin/sh
# Random, stratified (jittered) and Poisson-disk sets of 400 points each, side by side:
# point_sets.svg shows them from left to right, point_sets.csv is a table of their distances.
set -e
{
    stipple generate random -n 400 --no-header
    stipple generate jittered -n 400 --bounds 1.1..2.1,0..1 --no-header
    stipple generate poisson-disk -n 400 --bounds 2.2..3.2,0..1 --no-header
} | stipple convert - --from csv -o point_sets.svg

# What the eye sees, over 16 sets each: the least distance, relative to that of the densest
# packing of the torus. Poisson-disk sets have 0.78 of it; random and jittered ones have pairs
# that almost meet. The mean distance of random points is 1/(2 sqrt(n)) = 0.025.
# Tolerance: five standard errors, 0.0007, for that one; the others lie between the kinds.
# distances KIND CHECK CHECK
distances() {
    stipple generate "$1" -n 400 -m 16 -o "$1.npy"
    stipple analyze nearest-neighbor "$1.npy" --average -o "$1.csv" --check "$2" --check "$3"
}

distances random 'mean>0.0243' 'mean<0.0257'
distances jittered 'mean>0.029' 'relative_radius<0.2'
distances poisson-disk 'mean>0.04' 'relative_radius>0.7'
{
    cat random.csv
    tail -n 1 jittered.csv
    tail -n 1 poisson-disk.csv
} >point_sets.csv
cat point_sets.csv
