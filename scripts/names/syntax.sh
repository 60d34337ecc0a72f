#!/bin/bash
# syntax.sh TREE [PATTERN]: syntax of all files as folders, one process: clang, one precompiled header of all headers.
R=$(cd "$1" && pwd)/; O=${R}build/names/syntax; mkdir -p $O; cd $R
F="-std=c++20 -w -ferror-limit=40 -I${R}src -I${R}include -I${R}build/names/generated -isystem /usr/include/eigen3 -isystem /usr/include/suitesparse -DTOML_HEADER_ONLY=0 -DTOML_SHARED_LIB=1 -DEIGEN_MALLOC_ALREADY_ALIGNED=1 -DSIGNORINI_TEST_DATA=\"\" -DSIGNORINI_MODELS=\"\" -DSIGNORINI_CASES=\"\" -DSIGNORINI_PUBLISHED=\"\" -DSIGNORINI_PROGRAM=\"\""
mkdir -p ${R}build/names/generated/base; sed 's/@[A-Z_]*@/0.1.0/' src/base/version.hpp.in > $O/v; cmp -s $O/v ${R}build/names/generated/base/version.hpp || cp $O/v ${R}build/names/generated/base/version.hpp
if [[ -z ${KEEP:-} ]]; then
{ for x in algorithm array cmath filesystem fstream functional map memory optional string vector numeric fmt/core.h fmt/format.h Eigen/Core Eigen/SparseCore Eigen/Dense Eigen/SparseCholesky nlohmann/json.hpp toml++/toml.h CLI/CLI.hpp doctest/doctest.h; do echo "#include <$x>"; done; find include src -name '*.hpp' | sort | sed "s|.*|#include \"$R&\"|"; } > $O/all.hpp
clang++-16 -x c++-header $F -fpch-instantiate-templates $O/all.hpp -o $O/all.pch || exit 1
echo "headers: ok $(date +%T)"
fi
find src tests validation/differential -name '*.cpp' | sed 's|/[^/]*$||' | sort -u | grep -E "${2:-.}" | while read -r d; do
  ls $d/*.cpp | grep -vE 'tests/main.cpp|tests/this_build|orbit_harmonics|behaviour/published|behaviour/reduction|cli/sweep.cpp|contact/work.cpp|model/rescale|joined_tables' | sed "s|.*|#include \"$R&\"|" | split -l 12 - $O/u$$.$(echo $d | tr / _).
done
for u in $O/u$$.*; do
  clang++-16 -x c++ $F -I${R}tests -I${R}validation -fsyntax-only -include-pch $O/all.pch $u > $O/err 2>&1; n=$(grep -c error: $O/err)
  echo "${u##*u$$.}: $n errors $(date +%T)"; grep -E 'error:' $O/err | head -12; rm $u
done
