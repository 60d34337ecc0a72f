#!/usr/bin/env bash
# The Debian packages on a bare Debian 12: the program's installs, with what it needs, and computes a scene.
# package.sh BUILD_FOLDER [ROOT]     ROOT: a Debian that is there, else debootstrap makes one; needs root
set -euo pipefail
build="$(realpath "$1")"
work="$(mktemp -d)"
bare="${2:-$work/root}"
trap 'umount -q "$bare/proc" || true; rm -rf "$work"' EXIT

(cd "$build" && rm -rf packages && cpack >"$work/said" 2>&1) || { cat "$work/said" >&2; exit 1; }
[[ -d "$bare/usr" ]] || debootstrap --variant=minbase bookworm "$bare" >"$work/said" 2>&1 || { tail "$work/said" >&2; exit 1; }
cp "$build"/packages/signorini_*.deb "$bare/tmp/signorini.deb"
mountpoint -q "$bare/proc" || mount -t proc proc "$bare/proc"
inside() { chroot "$bare" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@"; }
inside apt-get install -y -q --no-install-recommends /tmp/signorini.deb >"$work/said" 2>&1 || { tail -20 "$work/said" >&2; exit 1; }
inside sh -c 'cd /tmp && rm -rf own* && signorini --version && signorini new own --from pipe 2>/dev/null &&
  signorini check own.toml | tail -3 && signorini run own.toml --quiet --no-plots && wc -l own-run/events.csv'
[[ -e "$bare/usr/share/man/man1/signorini-run.1" || -e "$bare/usr/share/man/man1/signorini-run.1.gz" ]] ||
  echo "package.sh: no man pages (a bare Debian leaves them out)" >&2
