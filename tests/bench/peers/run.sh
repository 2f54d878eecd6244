#!/bin/sh
# Explores models in CSPM by perentie and their twins in Promela by SPIN, in turn, on one processor,
# five times each, and prints the medians of the seconds with their ratio. The counts of states must
# be equal.
#
#   tests/bench/peers/run.sh BUILD
set -eu

build=$1
models=$(dirname "$0")
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# spin_of MODEL N: makes the verifier $work/MODEL.
spin_of() {
  (cd "$work" && cp "$OLDPWD/$models/$1.pml" . && spin -o3 -a -DN="$2" "$1.pml" >spin.log &&
    cc -O2 -w -DSAFETY -DNOREDUCE -DBFS -DMEMLIM=8000 -o "$1" pan.c)
}

seconds_of() { /usr/bin/time -f %e "$@" 2>&1 >"$work/output" | tail -1; }

median() { sort -n | sed -n 3p; }

compare() { # MODEL N SCRIPT
  spin_of "$1" "$2"
  : >"$work/ours"
  : >"$work/theirs"
  for _ in 1 2 3 4 5; do
    seconds_of "$build/perentie" lts "$3" -p "SYSTEM($2)" --stats --workers 1 >>"$work/ours"
    our_states=$(awk '/^whole:/ { gsub(",", "", $2); print $2 }' "$work/output")
    seconds_of "$work/$1" -E >>"$work/theirs"
    their_states=$(awk '/states, stored/ { print $1 }' "$work/output")
  done
  ours=$(median <"$work/ours")
  theirs=$(median <"$work/theirs")
  ratio=$(awk "BEGIN { printf \"%.1f\", $theirs / $ours }")
  printf '%-14s %3s %12s %12s %10s %10s %7s\n' \
    "$1" "$2" "$our_states" "$their_states" "$ours" "$theirs" "$ratio"
}

printf '%-14s %3s %12s %12s %10s %10s %7s\n' model n states "SPIN's" seconds "SPIN's" ratio
compare philosophers 8 corpus/philosophers/philosophers.csp
compare protocols 3 "$models/protocols.csp"
compare workers 32 "$models/workers.csp"
