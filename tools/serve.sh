#!/usr/bin/env bash
# Serves the built page to this machine alone and opens it where there is a display.
#   tools/serve.sh PORT
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../web"
port=${1:-8080}
open=()
if [[ -n ${DISPLAY-}${WAYLAND_DISPLAY-} ]] && command -v xdg-open >/dev/null; then
    open=(--open)
fi
if (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; then
    echo "Port $port is in use on this machine. Another one: make run PORT=$((port + 1))" >&2
    exit 1
fi
echo "Weir's page: http://127.0.0.1:$port/ (Ctrl-C ends it)"
exec node_modules/.bin/vite preview --host 127.0.0.1 --port "$port" --strictPort "${open[@]}"
