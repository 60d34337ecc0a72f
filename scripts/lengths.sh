#!/usr/bin/env bash
# Functions of more than 60 lines that CONTRIBUTING.md does not name as numeric kernels. Relies on the format: what opens
# in column 0, or in column 2 within a class, closes there.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# Lines, place and first line of each.
long_functions() {
  find src include -name '*.[ch]pp' -print0 | sort -z | xargs -0 awk '
    FNR == 1 { first[0] = first[2] = raw = 0 }
    raw { if (/\)"/) raw = 0; next }
    /R"\(/ && !/R"\(.*\)"/ { raw = 1; next }
    !/^(  )?[^ #\/]/ {
      for (i = 0; i <= 2; i += 2)
        if (first[i] && !opened[i]) { if (/\{$/) opened[i] = 1; else if (/;$/) first[i] = 0 }
      next
    }
    /^ *(public|private|protected):/ { next }
    { indent = /^ / ? 2 : 0 }
    /^ *}/ {
      length_ = FNR - first[indent] + 1
      if (first[indent] && length_ > 60) printf "%d lines, %s:%d: %s\n", length_, FILENAME, first[indent], head[indent]
      first[indent] = 0
      next
    }
    /{.*}$/ && !first[indent] { next }
    /;$/ && !/{/ { first[indent] = 0; next }
    /\(/ && !first[indent] && !/^ *(namespace|using|struct|class|enum|return|if|for|while|switch|else|do) / {
      first[indent] = FNR
      opened[indent] = /\{$/
      head[indent] = $0
    }'
}

status=0
while IFS= read -r line; do
  name=$(sed -E 's/^[^:]*:[0-9]+: //; s/\(.*//; s/.*[ *&]//; s/.*:://' <<<"$line")
  grep -qF "\`$name\`" CONTRIBUTING.md || { echo "lengths.sh: $line" >&2; status=1; }
done < <(long_functions)
exit $status
