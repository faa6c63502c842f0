#!/usr/bin/env bash
# Installs what a build needs and is missing; says what before it does. Fast when all is there.
#   tools/setup.sh [native] [web] [check] [report]
#     native  compiler, CMake, Ninja, jansson, assimp, wgpu-native: build/weir
#     web     clang for wasm, Node and the page's npm packages: the page
#     check   browsers, software Vulkan, clang-format, cmocka: the tests
#     report  matplotlib: the report of `make validate`
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Debian package names; versions are those of the distribution, the rest is pinned by hash.
native_packages="gcc libc6-dev cmake ninja-build pkg-config libjansson-dev libassimp-dev libvulkan1 python3 python3-pip ca-certificates"
web_packages="clang-19 lld-19 llvm-19 wasi-libc libclang-rt-19-dev-wasm32"
check_packages="clang-19 clang-format-19 libclang-rt-19-dev libcmocka-dev python3-jsonschema mesa-vulkan-drivers
                chromium firefox-esr fonts-dejavu-core"
report_packages="python3-matplotlib"
node_minimum=18

stop() {
    printf '\n' >&2
    printf '%s\n' "$@" >&2
    exit 1
}

node_major() {
    local version
    version=$(node --version 2>/dev/null) || version=v0
    version=${version#v}
    echo "${version%%.*}"
}

# A newer Node from elsewhere is as good as the distribution's, if npm came with it.
node_is_ready() {
    command -v npm >/dev/null && [[ $(node_major) -ge $node_minimum ]]
}

wanted_packages() {
    local scope
    for scope in "$@"; do
        case $scope in
        native) echo "$native_packages" ;;
        web)
            echo "$web_packages"
            if ! node_is_ready; then
                [[ $(node_major) -ge $node_minimum ]] || echo nodejs
                command -v npm >/dev/null || echo npm
            fi
            ;;
        check) echo "$check_packages $report_packages" ;;
        report) echo "$report_packages" ;;
        *) stop "tools/setup.sh: unknown scope '$scope' (native, web, check, report)" ;;
        esac
    done
}

missing_packages() {
    local package have
    have=$(dpkg-query --show --showformat='${db:Status-Status} ${Package}\n' 2>/dev/null |
        sed -n 's/^installed //p' | sort -u)
    for package in $(wanted_packages "$@" | tr ' ' '\n' | sort -u); do
        grep -qxF "$package" <<<"$have" || echo "$package"
    done
}

install_packages() {
    local missing as_root=()
    if ! command -v dpkg-query >/dev/null; then
        echo "This is not a Debian: no package can be installed here. Weir needs what these Debian 12 packages hold:" >&2
        echo "   " $(wanted_packages "$@" | tr ' ' '\n' | sort -u) >&2
        return 0
    fi
    missing=$(missing_packages "$@" | tr '\n' ' ')
    missing=${missing% }
    [[ -n $missing ]] || return 0
    if [[ $(id -u) -ne 0 ]]; then
        if ! command -v sudo >/dev/null || ! sudo -n true 2>/dev/null; then
            stop "Weir needs Debian packages that are not installed, and you may not install packages here." \
                "Ask someone who may to run this, then try again:" \
                "    sudo apt-get update && sudo apt-get install --no-install-recommends $missing"
        fi
        as_root=(sudo)
    fi
    echo "Weir installs these Debian packages: $missing"
    as_root+=(env DEBIAN_FRONTEND=noninteractive)
    "${as_root[@]}" apt-get update -qq ||
        stop "The package lists could not be fetched (apt-get update, above). Is the network there?"
    # shellcheck disable=SC2086 # one word per package
    "${as_root[@]}" apt-get install -y -qq --no-install-recommends -o Dpkg::Use-Pty=0 $missing >/dev/null ||
        stop "apt-get could not install all of: $missing" \
            "Its message is above. Weir is made for Debian 12 (bookworm) with its security updates."
    hash -r
}

# Headers and library of one version, unpacked to deps/wgpu; -DWEIR_WGPU_DIR=... names a copy you already have.
install_wgpu() {
    local stamp=deps/wgpu/.wheel-hashes files
    if [[ -e deps/wgpu/lib/libwgpu_native-release.so ]] && cmp -s tools/wgpu-requirements.txt "$stamp"; then
        return 0
    fi
    echo "Weir fetches wgpu-native ($(grep -o '^wgpu==[0-9.]*' tools/wgpu-requirements.txt), a Python wheel) into deps/wgpu"
    rm -rf deps/wgpu.new
    mkdir -p deps/wgpu.new/wheel deps/wgpu.new/include/webgpu deps/wgpu.new/lib
    PIP_DISABLE_PIP_VERSION_CHECK=1 /usr/bin/python3 -m pip download --quiet --no-deps --only-binary=:all: \
        --require-hashes --requirement tools/wgpu-requirements.txt --dest deps/wgpu.new/wheel ||
        stop "The wgpu wheel could not be fetched or has the wrong hash (message above)." \
            "With a copy of your own: cmake --preset native -DWEIR_WGPU_DIR=FOLDER (include/webgpu/*.h and" \
            "lib/libwgpu_native-release.so), or -DWEIR_GPU=OFF for the CPU alone."
    (
        cd deps/wgpu.new
        /usr/bin/python3 -m zipfile -e wheel/wgpu-*.whl unpacked
        cp unpacked/wgpu/resources/webgpu.h unpacked/wgpu/resources/wgpu.h include/webgpu/
        cp unpacked/wgpu/resources/libwgpu_native-release.so lib/
        cp unpacked/wgpu-*.dist-info/licenses/LICENSE LICENSE
        rm -rf wheel unpacked
    )
    cp tools/wgpu-requirements.txt deps/wgpu.new/.wheel-hashes
    rm -rf deps/wgpu
    mv deps/wgpu.new deps/wgpu
}

install_npm() {
    [[ -e web/package-lock.json ]] || return 0
    node_is_ready || stop "Weir needs Node $node_minimum or newer with npm; here: node $(node --version 2>/dev/null || echo missing)," \
        "npm $(npm --version 2>/dev/null || echo missing). Remove the old one, or put a newer one first in PATH."
    if cmp -s web/package-lock.json web/node_modules/.weir-lock; then return 0; fi
    echo "Weir installs the page's npm packages into web/node_modules (versions and hashes in web/package-lock.json)"
    (cd web && npm ci --no-audit --no-fund --loglevel=error) ||
        stop "npm ci failed in web/ (message above)."
    cp web/package-lock.json web/node_modules/.weir-lock
}

[[ $# -gt 0 ]] || set -- native web check
install_packages "$@"
for scope in "$@"; do
    case $scope in
    native) install_wgpu ;;
    web) install_npm ;;
    esac
done
