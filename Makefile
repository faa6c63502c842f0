# The front door: every target first installs what it needs and is missing (tools/setup.sh), then hands over to
# CMake, Ninja and npm.
.DEFAULT_GOAL := all
.PHONY: all run check bench validate stress docs format format-check clean setup help native page
MAKEFLAGS += --no-print-directory
PORT ?= 8080
RESOLUTION ?= normal
SCENES ?= 100
SEED ?= 1
BACKEND ?= auto

all: ## build the command line program, build/weir
	@tools/setup.sh native
	@tools/build.sh native

run: ## build everything, serve the page on http://127.0.0.1:8080 (PORT=...) and open a browser
	@tools/setup.sh native web
	@tools/build.sh native page
	@tools/serve.sh $(PORT)

check: ## run every test: both compilers, sanitizers, wasm, Node, Chromium and Firefox
	@tools/setup.sh native web check
	@tools/check.sh

bench: ## measure speed: C, GPU, wasm and plain JavaScript; tables go to build/bench (SUITE=quick|step|calm|scaling|nasty|default, COMPARE=FILE)
	@tools/setup.sh native web
	@tools/build.sh native page
	@bench/run.sh

validate: ## run the published cases, compare with their references, write build/validation/report.html (RESOLUTION=coarse|normal|fine, DOCS=1)
	@tools/setup.sh native report
	@tools/build.sh native
	@tools/validate.sh $(RESOLUTION)

stress: ## run random scenes of wcsph and tell which blow up (SCENES=100, SEED=1, BACKEND=auto|cpu|gpu, or COMPARE=steps: CPU with GPU); they stay in build/stress
	@tools/setup.sh native
	@tools/build.sh native
	@/usr/bin/python3 -B tools/stress.py --scenes $(SCENES) --seed $(SEED) --backend $(BACKEND) $(if $(COMPARE),--compare $(COMPARE))

docs: ## write docs/parameters.md, scene_keys.md and scene.schema.json anew from the lists in the core
	@tools/setup.sh native
	@tools/build.sh native
	@tools/docs.sh

format: ## format the C sources
	@tools/setup.sh check
	@tools/format.sh

format-check: ## fail if a C source is not formatted
	@tools/setup.sh check
	@tools/format.sh --check

setup: ## install all that any target needs
	@tools/setup.sh native web check

clean: ## remove what was built; packages and deps/ stay
	rm -rf build web/dist web/public/weir.wasm web/public/scenes web/test-results

help: ## this list
	@sed -n 's/^\([a-z-]*\): ## \(.*\)/  make \1\t\2/p' $(MAKEFILE_LIST) | expand -t 24
