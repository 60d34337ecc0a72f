#!/usr/bin/python3
"""index.py TREE [shard/shards]: writes the index of TREE to TREE/build/names/idx, one file a unity file."""
import os, sys, re, subprocess, hashlib, time
HERE = os.path.dirname(os.path.abspath(__file__))
tree = sys.argv[1]
shard, shards = (map(int, sys.argv[2].split('/')) if len(sys.argv) > 2 else (0, 1))
root = os.path.abspath(tree) + '/'
out = root + 'build/names'
os.makedirs(out + '/unity', exist_ok=True); os.makedirs(out + '/idx', exist_ok=True); os.makedirs(out + '/generated/base', exist_ok=True)
os.chdir(root)
v = open('src/base/version.hpp.in').read()
v = re.sub(r'@[A-Z_]+@', '0.1.0', v)
gen = out + '/generated/base/version.hpp'
if not os.path.exists(gen) or open(gen).read() != v: open(gen, 'w').write(v)

never = {'tests/main.cpp'}
skip = {'src/scene/keys.cpp', 'tests/main.cpp', 'tests/this_build.cpp', 'tests/behaviour/orbit_harmonics.cpp', 'python/module.cpp'}
cm = open('tests/CMakeLists.txt').read()
for m in re.finditer(r'set_source_files_properties\(([^)]*?)PROPERTIES[^)]*SKIP_UNITY', cm):
    skip |= {'tests/' + f for f in m.group(1).split()}
cm = open('CMakeLists.txt').read()
for m in re.finditer(r'set_source_files_properties\(([^)$]*?)PROPERTIES[^)]*SKIP_UNITY', cm): skip |= set(m.group(1).split())
for m in re.finditer(r'foreach\(source ([^)]*)\)\s*set_source_files_properties\((\S+?)\$\{source\}', cm):
    skip |= {m.group(2) + f + '.cpp' for f in m.group(1).split()}

units = {}
def add(folder, most):
    for d, _, fs in os.walk(folder):
        fs = sorted(f'{d}/{f}' for f in fs if f.endswith('.cpp'))
        # as in together.cmake: the files that are skipped count
        for i, f in enumerate(fs):
            if f in never: continue
            if f in skip: units[f.replace('/', '_')[:-4]] = [f]
            else: units.setdefault(d.replace('/', '_') + f'_{i // most}', []).append(f)
add('src', 28); add('tests', 12); add('validation/differential', 12)
for f in subprocess.run("find validation benchmarks python examples -name '*.cpp' -not -path 'validation/differential/*'", shell=True, capture_output=True, text=True).stdout.split():
    units[f.replace('/', '_')[:-4]] = [f]
flags = ['-std=c++20', '-w', '-resource-dir', '/usr/lib/llvm-16/lib/clang/16', '-ferror-limit=30',
         '-I' + root + 'src', '-I' + root + 'include', '-I' + out + '/generated', '-isystem', '/usr/include/eigen3',
         '-isystem', '/usr/include/suitesparse', '-DSIGNORINI_TEST_DATA=""', '-DSIGNORINI_MODELS=""', '-DSIGNORINI_CASES=""',
         '-DSIGNORINI_PUBLISHED=""', '-DSIGNORINI_PROGRAM=""', '-DFMT_HEADER_ONLY=0', '-DTOML_HEADER_ONLY=0', '-DTOML_SHARED_LIB=1', '-DSIGNORINI_CHOLMOD', '-DSIGNORINI_FUZZ_TARGET=scene', '-DEIGEN_MALLOC_ALREADY_ALIGNED=1']
flags.remove('-DFMT_HEADER_ONLY=0')
import glob
py = subprocess.run("python3 -c 'import sysconfig; print(sysconfig.get_paths()[\"include\"])'", shell=True, capture_output=True, text=True).stdout.strip()
extra = ['-isystem', out + '/pybind11/include', '-isystem', py]
std = ['algorithm', 'array', 'cmath', 'filesystem', 'fstream', 'functional', 'map', 'memory', 'optional', 'string', 'vector', 'random', 'thread', 'iostream', 'numeric', 'fmt/core.h', 'fmt/format.h', 'Eigen/Core', 'Eigen/SparseCore', 'Eigen/Dense', 'Eigen/SparseCholesky', 'nlohmann/json.hpp', 'toml++/toml.h', 'CLI/CLI.hpp']
plain = 'PLAIN' in os.environ   # every unity file parses its headers itself: slower, needs no trust in precompiled headers
project = [] if plain else sorted(f'{d}/{f}' for t in ('include', 'src') for d, _, fs in os.walk(t) for f in fs if f.endswith('.hpp'))
pch = out + '/pch.pch'; test_pch = out + '/test.pch'
if shard == 0:   # the other waits for it
    for p in (pch, test_pch):
        if os.path.exists(p): os.remove(p)
    t = time.time()
    text = ''.join(f'#include <{h}>\n' for h in std) + ''.join(f'#include "{root}{p}"\n' for p in project)
    open(out + '/all.hpp', 'w').write(text)
    open(out + '/test.hpp', 'w').write('#include <doctest/doctest.h>\n' + text)
    for h, p in ((out + '/all.hpp', pch), (out + '/test.hpp', test_pch)):
        r = subprocess.run(['clang++-16', '-x', 'c++-header', *flags, '-fpch-instantiate-templates', h, '-o', p + '.new'], capture_output=True, text=True)
        err = [l for l in r.stderr.split('\n') if 'error:' in l]
        print(f'{p}: {time.time() - t:.1f} s, {len(err)} errors', *err[:5], sep='\n    ', flush=True)
        if err: sys.exit(1)
        os.rename(p + '.new', p)
    # what headers declare
    open(out + '/all.cpp', 'w').write(text)
    r = None if plain else subprocess.run([out + '/indexer', root, out + '/idx/_headers.txt', out + '/all.cpp', '--', *flags], capture_output=True, text=True, env={**os.environ, 'HEADERS': '1'})
    if r: print(f'headers: {time.time() - t:.1f} s', [l for l in r.stderr.split('\n') if 'error:' in l][:3], flush=True)
else:
    while not os.path.exists(test_pch): time.sleep(1)
have = set()
bad = 0
names = sorted(units)
def key(n):
    return 0
only = os.environ.get('ONLY')
for i, n in enumerate(names):
    have.add(n)
    if i % shards != shard or (only and not re.search(only, n)): continue
    u = f'{out}/unity/{n}.cpp'
    open(u, 'w').write(''.join(f'#include "{root}{f}"\n' for f in units[n]))
    more = ['-I' + root + 'tests'] if n.startswith(('tests', 'validation')) else []
    if n.startswith(('tests', 'validation')): more += ['-I' + root + 'validation']
    if n.startswith('benchmarks'): more += ['-I' + root + 'benchmarks']
    for f in units[n]:
        if f.startswith(('validation', 'examples', 'python')): more += ['-I' + root + os.path.dirname(f)]
    if n.startswith(('python',)): more += extra
    t = time.time()
    r = subprocess.run([out + '/indexer', root, f'{out}/idx/{n}.txt', u, '--', 'clang++-16', *flags, *dict.fromkeys(more), '-include-pch', pch, '-fsyntax-only'] if False else
                       [out + '/indexer', root, f'{out}/idx/{n}.txt', u, '--', *flags, *more, '-include-pch', test_pch if n.startswith('tests') else pch], capture_output=True, text=True,
                       env={**os.environ, 'HEADERS': '1'} if plain else None)
    err = [l for l in r.stderr.split('\n') if ': error:' in l or ': fatal error:' in l]
    print(f'{n}: {time.time() - t:.1f} s, {len(units[n])} files, {len(err)} errors', flush=True)
    for l in err[:8]: print('   ', l)
    bad += len(err)
for f in os.listdir(out + '/idx'):
    if f[:-4] not in have and not only and f[0] != '_': os.remove(out + '/idx/' + f)
print('errors:', bad)
