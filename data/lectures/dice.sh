#!/bin/sh
# Two dice. The joint probability of every pair is 1/36. Given the face of the second die, the
# conditional probability of every face of the first die is 1/6. It is estimated from the throws
# with this second face. (Always say which die is given. Here both ways give the same number,
# because the dice are alike.)
set -e
die='discrete:probabilities=[1,1,1,1,1,1],normalize=true,values=[1,2,3,4,5,6]'

# say SENTENCE SLIDE: prints the sentence, the estimate in report.txt, and the number on the
# slide.
say() {
    LC_ALL=C awk -v text="$1" -v slide="$2" '
        $1 == "expression.estimate" { printf "%s %.4f (slide: %s", text, $2, slide }
        $1 == "expression.exact" { print (slide == $2 ? "" : sprintf(" = %.4f", $2)) ")" }
    ' report.txt
}

# joint and conditional SLIDE CONDITION SENTENCE: estimate the sum of the probabilities of all
# pairs (1/36 each) or faces (1/6 each) that meet CONDITION. Tolerance: five standard errors,
# with fixed seeds: sqrt(1/36 35/36/36000) = 0.00087 and sqrt(1/6 5/6/6000) = 0.0048.
joint() {
    stipple analyze integration dice.csv -f text --expression "($2)/36" --exact "$1" \
        --check 'expression.error>-0.0044' --check 'expression.error<0.0044' >report.txt
    say "$3" "$1"
}
conditional() {
    stipple analyze integration given.csv --domain "$die" -f text --expression "($2)/6" \
        --exact "$1" --check 'expression.error>-0.024' --check 'expression.error<0.024' >report.txt
    say "$3" "$1"
}

stipple generate random -n 36000 -w "$die" --meta -o dice.csv
joint 1/36 'x == 3 && y == 5' 'Of all throws, the share with a 3 and then a 5 is'
joint 1/6 'x + y == 7' 'Of all throws, the share with the sum 7 is'
grep ',5$' dice.csv | stipple convert - --from csv --column 1 -o given.csv
conditional 1/6 'x == 3' 'Given a 5 on the second die, the share with a 3 on the first is'
grep '^3,' dice.csv | stipple convert - --from csv --column 2 -o given.csv
conditional 1/6 'x == 5' 'Given a 3 on the first die, the share with a 5 on the second is'

# The picture shows 720 throws as dots, each at a random position in the square of its pair. If
# the second die is given, only one row of squares counts.
stipple generate random -n 720 --no-header | LC_ALL=C awk -F , '{
    x = 0.5 + 6*$1
    y = 0.5 + 6*$2
    row = y > 4.5 && y < 5.5
    print x "," y >(!row ? "others.csv" : x > 2.5 && x < 3.5 ? "pair.csv" : "row.csv")
}'
stipple plot others.csv row.csv pair.csv --overlay --labels 'others,second die 5,3 and 5' \
    --axes 'first die,second die' --title '720 throws of two dice' --width 440 --height 440 \
    -o dice.svg
