#!/usr/bin/env bash
# Matrices that CalculiX has stored (*FREQUENCY, SOLVER=MATRIXSTORAGE), as Signorini reads them.
#   ccx JOB && take.sh JOB     JOB.sti, JOB.mas, JOB.dof -> JOB.K.mtx, JOB.M.mtx; the line `dofs = ...` on stdout
# CalculiX writes the upper triangle, "row column value"; Matrix Market wants the lower one, and how many entries there are.
# Degree of freedom "25.2" is displacement y of node 25: n25y.
set -euo pipefail
job=$1
n=$(wc -l <"$job.dof")
for pair in sti:K mas:M; do
  from=$job.${pair%:*}
  {
    echo "%%MatrixMarket matrix coordinate real symmetric"
    echo "$n $n $(awk '$3 != 0 { ++count } END { print count }' "$from")"
    awk '$3 != 0 { print $2, $1, $3 }' "$from"
  } >"$job.${pair#*:}.mtx"
done
awk -F. '{ names = names (NR > 1 ? ", " : "") "\"n" $1 substr("xyz", $2, 1) "\"" } END { print "dofs = [" names "]" }' "$job.dof"
