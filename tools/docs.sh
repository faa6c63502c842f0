#!/usr/bin/env bash
# Writes the generated documents from the parameter list.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build/weir params --markdown >docs/parameters.md
build/weir params --keys >docs/scene_keys.md
build/weir params --schema >docs/scene.schema.json
echo "docs/parameters.md, docs/scene_keys.md and docs/scene.schema.json are written"
