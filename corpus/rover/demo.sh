#!/bin/sh
# What `make demo` shows: a rover's log that keeps to its model, and one that does not.
#
#   sh corpus/rover/demo.sh PERENTIE
set -eu

perentie=$1

# Shows a command and its result; the run must end with the exit code $1.
run() {
  expected=$1
  shift
  echo "\$ perentie $*"
  code=0
  "$perentie" "$@" || code=$?
  if [ "$code" -ne "$expected" ]; then
    echo "the demo expected exit code $expected here, not $code" >&2
    exit 1
  fi
}

cat <<'TEXT'

A rover patrols a nuclear store. corpus/rover/rover.csp is the CSP model of what it may do: among other
things, it must go back to the entry (move.0) as soon as the radiation is not green.

First, the log of a patrol. Each message becomes an event of the model, and each event is permitted:

TEXT
run 0 monitor corpus/rover/pass.yaml
cat <<'TEXT'

Then a log in which reading 50 is red, and the rover goes on to waypoint 1. The monitor says which event
was wrong, and what the model permitted instead:

TEXT
run 1 monitor corpus/rover/red_ignored.yaml
cat <<'TEXT'

That was the demo. Next: perentie --help, and README.md.
TEXT
