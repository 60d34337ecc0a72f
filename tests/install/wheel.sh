#!/usr/bin/env bash
# The wheel on a bare Debian 12 without a compiler: it installs, computes a scene by hand, and its tests pass.
# wheel.sh WHEEL [ROOT]     ROOT: a Debian that is there, else debootstrap makes one; needs root
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
wheel=$(realpath "$1")
work="$(mktemp -d)"
bare="${2:-$work/root}"
trap 'umount -q "$bare/proc" || true; rm -rf "$work"' EXIT

[[ -d "$bare/usr" ]] || debootstrap --variant=minbase bookworm "$bare" >"$work/said" 2>&1 || { tail "$work/said" >&2; exit 1; }
mkdir -p "$bare/tmp/wheel/tests/python"
cp "$wheel" "$bare/tmp/wheel/"
cp "$here/../python/test_signorini.py" "$bare/tmp/wheel/tests/python/"
cp -r "$here/../../models" "$here/../../docs" "$bare/tmp/wheel/"
mountpoint -q "$bare/proc" || mount -t proc proc "$bare/proc"
inside() { chroot "$bare" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
inside apt-get install -y -q --no-install-recommends python3 python3-numpy python3-pip >"$work/said" 2>&1 || { tail -20 "$work/said" >&2; exit 1; }
inside sh -c '! command -v c++ g++ cc gcc cmake' || { echo "wheel.sh: there is a compiler" >&2; exit 1; }
inside sh -c 'python3 -m pip install -q --break-system-packages --no-index --no-deps /tmp/wheel/*.whl && cd /tmp/wheel && python3 -B tests/python/test_signorini.py'
