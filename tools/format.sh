#!/usr/bin/env bash
# Formats every C file, or with --check fails and names those that are not formatted.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
mapfile -t files < <(git ls-files --cached --others --exclude-standard '*.c' '*.h')
if [[ ${1-} == --check ]]; then
    clang-format-19 --dry-run --Werror "${files[@]}"
    echo "${#files[@]} C files are formatted"
else
    clang-format-19 -i "${files[@]}"
fi
