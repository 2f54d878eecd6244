#!/bin/sh
# Runs the tests of a build folder and says at the end how many were skipped, and why. Further
# arguments go to ctest.
#
#   cmake/run_tests.sh build/test 8 --label-regex cli
set -u

folder=$1
jobs=$2
shift 2
results=$PWD/$folder/results.xml
ctest --test-dir "$folder" -j "$jobs" --output-on-failure --output-junit "$results" "$@"
code=$?

# A skipped GoogleTest prints `file:line: Skipped`, and on the next line the reason.
awk '
  /<testcase /         { tests++ }
  reason_follows       { reasons[$0]++; skipped++; reason_follows = 0 }
  /:[0-9]+: Skipped$/  { reason_follows = 1 }
  END {
    printf "%d tests, %d of them skipped\n", tests, skipped
    for (reason in reasons) printf "  %d skipped: %s\n", reasons[reason], reason | "sort -rn"
  }' "$results"
exit $code
