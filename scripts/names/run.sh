#!/usr/bin/env bash
# run.sh TREE joins|index|renames|namespaces|both: one step of the chain. See README.md.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$1" && pwd)
step=$2
cd "$root"
mkdir -p build/names
format() {
  git ls-files -m -o --exclude-standard -- '*.hpp' '*.cpp' | while read -r f; do [[ -f $f ]] && echo "$f"; done |
    xargs -r -n 40 clang-format -i
}
case $step in
  joins)
    python3 "$here/joins.py" "$root"
    python3 "$here/paths.py" "$root"
    format
    ;;
  index)
    [[ -x build/names/indexer ]] || "$here/make.sh" "$root"
    rm -rf build/names/idx build/names/*.pch
    python3 "$here/index.py" "$root" 0/2 & p=$!
    python3 "$here/index.py" "$root" 1/2
    wait $p
    ;;
  renames | namespaces | both)
    python3 "$here/apply.py" "$root" "$step"
    [[ $step == renames ]] || python3 "$here/after.py" "$root"
    format
    ;;
esac
