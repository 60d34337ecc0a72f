#!/usr/bin/python3
"""joins.py TREE [--dry]: applies data/joins.txt to TREE: joins files, moves folders, rewrites includes and paths.
Writes the map old -> new to TREE/build/names/paths.json. Parts that are not there are skipped."""
import os, re, sys, json, collections
HERE = os.path.dirname(os.path.abspath(__file__))
tree = sys.argv[1]; dry = '--dry' in sys.argv
os.chdir(tree)
OUT = os.path.abspath('build/names')
os.makedirs(OUT, exist_ok=True)
TOP = ['src', 'include', 'tests', 'validation', 'benchmarks', 'python', 'examples']
def sources():
    for t in TOP:
        for d, _, fs in os.walk(t):
            for f in fs:
                if f.endswith(('.hpp', '.cpp')): yield f'{d}/{f}'
read = lambda p: open(p, encoding='utf-8').read()
INC = re.compile(r'^#include ([<"])([^>"]+)[>"](.*)$')

class File:
    def __init__(s, path):
        s.path = path
        L = read(path).split('\n')
        i = 0
        s.comment = []
        while i < len(L) and L[i].startswith('//'): s.comment.append(L[i]); i += 1
        s.includes = []; s.pragma = False
        pend = []
        start = i
        while i < len(L):
            l = L[i]
            m = INC.match(l)
            if m: s.includes.append((m.group(1), m.group(2), m.group(3))); i += 1; start = i; continue
            if l.strip() == '#pragma once': s.pragma = True; i += 1; start = i; continue
            if not l.strip(): i += 1; continue
            break
        s.body = L[start:]
        while s.body and not s.body[0].strip(): s.body.pop(0)
        while s.body and not s.body[-1].strip(): s.body.pop()
        s.ns = None
        if s.body:
            m = re.match(r'^namespace (signorini\S*) \{$', s.body[0]); e = re.match(r'^\}  // namespace (signorini\S*)$', s.body[-1])
            if m and e and m.group(1) == e.group(1) and sum(1 for l in s.body if l == s.body[0]) == 1:
                s.ns = m.group(1)
                s.inner = s.body[1:-1]
                while s.inner and not s.inner[0].strip(): s.inner.pop(0)
                while s.inner and not s.inner[-1].strip(): s.inner.pop()
        if any(l.startswith('#include') for l in s.body): print('  note: include inside', path)

plan = []
MAIN = set()   # parts whose comment heads the joined file
folders = []
for l in open(HERE + '/data/joins.txt'):
    l = l.split('#')[0].strip()
    if not l: continue
    m = re.match(r'folder (\S+) -> (\S+)$', l)
    if m: folders.append(m.groups()); continue
    m = re.match(r'(\S+): (\S+) <- (.+)$', l)
    ps = m.group(3).split()
    for q in ps:
        if q[0] == '*': MAIN.add(f'{m.group(1)}/{q[1:]}')
    plan.append((m.group(1), m.group(2), [q.lstrip('*') for q in ps]))

exists = set(sources())
moves = {}     # old path -> new path
groups = collections.OrderedDict()  # new path -> [old paths]
for folder, target, parts in plan:
    if '.' in target:   # everything into this one file
        new = f'{folder}/{target}'
        olds = []
        for p in parts:
            for e in ([''] if '.' in p else ['.hpp', '.cpp']):
                o = f'{folder}/{p}{e}'
                if o in exists: olds.append(o)
                elif '.' in p: print('  note: no', o)
        if olds: groups[new] = olds
        continue
    for e in ['.hpp', '.cpp']:
        new = f'{folder}/{target}{e}'
        olds = [f'{folder}/{p}{e}' for p in parts if f'{folder}/{p}{e}' in exists]
        if olds: groups[new] = olds
    for p in parts:
        if not any(f'{folder}/{p}{e}' in exists for e in ('.hpp', '.cpp')): print('  note: no', folder, p)

# A header that is folded into a .cpp must have no other includer.
inc = {}   # path -> list of included project paths (resolved under src/)
def resolve(p, frm):
    for base in ('src/', 'include/', 'tests/', 'validation/', os.path.dirname(frm) + '/'):
        if base + p in exists: return base + p
    return None
files = {p: File(p) for p in exists}
for p, f in files.items(): inc[p] = [r for q, n, _ in f.includes if q == '"' for r in [resolve(n, p)] if r]
users = collections.defaultdict(set)
for p, l in inc.items():
    for q in l: users[q].add(p)
for new in list(groups):
    olds = groups[new]
    if new.endswith('.cpp'):
        hpps = [o for o in olds if o.endswith('.hpp')]
        if any(users[h] - set(olds) for h in hpps):
            print('  note: kept header of', new, [sorted(users[h] - set(olds)) for h in hpps])
            groups[new] = [o for o in olds if o.endswith('.cpp')]
            h2 = new[:-4] + '.hpp'
            groups[h2] = hpps
for new, olds in groups.items():
    if new in exists and new not in olds and new not in {o for g in groups.values() for o in g}: sys.exit(f'{new} exists and is no part')
    for o in olds:
        if o in moves: sys.exit(f'{o} is in two joins')
        moves[o] = new
# after joins: cycles of headers
def final(p): return moves.get(p, p)
graph = collections.defaultdict(set)
for p, l in inc.items():
    if not p.endswith('.hpp'): continue
    for q in l:
        if final(p) != final(q): graph[final(p)].add(final(q))
state = {}; stack = []; cyc = []
sys.setrecursionlimit(5000)
def dfs(n):
    state[n] = 1; stack.append(n)
    for m in sorted(graph[n]):
        if state.get(m) == 1: cyc.append(stack[stack.index(m):] + [m])
        elif m not in state: dfs(m)
    stack.pop(); state[n] = 2
for n in sorted(graph):
    if n not in state: dfs(n)
for c in cyc:
    print('CYCLE', ' | '.join(f'{a[4:]} -> {b[4:]} (' + ', '.join(sorted({os.path.basename(p) + '>' + os.path.basename(q) for p, l in inc.items() if p.endswith('.hpp') for q in l if final(p) == a and final(q) == b})) + ')' for a, b in zip(c, c[1:])))
if cyc: sys.exit(1)

def topo(olds):
    out = []; left = list(olds)
    def put(o, trail=()):
        if o in out: return
        for q in inc[o]:
            if q in olds and q != o and q not in trail: put(q, trail + (o,))
        if o not in out: out.append(o)
    for o in left: put(o)
    return out

def strip_name(c, path):
    base = re.escape(os.path.basename(path))
    m = re.match(r'^// (?:\S*/)?' + base + r': (.*)$', c[0]) if c else None
    if not m: return c
    t = m.group(1)
    return ['// ' + t[:1].upper() + t[1:]] + c[1:]

fmove = dict()
def folder_final(p):
    for a, b in folders:
        if p.startswith(a + '/') : return b + p[len(a):]
    return p
def full(p): return folder_final(final(p))

def merged(new, olds):
    order = topo(olds)
    stem = os.path.basename(new)[:-4]
    main = next((o for o in order if o[:-4] in MAIN), None) or next((o for o in order if os.path.basename(o)[:-4] == stem), order[0])
    newname = os.path.basename(new)
    top = files[main].comment
    t = strip_name(top, main)
    if t is not top or not top:
        old = os.path.basename(main)
        top = [c.replace(old, newname, 1) if i == 0 else c for i, c in enumerate(top)]
    out = list(top)
    hpp = new.endswith('.hpp')
    if hpp: out.append('#pragma once')
    incs = collections.OrderedDict()
    for o in order:
        for q, n, rest in files[o].includes:
            r = resolve(n, o) if q == '"' else None
            if r and final(r) == new: continue
            if r and r.startswith('src/'): n = full(r)[4:]
            if r and r.startswith('include/'): n = full(r)[8:]
            incs.setdefault((q, n), rest)
    own = [k for k in incs if k[0] == '"' and not hpp and k[1] == folder_final(new)[4:-4] + '.hpp']
    public = {n for o in order for q, n, _ in files[o].includes[:1] if q == '"' and n.startswith('signorini/')}
    blocks = [own, sorted(k for k in incs if k[0] == '<'), sorted(k for k in incs if k[0] == '"' and k not in own)]
    if not own and len(order) and not hpp:
        first = files[order[0]].includes[:1]
        if first and first[0][0] == '"' and first[0][1].startswith('signorini/'):
            k = (first[0][0], first[0][1]); blocks[0] = [k]; blocks[2].remove(k)
    first = True
    for b in blocks:
        if not b: continue
        if out: out.append('') 
        out += [f'#include {q}{n}{">" if q == "<" else chr(34)}{incs[(q, n)]}' for q, n in b]
    if hpp and out and '#pragma once' in out:
        pass
    spaces = {files[o].ns for o in order}
    same = len(spaces) == 1 and None not in spaces
    if same:
        ns = spaces.pop()
        out += ['', f'namespace {ns} {{']
    for o in order:
        f = files[o]
        out.append('')
        c = [] if o == main else strip_name(f.comment, o)
        if same:
            if c: out += c + ['']
            out += f.inner
        else:
            if c: out += c + ['']
            out += f.body
    if same:
        out += ['', f'}}  // namespace {ns}']
    txt = '\n'.join(out) + '\n'
    if not hpp:  # one anonymous namespace where two meet
        txt = re.sub(r'\n\}  // namespace\n+namespace \{\n', '\n', txt)
    txt = re.sub(r'\}  // namespace (signorini\S*)\n((?:\n|//.*\n)*)namespace \1 \{\n', r'\2', txt)
    txt = re.sub(r'(namespace signorini\S* \{)\n\n(namespace \{)', r'\1\n\2', txt)
    txt = re.sub(r'(\}  // namespace)\n\n(\}  // namespace signorini)', r'\1\n\2', txt)
    return re.sub(r'\n{3,}', '\n\n', txt)

text = {new: merged(new, olds) for new, olds in groups.items()}
pathmap = {p: full(p) for p in exists if p.startswith(('src/', 'include/')) and full(p) != p}

# test files: renamed where one test stands for the joined file
tests = {p for p in exists if p.startswith('tests/unit/')}
want = collections.defaultdict(list)
for t in sorted(tests):
    srcstem = 'src/' + t[len('tests/unit/'):-4]
    new = next((moves[srcstem + e] for e in ('.hpp', '.cpp') if srcstem + e in moves), None)
    nt = t if not new else 'tests/unit/' + new[4:-4] + '.cpp'
    want[nt].append(t)
tmove = {}
for nt, ts in want.items():
    if len(ts) == 1 and (nt == ts[0] or nt not in tests): tmove[ts[0]] = nt
for t in tests:
    n = folder_final(tmove.get(t, t))
    if n != t: pathmap[t] = n
for t in exists - tests:
    if t.startswith('tests/') and folder_final(t) != t: pathmap[t] = folder_final(t)
if dry:
    n = {full(p) for p in exists if p.startswith('src/')}
    print(len(n), 'files under src'); 
    for new, t in text.items():
        if t.count('\n') > 600: print('too long', new, t.count('\n'))
    sys.exit()

for olds in groups.values():
    for o in olds: os.remove(o)
for new, t in text.items():
    n = folder_final(new); os.makedirs(os.path.dirname(n), exist_ok=True); open(n, 'w').write(t)
for p in exists:
    if p in moves: continue
    n = pathmap.get(p, p)
    if n != p: os.makedirs(os.path.dirname(n), exist_ok=True); os.rename(p, n)
for d in [a for a, _ in folders]:
    for dd, _, _ in sorted(os.walk(d), reverse=True):
        if not os.listdir(dd): os.rmdir(dd)

# includes of everybody
short = {o[4:]: n[4:] for o, n in pathmap.items() if o.startswith('src/')} | {o[8:]: n[8:] for o, n in pathmap.items() if o.startswith('include/')}
tshort = {o[6:]: n[6:] for o, n in pathmap.items() if o.startswith('tests/')}
def fix_includes(t, me):
    seen = set(); out = []
    for l in t.split('\n'):
        m = INC.match(l)
        if m and (m.group(1) == '"' or m.group(2).startswith('signorini/')):
            n = short.get(m.group(2), tshort.get(m.group(2), m.group(2)))
            if me == 'src/' + n: continue
            if n in seen and m.group(2) != n: continue
            if n in seen: continue
            seen.add(n)
            if n != m.group(2): l = f'#include {m.group(1)}{n}{">" if m.group(1) == "<" else chr(34)}{m.group(3)}'
        out.append(l)
    return '\n'.join(out)
for p in sources():
    t = read(p); n = fix_includes(t, p)
    if n != t: open(p, 'w').write(n)
json.dump(pathmap, open(OUT + '/paths.json', 'w'), indent=0, sort_keys=True)
print(len(list(p for p in sources() if p.startswith('src/'))), 'files under src')
