#!/usr/bin/env bash
# Words that names, comments and messages of src and include do not use (CONTRIBUTING.md, "Names"), and comments that begin
# without a subject. words.sh [--count]
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

files() { find src include \( -name '*.hpp' -o -name '*.cpp' \) -print0 | sort -z; }
# Comments alone: what follows // outside of strings.
comments() { files | xargs -0 grep -nHoE '(^|[^:"])//[/<!]* ?.*$' | sed -E 's|^([^:]*:[0-9]+):[^/]*//[/<!]* ?|\1: |'; }

words='told|untold|felt|fell|meddl[a-z]*|dear|plain sight|of one'\''s own|goes? on from|for ever'
names='[A-Za-z0-9]*_(told|said|felt|fell|meddle)|(told|said|felt|fell|meddle)_[A-Za-z0-9_]*|said|[Mm]eddler'
status=0
refuse() {  # lines of stdin, why
  local found
  found=$(cat)
  [[ -z "$found" ]] && return
  echo "$found" | sed "s/^/words.sh: $1: /" >&2
  status=1
}

refuse "refused word" < <(files | xargs -0 grep -nHiwE "$words" || true)
refuse "refused name" < <(files | xargs -0 grep -nHwE "$names" || true)
refuse "refused name" < <(files | xargs -0 grep -nHoE '\b[A-Za-z]*(Told|Felt|Meddl)[A-Za-z]*\b' || true)
refuse "a comment begins with \"Of \" or \"What \"" < <(comments | grep -E '^[^ ]*: (Of|What) ' || true)

if [[ "${1:-}" == --count ]]; then
  for word in Of As What; do echo "$word: $(comments | grep -cE "^[^ ]*: $word " || true) comments"; done
fi
exit $status
