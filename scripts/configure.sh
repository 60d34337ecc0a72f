# Sourced, not run: configure PRESET. Uses ccache where there is one.

configure() {
  local options=()
  if command -v ccache >/dev/null; then
    options+=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
    export CCACHE_SLOPPINESS=pch_defines,time_macros  # without it, files with a precompiled header are not kept
  fi
  (cd "$root" && cmake --preset "$1" "${options[@]}")
}
