#!/usr/bin/env bash
# Builds parts of Weir.
#   tools/build.sh native  build/weir (CMake preset `native`)
#   tools/build.sh wasm    the core and the page's C for the browser (CMake preset `wasm`)
#   tools/build.sh page    wasm and the page: web/dist
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Configures once; CMake itself notices later changes.
preset() {
    [[ -e build/$1/build.ninja ]] || cmake --preset "$1" "${@:2}" >build/configure.log ||
        { cat build/configure.log >&2; return 1; }
}

mkdir -p build
tests=()
for part in "$@"; do
    case $part in
    native)
        # The program alone: tests need more packages and are built by `make check`.
        [[ -e build/native/build.ninja ]] || tests=(-DWEIR_TESTS=OFF)
        preset native "${tests[@]}"
        cmake --build build/native --target weir
        ln -sfn native/weir build/weir
        ;;
    wasm)
        preset wasm
        cmake --build build/wasm
        ;;
    page)
        tools/build.sh wasm
        (cd web && npm run --silent build)
        ;;
    *)
        echo "tools/build.sh: unknown part '$part'" >&2
        exit 2
        ;;
    esac
done
