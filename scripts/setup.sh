#!/usr/bin/env bash
# Installs what is missing to build, test and draw (Debian 12), and the packages that are named. Asks nothing; needs
# root or sudo only where something is missing.
set -euo pipefail

packages=(g++ cmake ninja-build pkg-config libsundials-dev libsuitesparse-dev libeigen3-dev libgsl-dev
          doctest-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev libfmt-dev libspectra-dev
          clang-format parallel "$@")

installed() { [[ "$(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null)" == installed ]]; }

missing=()
for package in "${packages[@]}"; do
  installed "$package" || missing+=("$package")
done
# gnuplot's packages exclude each other: leave alone whichever is there.
command -v gnuplot >/dev/null || missing+=(gnuplot-nox)

[[ ${#missing[@]} -eq 0 ]] && exit 0

as_root=()
if [[ $(id -u) -ne 0 ]]; then
  command -v sudo >/dev/null || { echo "setup.sh: as root, install: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo -n)
fi
echo "setup.sh: installing ${missing[*]}" >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get update -q </dev/null >&2
"${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends \
  "${missing[@]}" </dev/null >&2
