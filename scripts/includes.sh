#!/usr/bin/env bash
# Which folder of src/ includes which; fails where two include each other, directly or round about: rooms within
# folders, and the folders themselves; and where two headers define types of one name in one namespace.
# includes.sh [--list]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../src"

arrows() {
  grep -rHoE '^#include "[^"]+/[^"/]+"' --include='*.[ch]pp' . | sed -E 's|^\./||; s|/[^/:]+:#include "| |; s|/[^/]+"$||' |
    awk '$1 != $2 && $2 !~ /^signorini/' | sort -u
}

[[ "${1:-}" == --list ]] && arrows
houses() { arrows | sed -E 's|/[^ ]*||g' | awk '$1 != $2' | sort -u; }
for graph in arrows houses; do
  if ! cycles=$($graph | tsort 2>&1 >/dev/null) || [[ -n "$cycles" ]]; then
    echo "includes.sh: folders that include each other:" >&2
    echo "$cycles" | sed -E 's/^tsort: //; /input contains a loop|^-$/d' >&2
    exit 1
  fi
done

# Two types of one name in one namespace are one to the linker, which takes either's functions and says nothing.
twice=$(find . ../include -name '*.hpp' -print0 | xargs -0 awk '
  /^namespace [a-z_:]+ \{/ { space = $2 }
  /^(struct|class) [A-Za-z]+( final)?( :.*)? \{/ { print space "::" $2 }' | sort | uniq -d)
if [[ -n "$twice" ]]; then
  echo "includes.sh: headers that define types of one name: $twice" >&2
  exit 1
fi
