#!/usr/bin/env bash
# Every speed that docs/performance.md speaks of, on this machine: tables on the terminal, CSV files in build/bench.
# With a GPU it is measured too. BENCH_SECONDS: time to spend on a row, 1 if not set. SUITE: of `weir bench`, quick if not
# set; its rows go to build/bench/SUITE.csv. COMPARE: rows of an earlier run; a loss over 10 % fails.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p build/bench
build/weir info >build/bench/machine.txt
suite=${SUITE:-quick} seconds=${BENCH_SECONDS:-1}
[[ $suite == quick ]] && node bench/run.mjs "$seconds"
echo "suite $suite -> build/bench/$suite.csv"
build/weir bench --suite "$suite" --seconds "$seconds" --csv ${COMPARE:+--compare "$COMPARE"} | tee "build/bench/$suite.csv"
