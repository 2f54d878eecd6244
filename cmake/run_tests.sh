#!/bin/sh
# Runs the tests of a build folder and says what was skipped, and why.
#
#   cmake/run_tests.sh build/dev [jobs]
set -eu

build=$1
jobs=${2:-1}
log=$build/Testing/tests.log
mkdir -p "$build/Testing"

status=0
ctest --test-dir "$build" --output-on-failure --parallel "$jobs" > "$log" 2>&1 || status=$?
if [ "$status" -ne 0 ]; then
  grep -v ' Passed \|^ *Start ' "$log" || true
fi

skipped=$(grep -c '\*\*\*Skipped' "$log" || true)
grep 'tests passed' "$log" || tail -n 5 "$log"
grep '^Total Test time' "$log" || true
if [ "$skipped" -gt 0 ]; then
  echo "$skipped of these were skipped:"
  grep '\*\*\*Skipped' "$log" | sed 's/^[^:]*: *//; s/ \.*\**Skipped.*//' | sed 's/^/  /' | head -n 40
  if [ ! -d ../shared/data ]; then
    echo "Most need ../shared/data (models and recorded results by others), which is not beside"
    echo "this checkout; every behaviour that they check is also checked on our own corpus."
  fi
fi
exit "$status"
