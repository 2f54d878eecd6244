#!/bin/sh
# The worst case of the Varanus paper's stress test: n states, n events, every state leads to every
# state. Explores it from CSPM text and prints time and memory against n as a table with bars, whose
# length is the logarithm of the seconds.
#
#   tests/bench/worst_case.sh BUILD [N...]
#
# `names`: n definitions of n choices each. `rows`: one definition with a parameter; the targets of
# each state are another permutation, so that no two states are bisimilar. `paper`: one definition
# with a parameter; all states are bisimilar, which a compression would find.
set -eu

build=$1
shift
[ $# -gt 0 ] || set -- 250 500 1000 2000 4000
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

script() { # FORM N
  case $1 in
  names)
    awk -v n="$2" 'BEGIN {
      printf "channel e : {0..%d}\n", n - 1
      for (i = 0; i < n; ++i) {
        printf "P%d = e.0 -> P0", i
        for (x = 1; x < n; ++x) printf " [] e.%d -> P%d", x, x
        print ""
      }
      print "P(i) = P0"
    }'
    ;;
  rows)
    printf 'channel e : {0..%d}\nP(i) = [] x : {0..%d} @ e.x -> P((x * 7919 + i * i) %% %d)\n' \
      $(($2 - 1)) $(($2 - 1)) "$2"
    ;;
  paper)
    printf 'channel e : {0..%d}\nP(i) = [] x : {0..%d} @ e.x -> P(if i < %d then x else 0)\n' \
      $(($2 - 1)) $(($2 - 1)) "$2"
    ;;
  esac
}

printf '%-6s %6s %12s %8s %6s\n' form n transitions seconds MB
for form in names rows paper; do
  for n in "$@"; do
    [ "$form" != names ] || [ "$n" -le 1000 ] || continue # the text alone would be 60 MB and more
    script "$form" "$n" >"$work/m.csp"
    /usr/bin/time -f '%e %M' -o "$work/time" \
      "$build/perentie" -q lts "$work/m.csp" -p 'P(0)' -o "$work/out.aut"
    awk -v form="$form" -v n="$n" -v header="$(head -1 "$work/out.aut")" '{
      split(header, size, /[(),]/)
      printf "%-6s %6d %12d %8.2f %6d  ", form, n, size[3], $1, $2 / 1024
      for (t = 0.05; t < $1; t *= 1.3) printf "#"
      print ""
    }' "$work/time"
  done
done
