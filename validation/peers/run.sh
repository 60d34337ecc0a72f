#!/usr/bin/env bash
# Signorini beside Siconos and SciPy on shared scenes; says what is missing and leaves it out. Prints Markdown.
#
#   validation/peers/run.sh [PROGRAM, build/release/signorini] [repeats, 3] [scene, all]...
#
# The peers are Debian packages: apt-get install python3-siconos python3-scipy
set -euo pipefail

here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
program=${1:-$here/../../build/release/signorini}
repeats=${2:-3}
python=/usr/bin/python3  # Debian's: the packages are not seen by any other

[[ -x $program ]] || { echo "run.sh: no program at $program; build it, or name it" >&2; exit 1; }
program=$(realpath "$program")
"$python" -c 'import numpy' 2>/dev/null || { echo "run.sh: install python3-numpy" >&2; exit 1; }

siconos=- scipy=-
if "$python" -c 'import siconos.kernel' 2>/dev/null; then
  siconos=siconos
else
  echo "run.sh: Siconos is missing (python3-siconos); its rows are left out" >&2
fi
if "$python" -c 'import scipy.integrate' 2>/dev/null; then
  scipy=scipy
else
  echo "run.sh: SciPy is missing (python3-scipy); its rows are left out" >&2
fi

# One thread each: BLAS would use all processors for matrices of this size and be slower for it.
export OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 PYTHONPATH=$here PYTHONDONTWRITEBYTECODE=1
cd "$here"
exec "$python" table.py "$program" "$repeats" "$siconos" "$scipy" "${@:3}"
