#!/bin/sh
# Two dice. Joint: every pair has probability 1/36. Conditional: given what the second die shows,
# every face of the first has 1/6; to condition is to keep the rows with that second face. (Which
# of the dice is the given one must be said; that the answer is the same is the symmetry's work.)
set -e
die='discrete:probabilities=[1,1,1,1,1,1],normalize=true,values=[1,2,3,4,5,6]'

# frequency EXACT CONDITION FILE: the mean of an indicator is the sum of indicator times
# probability, EXACT for each pair or face that meets the condition. Tolerance: five standard
# errors with fixed seeds, sqrt(1/36 35/36/36000) = 0.00087 and sqrt(1/6 5/6/6000) = 0.0048.
joint() {
    stipple analyze integration dice.csv -f text --expression "($2)/36" --exact "$1" \
        --check 'expression.error>-0.0044' --check 'expression.error<0.0044'
}
conditional() {
    stipple analyze integration given.csv --domain "$die" -f text --expression "($2)/6" \
        --exact "$1" --check 'expression.error>-0.024' --check 'expression.error<0.024'
}

stipple generate random -n 36000 -w "$die" --meta -o dice.csv
joint 0.0277777778 'x == 3 && y == 5'
joint 0.1666666667 'x + y == 7'
grep ',5$' dice.csv | stipple convert - --from csv --column 1 -o given.csv
conditional 0.1666666667 'x == 3'
grep '^3,' dice.csv | stipple convert - --from csv --column 2 -o given.csv
conditional 0.1666666667 'x == 5'
