#!/usr/bin/env bash
# A wheel that needs no compiler: wheel.sh [DIR]. The library is inside, and beside it the shared libraries of Debian that it is
# linked with; what is left to the system is the C and C++ library. For the Python of this machine (Debian 12: 3.11, x86_64).
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
out=$(realpath -m "${1:-$root/build/wheel}")
"$root/scripts/setup.sh" pybind11-dev python3-dev python3-numpy python3-setuptools python3-wheel python3-pip patchelf
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

command -v ccache >/dev/null && export CMAKE_CXX_COMPILER_LAUNCHER=ccache CCACHE_SLOPPINESS=pch_defines,time_macros
/usr/bin/python3 -m pip wheel -q --no-build-isolation --no-deps -w "$work" "$root"
/usr/bin/python3 -m wheel unpack -d "$work/open" "$work"/signorini-*.whl >/dev/null
tree=("$work"/open/signorini-*)
module=("$tree"/signorini/_signorini*.so)
libraries="$tree/signorini/libraries"
mkdir "$libraries"
# Of every machine with Debian 12 and python3.
system='^(linux-vdso|ld-linux-x86-64|libc|libm|libdl|libpthread|librt|libgcc_s|libstdc\+\+)\.so'
while read -r name _ path _; do
  [[ "$path" == /* && ! "$name" =~ $system ]] && cp -L "$path" "$libraries/$name"
done < <(ldd "$module")
patchelf --set-rpath '$ORIGIN/libraries' "$module"
for library in "$libraries"/*; do patchelf --set-rpath '$ORIGIN' "$library"; done
mkdir -p "$out"
/usr/bin/python3 -m wheel pack -d "$out" "$tree" >/dev/null
ls "$out"/signorini-*.whl
