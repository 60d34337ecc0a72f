#!/usr/bin/env bash
# What is too long to run at every change. deep.sh [tests] [sanitize] [alone] [clang] [tidy] [threads] [kill] [names] [fuzz] [schema] [page] [python] [wheel] [calculix] [install] [cluster] [pairs];
# without arguments all of them.
#   tests    the suites deep/...: longer studies of claims that .ci/run tests with less, and a test that waits for a minute
#   sanitize all tests but slow and deep ones under ASan and UBSan, their own code and what .ci/run leaves out of it included
#   alone    compiles every file of src, include, tests and validation by itself
#   clang    builds everything with clang, warnings are errors, and runs the fast tests
#   tidy     clang-tidy over all sources (.clang-tidy)
#   threads  simulations side by side under ThreadSanitizer
#   kill     runs that are killed a hundred times, and what they leave
#   names    contacts and titles that try to be shell, gnuplot, formats, paths or markup
#   fuzz     the fuzzers, a quarter of an hour each (FUZZ_SECONDS)
#   schema   scenes against the schema, by Debian's jsonschema
#   page     the pages of `report` in a headless Chromium; screenshots in build/page, to be looked at
#   python   the Python package by pip, its tests and its tutorial
#   wheel    the wheel on a bare Debian 12 without a compiler (needs root)
#   calculix CalculiX computes the matrices of models/calculix again, and its frequencies are compared with ours
#   install  the Debian package on a bare Debian 12 (needs root)
#   pairs    ten minutes of every pair of features (validation/differential); `PAIRS_MINUTES=60` for all of it
#   cluster  sweeps under GNU parallel, mpirun, and an array of a Slurm of one node that is started for it (needs root)
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root"
source scripts/configure.sh
exec </dev/null

deep_tests() {
  configure ci
  cmake --build build/ci -j "$(nproc)"
  ctest --test-dir build/ci --output-on-failure --no-tests=error -L '^deep' -j 2
}

sanitize() {
  configure sanitize-all
  cmake --build build/sanitize-all -j "$(nproc)"
  ctest --test-dir build/sanitize-all --output-on-failure --no-tests=error -LE '^(slow|deep)' -j 2
}

alone() {
  scripts/setup.sh clang-16
  scripts/alone.sh --sources
}

build_with_clang() {
  scripts/setup.sh clang-16 libomp-16-dev
  configure clang
  cmake --build build/clang -j "$(nproc)" -t all signorini_differential signorini_overhead signorini_exact_cost \
    signorini_newmark_errors signorini_reduction signorini_hard_cases
  ctest --test-dir build/clang --output-on-failure --no-tests=error -LE '^(slow|deep)' -j 2
}

tidy() {
  scripts/setup.sh clang-16 libomp-16-dev clang-tidy-16
  configure clang
  cmake --build build/clang -j "$(nproc)" -t signorini_program  # precompiled headers
  run-clang-tidy-16 -quiet -p build/clang -j "$(nproc)" "$root/src/.*"
}

threads() {
  configure tsan
  cmake --build build/tsan -j "$(nproc)" -t signorini_thread_tests
  build/tsan/tests/signorini_thread_tests
}

attack() {
  scripts/setup.sh python3  # names.sh
  build_program signorini_program
  "validation/robustness/$1.sh" build/release/signorini
}

fuzz() {
  scripts/setup.sh clang-16 libomp-16-dev libclang-rt-16-dev
  validation/robustness/fuzz.sh "${FUZZ_SECONDS:-900}"
}

build_program() {
  configure release
  cmake --build build/release -j "$(nproc)" -t "$@"
}

scene_schema() {
  scripts/setup.sh python3 python3-jsonschema
  build_program signorini_program
  /usr/bin/python3 tests/install/schema.py build/release/signorini
}

page() {
  scripts/setup.sh python3 chromium chromium-driver fonts-dejavu-core
  build_program signorini_program
  /usr/bin/python3 -B tests/page/page.py build/release/signorini models build/page
}

python_package() {
  scripts/setup.sh pybind11-dev python3-dev python3-numpy python3-pandas python3-setuptools python3-wheel python3-pip
  command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_SLOPPINESS=pch_defines,time_macros
  rm -rf build/pip
  /usr/bin/python3 -m pip install -q --no-build-isolation --no-deps --target build/pip .
  PYTHONPATH=build/pip /usr/bin/python3 -B tests/python/test_signorini.py
}

wheel() {
  scripts/setup.sh debootstrap
  rm -rf build/wheel
  scripts/wheel.sh build/wheel
  tests/install/wheel.sh build/wheel/signorini-*.whl
}

calculix() {
  scripts/setup.sh calculix-ccx python3
  build_program signorini_program
  tests/install/calculix.sh build/release/signorini
}

installed() {
  scripts/setup.sh debootstrap dpkg-dev file
  build_program all
  tests/install/package.sh build/release
}

cluster() {
  scripts/setup.sh parallel openmpi-bin slurmctld slurmd slurm-client munge
  build_program signorini_program
  tests/install/cluster.sh build/release/signorini
}

pairs() {
  build_program signorini_differential
  build/release/signorini_differential --pairs --minutes "${PAIRS_MINUTES:-10}" --shrink --keep build/pairs
}

scripts/setup.sh
[[ $# -gt 0 ]] || set -- tests sanitize alone clang tidy threads kill names fuzz schema page python wheel calculix install cluster pairs
for what in "$@"; do
  printf '\n== %s (%d s)\n' "$what" "$SECONDS"
  case "$what" in
    tests) deep_tests ;;
    sanitize) sanitize ;;
    alone) alone ;;
    clang) build_with_clang ;;
    tidy) tidy ;;
    threads) threads ;;
    kill | names) attack "$what" ;;
    fuzz) fuzz ;;
    schema) scene_schema ;;
    page) page ;;
    python) python_package ;;
    wheel) wheel ;;
    calculix) calculix ;;
    install) installed ;;
    cluster) cluster ;;
    pairs) pairs ;;
    *) echo "deep.sh: no part is called '$what': tests, sanitize, alone, clang, tidy, threads, kill, names, fuzz, schema, page, python, wheel, calculix, install, cluster, pairs" >&2; exit 2 ;;
  esac
done
printf '\n== done (%d s)\n' "$SECONDS"
