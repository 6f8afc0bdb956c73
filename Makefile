# Tahr's front door. It sets the machine up and drives CMake; CMakeLists.txt is the one real build.
BUILD ?= build
JOBS ?= $(shell nproc 2>/dev/null || echo 2)
PREFIX ?= /usr/local

# make run
LEVEL ?=
BACKEND ?=
UP ?=
ARGS ?=

# For those who know: warnings are errors; more arguments for CMake.
WERROR ?=
CMAKE_ARGS ?=

.PHONY: build setup setup-run run run-2d test test-full asan fuzz bench chart peers stability install clean format help

# Ninja if it is there and the folder is not configured yet; a configured folder keeps its generator.
# Of its talk only what is left out and why is shown, unless it fails.
configure = mkdir -p $(1) && { cmake -S . -B $(1) $(2) $(box2d_3) -DTAHR_WERROR=$(if $(WERROR),ON,OFF) $(CMAKE_ARGS) \
	$$(if [ ! -f $(1)/CMakeCache.txt ] && command -v ninja >/dev/null; then echo -G Ninja; fi) \
	>$(1)/configure.log 2>&1 || { cat $(1)/configure.log; exit 1; }; } && \
	{ grep -E 'Warning|^-- TAHR_[A-Z_]*: no' $(1)/configure.log || true; }
# Box2D 3 is no Debian package: its sources come from a Rust crate, fetched by setup where there is cargo.
BOX2D3 = $(BUILD)/box2d3/source
box2d_3 = $$(if [ -d $(BOX2D3)/src ]; then echo "-DTAHR_BOX2D3_DIR=$(abspath $(BOX2D3))"; fi)
compile = cmake --build $(1) --parallel $(JOBS)
# ctest's own output first, then the table of parity by rows (tests/parity_count.sh), then why something was left out:
# every skipped test says so in a line "SKIP: name: why".
check = cd $(1) && (ctest --output-on-failure --no-label-summary -j $(JOBS) $(2); status=$$?; \
	grep -h '^parity: ' Testing/Temporary/LastTest.log | tail -n 1; \
	grep -h '^SKIP: ' Testing/Temporary/LastTest.log | sort -u; exit $$status)

build: setup-run
	@$(call configure,$(BUILD),)
	@$(call compile,$(BUILD)) --target tahr_product

setup:
	@sh .ci/setup test
	@sh .ci/fetch_box2d3 $(BUILD)/box2d3

setup-run:
	@sh .ci/setup run

run_options = $(if $(LEVEL),--level "$(LEVEL)") $(if $(UP),--up $(UP)) $(if $(BACKEND),--backend $(BACKEND)) \
	--csv $(BUILD)/run.csv --plot $(BUILD)/run.svg $(ARGS)
run: build
	$(strip $(BUILD)/bin/tahr run $(run_options))

# From the side: the tour through the bundled level, unless a level, a route or wanderers are asked for.
tour = $(if $(LEVEL)$(findstring --characters,$(ARGS))$(findstring --route,$(ARGS)),,--tour)
run_2d_options = --2d $(tour) $(if $(LEVEL),--level "$(LEVEL)") $(if $(BACKEND),--backend $(BACKEND)) \
	--csv $(BUILD)/run-2d.csv --plot $(BUILD)/run-2d.svg $(ARGS)
run-2d: build
	$(strip $(BUILD)/bin/tahr run $(run_2d_options))

test: setup
	@$(call configure,$(BUILD),-DTAHR_TESTS=ON)
	@$(call compile,$(BUILD))
	@$(call check,$(BUILD),-LE full)

test-full: setup
	@$(call configure,$(BUILD),-DTAHR_TESTS=ON)
	@$(call compile,$(BUILD))
	@$(call check,$(BUILD),)

# Tests labelled "toolchain" compile the sources again by themselves, so there is nothing in them for a sanitizer to
# see.
asan: setup
	@$(call configure,$(BUILD)/asan,-DTAHR_TESTS=ON -DTAHR_SANITIZE=ON)
	@$(call compile,$(BUILD)/asan)
	@$(call check,$(BUILD)/asan,-LE toolchain)

# TIME seconds for each fuzzer; what they find is kept in $(BUILD)/fuzz/found.
TIME ?= 60
fuzz:
	@sh .ci/setup fuzz
	@sh .ci/fetch_box2d3 $(BUILD)/box2d3
	@command -v clang >/dev/null || { echo "fuzz: clang is not installed"; exit 1; }
	@$(call configure,$(BUILD)/fuzz,-DTAHR_FUZZ=ON -DTAHR_TESTS=OFF -DTAHR_SHARED=OFF -DCMAKE_C_COMPILER=clang \
		-DCMAKE_CXX_COMPILER=clang++)
	@$(call compile,$(BUILD)/fuzz) --target fuzzers
	@sh fuzz/run.sh $(BUILD)/fuzz $(TIME)

bench: setup-run
	@if ! ls tests/bench/*.c >/dev/null 2>&1; then echo "bench: tests/bench has no sources"; exit 1; fi
	@$(call configure,$(BUILD),)
	@$(call compile,$(BUILD)) --target tahr_bench
	$(BUILD)/bin/tahr_bench --csv $(BUILD)/bench.csv $(ARGS)

# Of peers, chart and stability: 1 for less of it in a minute or two.
QUICK ?=

# Tahr beside the controllers of other engines; what cannot be built here is left out and says why.
peers: setup
	@JOBS=$(JOBS) sh tests/bench/peers/build.sh $(BUILD)/peers $(box2d_3) $(CMAKE_ARGS)
	$(BUILD)/peers/tahr_peers --peers $(BUILD)/peers/lib --csv $(BUILD)/peers.csv $(if $(QUICK),--quick) $(ARGS)

# Python's libraries go into $(BUILD)/venv.
PYTHON ?= python3
chart_python = $(BUILD)/venv/bin/python
$(BUILD)/venv/made: tests/bench/chart/requirements.txt
	@$(PYTHON) -m venv $(BUILD)/venv || { \
		echo "chart: '$(PYTHON) -m venv' failed; expected Python 3 with venv (Debian: python3-venv), or PYTHON=another"; exit 1; }
	@$(chart_python) -m pip install --quiet --disable-pip-version-check -r $< || { \
		echo "chart: pip could not install what $< lists into $(BUILD)/venv"; exit 1; }
	@touch $@

chart:
	@sh .ci/setup chart
	@sh .ci/fetch_box2d3 $(BUILD)/box2d3
	@$(MAKE) --no-print-directory $(BUILD)/venv/made
	@$(call configure,$(BUILD),)
	@$(call compile,$(BUILD)) --target tahr_chart
	@mkdir -p $(BUILD)/chart
	$(BUILD)/bin/tahr_chart --budget $(if $(QUICK),quick,full) --out $(BUILD)/chart $(ARGS)
	@$(chart_python) -B tests/bench/chart/draw.py --in $(BUILD)/chart --out $(BUILD)/chart --peers $(BUILD)/peers.csv \
		--command "make chart$(if $(QUICK), QUICK=1)"

# Every hard case on every backend; QUICK=1: 30 variations of each, else 1000.
stability: setup-run
	@$(call configure,$(BUILD),)
	@$(call compile,$(BUILD)) --target tahr_stability
	$(BUILD)/bin/tahr_stability $(if $(QUICK),--quick) --csv $(BUILD)/stability.csv --svg $(BUILD)/stability.svg $(ARGS)

install: build
	cmake --install $(BUILD) --prefix "$(abspath $(PREFIX))"

clean:
	cmake -E rm -rf $(BUILD)

format:
	@command -v clang-format >/dev/null || { echo "format: clang-format is not installed"; exit 1; }
	clang-format -i $$(find include src backends bindings tests fuzz -name '*.[ch]' -o -name '*.[ch]pp' 2>/dev/null)

help:
	@echo "make              build the library and the shell into $(BUILD)/"
	@echo "make run          walk the bundled playground; leaves $(BUILD)/run.svg and $(BUILD)/run.csv"
	@echo "                  LEVEL=file  UP=y|z  BACKEND=native|ccd|fcl|a plugin's path  ARGS='more options'"
	@echo "make run-2d       a tour through the bundled side-scroller; leaves $(BUILD)/run-2d.svg and $(BUILD)/run-2d.csv"
	@echo "                  LEVEL=file.tmj (of Tiled)  BACKEND=native|ccd|fcl|box2d|box2d-2  ARGS='more options'"
	@echo "make test         all tests but the long ones"
	@echo "make test-full    all tests"
	@echo "make asan         all tests under AddressSanitizer and UBSan, in $(BUILD)/asan"
	@echo "make fuzz         every fuzzer for TIME=60 seconds each (clang), what they find in $(BUILD)/fuzz/found"
	@echo "make bench        the benchmark; ARGS='options'"
	@echo "make peers        Tahr beside other engines' controllers on the same courses; QUICK=1  ARGS='options'"
	@echo "make chart        speed against accuracy: $(BUILD)/chart/index.html; QUICK=1: less of it; with $(BUILD)/peers.csv, if there"
	@echo "make stability    where methods fail: every hard case on every backend; QUICK=1 in less than a minute; leaves"
	@echo "                  $(BUILD)/stability.csv and $(BUILD)/stability.svg; ARGS='--family wedge --backend ccd --seed 7 --trace'"
	@echo "make install      PREFIX=/usr/local"
	@echo "make setup        install what is missing through apt-get (run, test and the others do it too)"
	@echo "make format       clang-format over all sources"
	@echo "make clean        remove $(BUILD)/"
