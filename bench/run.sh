#!/usr/bin/env bash
# Every speed that docs/performance.md speaks of, on this machine: tables on the terminal, CSV files in build/bench.
# With a GPU it is measured too. BENCH_SECONDS: time to spend on a row, 1 if not set.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mkdir -p build/bench
build/weir info >build/bench/machine.txt
exec node bench/run.mjs "${BENCH_SECONDS:-1}"
