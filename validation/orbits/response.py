#!/usr/bin/env python3
"""The tables of README.md, from what run.sh wrote.

response.py frequencies   the values of the sweep
response.py OUT           folds of the branch, where its stability changes, jumps of the sweep, CPU times
"""
import csv
import sys

KEY = "loads.1.history.omega"
FREQUENCIES = [45.8, 46, 46.05, 46.08, 46.09, 46.096, 46.1, 46.104, 46.11, 46.15, 46.4, 46.8, 47.2, 47.6, 47.9, 48, 48.05, 48.07,
               48.08, 48.085, 48.089, 48.095, 48.1, 48.15, 48.3, 48.6]


def rows_of(path):
    with open(path) as file:
        return list(csv.DictReader(file))


def branch(out):
    rows = rows_of(out + "/response/branch.csv")
    folds = [r for r in rows if r["special"] == "fold"]
    print(f"{len(rows)} points")
    for fold in folds:
        print(f"fold at {float(fold['parameter']):.7f} rad/s: greatest multiplier {float(fold['max_multiplier']):.10f}, "
              f"residual {float(fold['residual']):.1e}")
    parts, state = [], None
    for r in rows:
        if r["stable"] == "":
            continue
        if r["stable"] != state:
            parts.append([r["stable"], r["parameter"], r["parameter"], 0])
            state = r["stable"]
        parts[-1][2] = r["parameter"]
        parts[-1][3] += 1
    for stable, first, last, count in parts:
        print(f"{'stable' if stable == 'true' else 'unstable'}: {count} points from {float(first):.6f} to {float(last):.6f}")
    return rows


def sweep(out):
    rows = rows_of(out + "/hysteresis/strobe.csv")
    last = {}
    for r in rows:
        last.setdefault((r["way"], float(r[KEY])), []).append(float(r["w"]))
    print("\n| omega, rad/s | up: w [mm] | spread | down: w [mm] | spread |\n|---|---|---|---|---|")
    for omega in FREQUENCIES:
        cells = []
        for way in ("there", "back"):
            w = last.get((way, omega), [float("nan")])
            cells += [f"{1e3 * w[-1]:.6f}", f"{1e3 * (max(w) - min(w)):.1e}"]
        print(f"| {omega:g} | " + " | ".join(cells) + " |")


def cpu(out, name):
    """User and system time of the children, as `times` of a shell prints it."""
    with open(f"{out}/{name}.cpu") as file:
        total = 0.0
        for text in file.read().split()[:2]:
            minutes, seconds = text.rstrip("s").split("m")
            total += 60.0 * float(minutes) + float(seconds)
    return total


if __name__ == "__main__":
    if sys.argv[1] == "frequencies":
        print(",".join(f"{f:g}" for f in FREQUENCIES))
    else:
        branch(sys.argv[1])
        sweep(sys.argv[1])
        print(f"\nCPU: response {cpu(sys.argv[1], 'response'):.1f} s, "
              f"a thousand runs of one period {cpu(sys.argv[1], 'periods'):.1f} s")
