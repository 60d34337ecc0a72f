#!/usr/bin/env bash
# The program of the README, compiled against the installed library without a word on its standard, and run: by CMake, and
# after the tree was moved by pkg-config. The installed program, its pages and its models.
# readme.sh BUILD_FOLDER
set -euo pipefail
root="$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)"
work="$(mktemp -d)"
trap 'rm -rf "$work"' EXIT

cmake --install "$1" --prefix "$work/prefix" >/dev/null
awk '/^```cpp$/ { inside = 1; next } /^```$/ { inside = 0 } inside' "$root/README.md" >"$work/main.cpp"
grep -q simulate.hpp "$work/main.cpp"
cat >"$work/CMakeLists.txt" <<'END'
cmake_minimum_required(VERSION 3.25)
project(own CXX)
find_package(signorini REQUIRED)
add_executable(own main.cpp)
target_link_libraries(own PRIVATE signorini::signorini)
foreach(example observe in_code go_on steer own_history own_law law_class disc_law)
  add_executable(${example} ${EXAMPLES}/${example}.cpp)
  target_link_libraries(${example} PRIVATE signorini::signorini)
endforeach()
END
cmake -S "$work" -B "$work/build" -DCMAKE_PREFIX_PATH="$work/prefix" -DEXAMPLES="$root/examples" >/dev/null
cmake --build "$work/build" >/dev/null
events="$(cd "$root" && "$work/build/own" | wc -l)"
echo "$events events"
((events > 200))
for example in observe in_code go_on steer own_history own_law law_class disc_law; do (cd "$root" && "$work/build/$example" >/dev/null); done

mv "$work/prefix" "$work/moved"
pc="$(dirname "$(find "$work/moved" -name signorini.pc)")"
export PKG_CONFIG_PATH="$pc"
# shellcheck disable=SC2046  # flags are words
"${CXX:-c++}" "$work/main.cpp" -o "$work/by-pkg-config" $(pkg-config --cflags --libs signorini)
((events == $(cd "$root" && "$work/by-pkg-config" | wc -l)))

"$work/moved/bin/signorini" run "$work/moved/share/signorini/models/belt.toml" -o "$work/belt" --quiet --no-plots
[[ -s "$work/belt/events.csv" ]]
for page in signorini signorini-run signorini-sweep; do [[ -s "$work/moved/share/man/man1/$page.1" ]]; done
bash -c "source '$work/moved/share/bash-completion/completions/signorini'; complete -p signorini" >/dev/null
[[ -s "$work/moved/share/zsh/vendor-completions/_signorini" && -s "$work/moved/share/signorini/schema.json" ]]
[[ -s "$work/moved/share/doc/signorini/docs/theory.md" ]]
