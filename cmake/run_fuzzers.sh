#!/bin/sh
# Runs each fuzz target of a build for some seconds, with the corpus as seeds. What it finds new is
# kept in the build beside the target; an input that fails is printed and ends the run.
#
#   cmake/run_fuzzers.sh BUILD SECONDS [TARGET...]
set -eu

programs=$1/tests/fuzz
seconds=$2
shift 2
[ $# -gt 0 ] || set -- fuzz_parser fuzz_types fuzz_evaluator fuzz_aut fuzz_traces fuzz_configs

for target in "$@"; do
  echo "$target: $seconds s"
  mkdir -p "$programs/found/$target"
  "$programs/$target" "$programs/found/$target" "$programs/seeds/$target" \
    -dict=tests/fuzz/cspm.dict -max_len=4000 -timeout=20 -rss_limit_mb=3000 -close_fd_mask=1 \
    -print_final_stats=1 -artifact_prefix="$programs/found/$target-" \
    -max_total_time="$seconds" 2>"$programs/$target.log" || {
    tail -40 "$programs/$target.log"
    exit 1
  }
  grep -E 'number_of_executed_units|peak_rss' "$programs/$target.log"
done
