# A thin front to CMake. `make help` lists what there is.
#
# Compilers are cached if ccache is installed. JOBS is how many compilers or tests run at once.

JOBS ?= $(shell nproc)
BUILD_FLAGS = $(if $(shell command -v ccache),-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
CTEST = ctest --output-on-failure --parallel $(JOBS)
SOURCES = git ls-files '*.cpp' '*.hpp'

.DEFAULT_GOAL = release
.PHONY: help packages release demo test check bench test-arm64 asan tsan fuzz format format-check \
        tidy install clean

help:  ## this list
	@sed -n 's/^\([a-z0-9-]*\):.*## /\1\t/p' $(MAKEFILE_LIST) | expand -t 14

packages:
	@cmake/install_packages.sh cmake/packages.txt

release: packages  ## (the default) the release program: build/release/perentie
	@cmake --preset release $(BUILD_FLAGS) -DPERENTIE_BUILD_TESTS=OFF > build-release.log 2>&1 \
	  || { cat build-release.log; rm build-release.log; exit 1; }
	@rm build-release.log
	cmake --build --preset release --target perentie --parallel $(JOBS)

demo: release  ## build, and monitor two traces of a rover
	@sh corpus/rover/demo.sh build/release/perentie

test: packages  ## build and pass all tests
	cmake --preset dev $(BUILD_FLAGS)
	cmake --build --preset dev --parallel $(JOBS)
	@cmake/run_tests.sh build/dev $(JOBS)

bench: packages  ## build and run the benchmarks (slow; figures: docs/performance.md)
	cmake --preset release $(BUILD_FLAGS) -B build/bench -DPERENTIE_BUILD_TESTS=OFF \
	  -DPERENTIE_BUILD_BENCHMARKS=ON
	cmake --build build/bench --parallel $(JOBS)
	@set -e; for bench in build/bench/tests/bench/*_bench; do \
	  echo "== $$(basename $$bench)"; $$bench $(BENCH_FLAGS); done

test-arm64: packages  ## cross-build for 64-bit ARM and pass the tests under qemu-user
	@cmake/install_packages.sh cmake/packages_arm64.txt --foreign arm64
	@cmake/build_rapidcheck_arm64.sh build/rapidcheck-arm64
	cmake --preset release -B build/arm64 $(BUILD_FLAGS) \
	  -DCMAKE_TOOLCHAIN_FILE=cmake/aarch64-linux-gnu.cmake \
	  -DCMAKE_PREFIX_PATH=$(CURDIR)/build/rapidcheck-arm64
	cmake --build build/arm64 --parallel $(JOBS)
	@cmake/run_tests.sh build/arm64 $(JOBS)

asan: packages  ## the tests under AddressSanitizer and UndefinedBehaviorSanitizer
	cmake --preset asan $(BUILD_FLAGS)
	cmake --build --preset asan --parallel $(JOBS)
	@cmake/run_tests.sh build/asan $(JOBS)

tsan: packages  ## the tests under ThreadSanitizer
	cmake --preset tsan $(BUILD_FLAGS)
	cmake --build --preset tsan --parallel $(JOBS)
	@cmake/run_tests.sh build/tsan $(JOBS)

format:  ## format all sources (clang-format 14)
	$(SOURCES) | xargs clang-format -i

format-check:  ## fail if a source is not formatted
	$(SOURCES) | xargs clang-format --dry-run --Werror

tidy: packages  ## clang-tidy on all sources (slow)
	cmake --preset dev $(BUILD_FLAGS)
	run-clang-tidy -quiet -p build/dev -j $(JOBS)

install: release  ## install the program (PREFIX=/usr/local)
	cmake --install build/release $(if $(PREFIX),--prefix $(PREFIX))

clean:  ## remove everything built
	rm -rf build
