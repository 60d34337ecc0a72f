#!/usr/bin/env bash
# make.sh TREE: builds the indexer into TREE/build/names. Needs llvm-16-dev and libclang-16-dev.
set -euo pipefail
mkdir -p "$1/build/names"
g++ -std=c++17 -O1 -fno-rtti -I/usr/lib/llvm-16/include "$(dirname "${BASH_SOURCE[0]}")/indexer.cpp" -o "$1/build/names/indexer" \
  /usr/lib/llvm-16/lib/libclang-cpp.so.16 /usr/lib/llvm-16/lib/libLLVM-16.so
