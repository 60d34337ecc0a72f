#!/usr/bin/python3
"""paths.py TREE [--check]: rewrites paths of joined and moved files in documents, comments, CMake lists and suites by
TREE/build/names/paths.json (joins.py). --check: lists paths that documents or comments name and that do not exist."""
import os, re, sys, json, glob, collections
HERE = os.path.dirname(os.path.abspath(__file__))
tree = sys.argv[1]; check = '--check' in sys.argv
os.chdir(tree)
OUT = os.path.abspath('build/names')
os.makedirs(OUT, exist_ok=True)
folders = [re.match(r'folder (\S+) -> (\S+)', l).groups() for l in open(HERE + '/data/joins.txt') if l.startswith('folder ')]
allfiles = [f'{d}/{f}' for t in ['src', 'include', 'tests', 'validation', 'benchmarks', 'python', 'examples'] for d, _, fs in os.walk(t) for f in fs]
sources = [p for p in allfiles if p.endswith(('.hpp', '.cpp'))]
docs = [p for p in glob.glob('**/*.md', recursive=True) if not p.startswith('build')]
cmakes = ['CMakeLists.txt', *glob.glob('*/CMakeLists.txt'), *glob.glob('scripts/*'), '.ci/run', '.clang-tidy']
cmakes = [c for c in cmakes if os.path.isfile(c)]
TOKEN = re.compile(r'(?<![\w./-])(?:\.\./)*((?:[\w.-]+/)*[\w-]+\.(?:hpp|cpp))\b')
if not check:
    m = json.load(open(OUT + '/paths.json'))
    bybase = collections.defaultdict(set)
    for o, n in m.items():
        if o.startswith(('src/', 'include/')): bybase[os.path.basename(o)].add(n)
    now = set(sources)
    nowbase = collections.Counter(os.path.basename(p) for p in now)
    back = collections.defaultdict(set)   # new -> folders that the old ones were in
    oldfolder = {}
    for o, n in m.items(): oldfolder.setdefault(os.path.dirname(n), set()).add(os.path.dirname(o))
    def one(tok, folder, last):
        for pre in ('', 'src/', 'tests/', 'include/'):
            if pre + tok in m:
                n = m[pre + tok]
                return n[len(pre):], os.path.dirname(pre + tok)
        if '/' in tok:
            # last parts of a path: modal/damped_proof.hpp
            c = {(o, n) for o, n in m.items() if o.endswith('/' + tok)}
            if len(c) == 1:
                o, n = c.pop(); return '/'.join(n.split('/')[-len(tok.split('/')):]), os.path.dirname(o)
            return tok, (os.path.dirname('src/' + tok) if not tok.startswith('src/') else os.path.dirname(tok))
        for f in [*oldfolder.get(folder, ()), folder, last]:
            if f and f'{f}/{tok}' in m: return os.path.basename(m[f'{f}/{tok}']), f
            if f and (f'{f}/{tok}' in now): return tok, f
        b = bybase.get(tok, set())
        if len(b) == 1 and not nowbase[tok]: return os.path.basename(next(iter(b))), last
        return tok, last
    def line(l, folder):
        last = [None]
        def sub(k):
            r, last[0] = one(k.group(1), folder, last[0]); return k.group(0)[:len(k.group(0)) - len(k.group(1))] + r
        l = TOKEN.sub(sub, l)
        for a, b in folders:
            if a.startswith('src/'):
                l = re.sub(r'(?<![\w/])' + re.escape(a) + r'(?![\w])', b, l)
                l = re.sub(r'(?<![\w/."])' + re.escape(a[4:]) + r'/(?=[\w*])', b[4:] + '/', l) if '/' in a[4:] else l
            else:
                l = re.sub(r'(?<![\w/])' + re.escape(a) + r'(?![\w])', b, l)
        return l
    def unique(l):  # `a.hpp`, `a.hpp`
        l = re.sub(r'(`[\w./]+`), \1(?=[,;. |])', r'\1', l)
        return re.sub(r'`((?:[\w]+/)+)([\w]+\.[ch]pp)`, `\2`(?=[,;. |])', r'`\1\2`', l)
    for p in docs:
        s = open(p).read()
        n = '\n'.join(unique(line(l, os.path.dirname(p))) for l in s.split('\n'))
        if n != s: open(p, 'w').write(n)
    for p in cmakes:
        s = open(p).read()
        n = '\n'.join(line(l, 'tests' if p.startswith('tests') else '') for l in s.split('\n'))
        if n != s: open(p, 'w').write(n)
    suites = {}
    for o, n in m.items():
        if o.startswith('tests/unit/'): suites[o[6:-4]] = n[6:-4]
    for p in sources:
        s = open(p).read(); out = []
        for l in s.split('\n'):
            k = re.match(r'^((?:[^"]|"(?:[^"\\]|\\.)*")*?)(//.*)$', l)
            if k and not l.startswith('#include'): l = k.group(1) + line(k.group(2), os.path.dirname(p))
            if p.startswith('tests/'):
                l = re.sub(r'"((?:slow/|deep/)?)(unit/[\w/]+)"', lambda k: f'"{k.group(1)}{suites.get(k.group(2), k.group(2))}"', l)
            out.append(l)
        n = '\n'.join(out)
        if n != s: open(p, 'w').write(n)
    sys.exit()
have = set(allfiles); base = {os.path.basename(p) for p in allfiles}
tails = {'/'.join(p.split('/')[i:]) for p in allfiles for i in range(len(p.split('/')))}
bad = 0
for p in docs + sources:
    for i, l in enumerate(open(p), 1):
        if p in sources:
            k = re.match(r'^((?:[^"]|"(?:[^"\\]|\\.)*")*?)(//.*)$', l)
            if not k: continue
            l = k.group(2)
        for t in TOKEN.findall(l):
            t = re.sub(r'^(\.\./)+', '', t)
            if t not in tails and not t.endswith(('version.hpp', 'main.cpp')):
                print(f'{p}:{i}: {t}'); bad += 1
        if p in docs:
            for t in re.findall(r'`((?:src|tests|include|validation|scripts|docs)/[\w/-]+)`', l):
                if not os.path.exists(t): print(f'{p}:{i}: {t}'); bad += 1
print(bad, 'paths that do not exist')
