#!/usr/bin/env bash
# Runs every test and ends with one line, "N passed, N failed". A failed step does not keep the next from running.
# Each step's output is in build/check/.
set -uo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
logs=build/check
rm -rf "$logs"
mkdir -p "$logs"
jobs=$(nproc) # of ctest; the tests themselves have several threads
[[ $jobs -le 4 ]] || jobs=4
passed=0 failed=0 number=0
summary=()

# Test counts in a step's output: ctest's closing line and node:test's (spec or TAP). A step that counts nothing,
# such as a build, is one test itself.
count_tests() {
    awk '
        /tests? passed, [0-9]+ tests? failed out of [0-9]+/ {
            match($0, /[0-9]+ tests? failed/); bad = substr($0, RSTART) + 0
            match($0, /out of [0-9]+/); good = substr($0, RSTART + 7) - bad
            passed += good; failed += bad }
        { gsub(/\033\[[0-9;]*m/, "") }
        /^(#|ℹ) pass [0-9]+$/ { passed += $3 }
        /^(#|ℹ) (fail|cancelled) [0-9]+$/ { failed += $3 }
        END { print passed + 0, failed + 0 }' "$1"
}

step() {
    local name=$1 log good bad start=$SECONDS status
    shift
    number=$((number + 1))
    log=$logs/$(printf '%02d' "$number")-${name//[^a-z0-9]/-}.log
    printf '\n=== %s\n' "$name"
    "$@" 2>&1 | tee "$log"
    status=${PIPESTATUS[0]}
    read -r good bad < <(count_tests "$log")
    if [[ $status -eq 0 && $((good + bad)) -eq 0 ]]; then good=1; fi
    if [[ $status -ne 0 && $bad -eq 0 ]]; then bad=1; fi
    passed=$((passed + good))
    failed=$((failed + bad))
    summary+=("$(printf '%-28s %5d s  %4d passed  %4d failed%s' "$name" $((SECONDS - start)) "$good" "$bad" \
        "$([[ $bad -gt 0 ]] && echo "   see $log")")")
}

compile() {
    cmake --preset "$1" -DWEIR_TESTS=ON "${@:2}" >"$logs/configure-$1.log" 2>&1 || { cat "$logs/configure-$1.log"; return 1; }
    cmake --build "build/$1"
}

run_ctest() {
    [[ -e build/$1/build.ninja ]] || { echo "not built"; return 1; }
    (cd "build/$1" && ctest -j "$jobs" --output-on-failure --no-tests=error --timeout 600 "${@:2}")
}

in_web() {
    (cd web && npm run --silent "$1")
}

step "format" tools/format.sh --check
step "build native (gcc)" compile native
ln -sfn native/weir build/weir
step "tests native (gcc)" run_ctest native
step "random scenes" /usr/bin/python3 -B tools/stress.py --scenes 16 --time 0.25 --particles 1500 --backend cpu
# What differs between compilers is how they optimise the solver, and what their sanitizers see in it and in what reads
# scenes: both build and test that in both ways. Programs and the GPU's host code run once natively and once with
# sanitizers, clang's, which check casts of floats and alignment too; most time of their tests goes into software drivers
# that compile shaders, whatever compiled Weir (what is labelled `driver` is left out there for that). One build is without the
# GPU, which is an option.
step "build native (clang)" compile clang
step "tests native (clang)" run_ctest clang -L core
step "build sanitizers (gcc)" compile sanitize -DWEIR_GPU=OFF
step "tests sanitizers (gcc)" run_ctest sanitize -L 'core|json'
step "build sanitizers (clang)" compile sanitize-clang
step "tests sanitizers (clang)" run_ctest sanitize-clang -LE driver
step "build wasm" tools/build.sh wasm
step "page types" in_web typecheck
step "build page" in_web build
step "tests node" in_web test:node
step "tests browsers" in_web test:browser

printf '\n'
printf '%s\n' "${summary[@]}"
printf '\n%d passed, %d failed\n' "$passed" "$failed"
[[ $failed -eq 0 ]]
