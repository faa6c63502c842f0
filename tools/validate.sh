#!/usr/bin/env bash
# Runs every validation case and writes one HTML report; results of other resolutions that lie beside are compared.
#   tools/validate.sh [RESOLUTION [option of weir validate...]]
# DOCS=1 also writes docs/validation/. Exit status: that of weir validate.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
resolution=${1:-normal}
[[ $# -eq 0 ]] || shift
out=build/validation
mkdir -p "$out"
status=0
build/weir validate --resolution "$resolution" --out "$out/$resolution" "$@" || status=$?
[[ $status -le 1 ]] || exit "$status"
folders=("$out/$resolution")
for other in coarse normal fine; do
    [[ $other == "$resolution" || ! -e $out/$other/results.json ]] || folders+=("$out/$other")
done
docs=()
[[ -z ${DOCS-} ]] || docs=(--docs docs/validation)
/usr/bin/python3 -B tools/validation_report.py "${folders[@]}" --html "$out/report.html" "${docs[@]}"
exit "$status"
