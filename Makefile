# The short commands of this project; CMake does the work. `make help` lists them.
#
# `make demo` and `make test` install the Debian packages that are missing (with sudo unless you are
# root); all else leaves your machine alone. Everything that is made is made in build/.

jobs := $(shell nproc)
perentie := build/release/perentie
sources = $(shell git ls-files '*.cpp' '*.hpp')

# Compile through ccache if there is one, unless a launcher is already chosen.
ccache := $(shell command -v ccache)
ifneq ($(ccache),)
export CMAKE_CXX_COMPILER_LAUNCHER ?= $(ccache)
endif

build = cmake --preset $(1) $(3) >/dev/null && cmake --build --preset $(1) -j $(jobs) $(2)
packages = cmake/install_packages.sh

.PHONY: perentie
perentie:  ## build the program: build/release/perentie (the default)
	@$(call build,release,--target perentie,-DPERENTIE_BUILD_TESTS=OFF)

.PHONY: demo
demo:  ## monitor two missions of a rover, one right, one wrong
	@$(packages) program
	@$(call build,release,--target perentie,-DPERENTIE_BUILD_TESTS=OFF)
	@corpus/rover/demo.sh $(perentie)

.PHONY: test
test:  ## build and run all tests
	@$(packages) program test
	@$(call build,test)
	@cmake/run_tests.sh build/test $(jobs)

.PHONY: test-arm64
test-arm64:  ## cross-build for aarch64 and run the same tests under qemu
	@$(packages) program test arm64
	@cmake/arm64_sysroot.sh build/arm64-sysroot
	@$(call build,arm64)
	@cmake/run_tests.sh build/arm64 $(jobs) --exclude-regex DeathTest
	@echo "Left out: death tests. They fork, and under qemu-user 7.2 a forked child never ends."

.PHONY: asan tsan
asan tsan:  ## all tests with the address and undefined-behaviour, or the thread sanitizer
	@$(packages) program test
	@$(call build,$@)
	@cmake/run_tests.sh build/$@ $(jobs)

.PHONY: fuzz
fuzz: seconds ?= 60
fuzz:  ## fuzz each reader for a minute, or for seconds=N
	@$(packages) program test fuzz
	@$(call build,fuzz)
	@cmake/run_fuzzers.sh build/fuzz $(seconds)

.PHONY: bench
bench:  ## measure; docs/performance.md has the figures
	@$(packages) program bench
	@$(call build,release,,-DPERENTIE_BUILD_TESTS=OFF -DPERENTIE_BUILD_BENCHMARKS=ON)
	@for program in build/release/tests/bench/*_bench; do echo "# $$program"; $$program || exit 1; done

.PHONY: bench-peers
bench-peers:  ## measure exploration beside SPIN on the same models
	@$(packages) program peers
	@$(call build,release,--target perentie,-DPERENTIE_BUILD_TESTS=OFF)
	@tests/bench/peers/run.sh build/release

.PHONY: format format-check tidy
format:  ## format all sources in place
	@clang-format -i $(sources)
format-check:  ## fail if a source is not formatted
	@clang-format --dry-run -Werror $(sources)
tidy:  ## clang-tidy over all sources
	@$(packages) style
	@cmake --preset test >/dev/null
	@run-clang-tidy -quiet -p build/test -j $(jobs) "$(CURDIR)/(base|parser|semantics|lts|monitor|cli)/.*"

.PHONY: install
install: perentie  ## install program, manual and examples; DESTDIR and PREFIX are honoured
	@DESTDIR="$(DESTDIR)" cmake --install build/release $(if $(PREFIX),--prefix "$(PREFIX)")

.PHONY: clean
clean:  ## remove build/
	@rm -rf build

.PHONY: help
help:  ## this list
	@sed -n 's/^\([a-z][a-z0-9 -]*\):[^#]*## \(.*\)/\1|\2/p' Makefile | \
	  awk -F'|' '{ printf "  make %-14s %s\n", $$1, $$2 }'
