#!/usr/bin/python3
"""apply.py TREE renames|namespaces|both [--dry]: edits TREE by the index in TREE/build/names/idx.
data/renames.txt, data/namespaces.txt. The index must be that of the tree as it stands."""
import os, re, sys, json, collections, glob
HERE = os.path.dirname(os.path.abspath(__file__))
tree, what = sys.argv[1], sys.argv[2]; dry = '--dry' in sys.argv
do_r = what in ('renames', 'both'); do_n = what in ('namespaces', 'both')
os.chdir(tree)
OUT = os.path.abspath('build/names')
lines = set()
for f in glob.glob(OUT + '/idx/*.txt'):
    lines.update(open(f, encoding='utf-8', errors='surrogateescape').read().split('\n'))
lines.discard('')
parent = {}
def find(x):
    while parent.get(x, x) != x:
        parent[x] = parent.get(parent[x], parent[x]); x = parent[x]
    return x
def union(a, b):
    a, b = find(a), find(b)
    if a != b: parent[a] = b
decls = {}                       # loc -> list of (kind, name, space, def, qname)
refs = collections.defaultdict(set); lookups = collections.defaultdict(set)
tname = {}; tspace = {}
noq = set(); external = set(); unresolved = {}
blocks = {}; items = collections.defaultdict(dict)
for l in lines:
    t = l.split('\t')
    k = t[0]
    if k == 'D': decls.setdefault(t[1], []).append(tuple(t[2:7]))
    elif k == 'S': union(t[1], t[2])
    elif k in 'RL':
        (refs if k == 'R' else lookups)[t[1]].add(t[2]); tname[t[2]] = t[3]; tspace[t[2]] = t[4]
    elif k == 'C': noq.add(t[1])
    elif k == 'X': external.add(t[1])
    elif k == 'U': unresolved[t[1]] = t[2]
    elif k == 'B':
        if t[2]: blocks[t[1]] = (t[2], t[3], t[4], t[5])
    elif k == 'I': items[t[6]][t[1]] = (t[2], t[3], t[4], t[5])
del lines
def split(loc):
    f, o = loc.rsplit(':', 1); return f, int(o)
data = {}
def text(f):
    if f not in data: data[f] = open(f, 'rb').read()
    return data[f]
edits = collections.defaultdict(dict)     # file -> {offset: [insert_before, old_len, new]}
def edit(f, o):
    return edits[f].setdefault(o, ['', 0, None])
notes = collections.Counter()
def note(s):
    notes[s] += 1
group = collections.defaultdict(list)
for loc in decls: group[find(loc)].append(loc)

# Classes of pointers to members, X::Y::*, which clang's tree does not place.
bytype = collections.defaultdict(set)
for l, ds in decls.items():
    for d in ds:
        if d[0] in ('type', 'alias') and d[2].startswith('signorini'): bytype[d[1]].add(find(l))
for t in ['src', 'include', 'tests', 'validation', 'benchmarks', 'examples', 'python']:
    for dd, _, fs in os.walk(t):
        for f in fs:
            if not f.endswith(('.hpp', '.cpp')): continue
            p = f'{dd}/{f}'
            for m in re.finditer(rb'(?<![\w:])([A-Z]\w+)(?:::\w+)*::\*', text(p)):
                loc = f'{p}:{m.start(1)}'; n = m.group(1).decode()
                if loc not in refs and len(bytype[n]) == 1: refs[loc].add(next(iter(bytype[n])))
# ---- namespaces
pm = next((json.load(open(p)) for p in (OUT + '/paths.json',) if os.path.exists(p)), {})
table = {}
for l in open(HERE + '/data/namespaces.txt'):
    l = l.split('#')[0].strip()
    if l: a, b = l.split(); table[a] = b
def folder_ns(f): return table.get(os.path.dirname(f), '')

if do_n:
    home = {}                    # group root -> '' (root) or namespace; only of those directly in signorini
    anon = {}                    # group root -> file of its anonymous namespace
    for g, locs in group.items():
        ds = [(l, d) for l in locs for d in decls[l]]
        if any(d[2] == 'signorini::(anon)' for _, d in ds):
            anon[g] = split(locs[0])[0]; continue
        ds = [(l, d) for l, d in ds if d[2] == 'signorini']
        if not ds or ds[0][1][0] == 'namespace': continue
        fs = [split(l)[0] for l, _ in ds]
        if any(f.startswith('include/') for f in fs): home[g] = ''; continue
        if any(not f.startswith('src/') for f in fs): home[g] = ''; continue
        kind = ds[0][1][0]
        best = [f for (l, d), f in zip(ds, fs) if d[3] == 'def'] if kind == 'type' else [f for f in fs if f.endswith('.hpp')]
        f = (sorted(best) or sorted(fs))[0]
        home[g] = folder_ns(f)
    # items of every block
    begin_items = collections.defaultdict(list)   # file -> [(b, e, ns or None, kind, fwd, owner)]
    mains = {}
    for b, (rb, name, nested, space) in blocks.items():
        f, bo = split(b)
        if name != 'signorini' or space != '::' or not f.startswith('src/'): continue
        if not re.match(rb'namespace signorini\s*\{', text(f)[bo:bo + 60]): continue   # signorini::cli
        its = []
        for ib, (ie, kind, owner, fwd) in items[b].items():
            o1 = split(ib)[1]; o2 = split(ie)[1] if ie else o1
            if kind == 'Namespace':
                inner = blocks.get(ib)
                n = 'ANON' if inner and inner[1] == '(anon)' else 'NESTED'
                if inner: o2 = split(inner[0])[1] + 1
            elif kind in ('UsingDirective', 'NamespaceAlias', 'Empty', 'StaticAssert'): n = None
            else:
                g = find(owner)
                n = home.get(g)
                if n is None and owner == '-': n = None
            its.append([o1, o2, n, kind, fwd, owner])
        its.sort()
        mains.setdefault(f, []).append((bo, split(rb)[1], its))
    names = collections.defaultdict(set)
    for g, n in home.items():
        for l in group[g]: names[n].update(d[1] for d in decls[l])
    anon_ns = {}   # file -> ns
    # who refers to what: refs by file
    by_file = collections.defaultdict(list)
    for loc in set(refs) | set(lookups):
        f, o = split(loc); by_file[f].append((o, loc))
    for f, bl in mains.items():
        default = folder_ns(f)
        for bo, be, its in bl:
            named = {i[2] for i in its if i[2] not in (None, 'ANON', 'NESTED')and i[4] != 'fwd'}
            if 'NESTED' in {i[2] for i in its} and not named: default = ''
            elif named and default not in named: default = sorted(named)[0]
            pick = default
            if '' in named and default and any(i[2] == 'ANON' for i in its):
                cost = {default: 0, '': 0}
                for o, loc in by_file[f]:
                    it = next((i for i in its if i[0] <= o < i[1]), None)
                    if not it: continue
                    for t in refs[loc]:
                        g = find(t)
                        if g in anon and it[2] == '': cost[default] += 1
                        if it[2] == 'ANON' and home.get(g) == default: cost[''] += 1
                pick = min(cost, key=cost.get)
            for i in its:
                if i[2] == 'ANON': i[2] = pick; anon_ns[f] = pick
                elif i[2] == 'NESTED': i[2] = ''
            prev = None
            for i in its:
                if i[2] is None: i[2] = prev if prev is not None else next((j[2] for j in its if j[2] is not None and j[4] != 'fwd'), default)
                if i[4] != 'fwd': prev = i[2]
        
    for g, f in anon.items():
        n = anon_ns.get(f, folder_ns(f) if f.startswith('src/') else '')
        home[g] = n
        for l in group[g]: names[n].update(d[1] for d in decls[l])
    # structure edits
    opened = {}
    ctx_items = {}
    for f, bl in mains.items():
        d = text(f)
        ctx_items[f] = [i for _, _, its in bl for i in its]
        for bo, be, its in bl:
            body = [i for i in its if i[4] != 'fwd']
            main_ns = collections.Counter(i[2] for i in body).most_common(1)[0][0] if body else folder_ns(f)
            first = body[0][2] if body else main_ns
            forward = collections.defaultdict(list)
            for i in its:
                if i[4] == 'fwd' and i[2] != first:
                    b = i[0]
                    # template <...> or the whole line
                    ls = d.rfind(b'\n', 0, b) + 1
                    le = d.find(b'\n', i[1])
                    if d[ls:b].strip(): note(f'{f}: forward declaration within a line'); continue
                    forward[i[2]].append(d[ls:le].decode())
                    e = edit(f, ls); e[1] = le + 1 - ls; e[2] = ''
                    i[3] = 'GONE'
            pre = ''
            if f.endswith('.cpp') or f.endswith('.hpp'):
                for n in sorted(forward):
                    q = 'signorini' + ('::' + n if n else '')
                    pre += f'namespace {q} {{\n' + '\n'.join(dict.fromkeys(forward[n])) + f'\n}}  // namespace {q}\n\n'
            br = d.find(b'{', bo)
            e = edit(f, bo); e[1] = br + 1 - bo
            ns = lambda n: 'signorini' + ('::' + n if n else '')
            e[2] = pre + f'namespace {ns(first)} {{'
            cur = first
            for a, i in zip([None] + body, body):
                if i[2] != cur:
                    # after the end of the previous one: its line
                    le = d.find(b'\n', a[1])
                    e2 = edit(f, le)
                    e2[0] = f'\n\n}}  // namespace {ns(cur)}\n\nnamespace {ns(i[2])} {{' + e2[0]
                    cur = i[2]
            le = d.find(b'\n', be)
            e = edit(f, be); e[1] = (le if le > 0 else len(d)) - be; e[2] = f'}}  // namespace {ns(cur)}'
    def ctx(f, o):
        for i in ctx_items.get(f, ()):
            if i[0] <= o < i[1]: return i[2], i
        return '', None
    using = {}        # file -> {ns::name}: by a using-declaration (data/using.txt) in place of qualifiers
    for l in open(HERE + '/data/using.txt'):
        l = l.split('#')[0].strip()
        if l: a, b = l.split(); using.setdefault(a, set()).add(b)
    for f, us in list(using.items()):
        bl = mains.get(f) or next((mains[o] for o, n in pm.items() if n == f and o in mains), None)
        if not bl: note(f'using.txt: no {f}'); continue
        ff = f if f in mains else next(o for o, n in pm.items() if n == f and o in mains)
        using.setdefault(ff, us)
        e = edit(ff, bl[0][0])
        e[2] += '\n\n' + ''.join(f'using {u};\n' for u in sorted(us))
    qualified = collections.Counter()
    for f, l in by_file.items():
        d = text(f)
        mine = ''
        for o, loc in l:
            if loc in noq: continue
            ts = refs.get(loc) or lookups.get(loc)
            hs = {home[find(t)] for t in ts if find(t) in home and not (find(t) in anon and anon[find(t)] != f and not f.endswith('.hpp'))}
            if not hs: continue
            c, it = ctx(f, o)
            if it is not None and it[3] == 'GONE': continue
            before = d[max(0, o - 2):o]
            q = before == b'::'
            if len(hs) > 1:
                if hs != {c}: note(f'{f}:{d[:o].count(10) + 1}: {d[o:o+30]!r} in several namespaces {hs}')
                continue
            h = hs.pop()
            nm = re.match(rb'\w+', d[o:]).group().decode() if re.match(rb'\w+', d[o:]) else ''
            if not nm: continue
            if h == '':
                if c and nm in names[c] and not q: edit(f, o)[0] = 'signorini::'; qualified['signorini'] += 1
            elif h == c and not q: continue
            else:
                qual = re.search(rb'(\w+)::$', d[max(0, o - 60):o])
                if q and qual and qual.group(1).decode() == nm: continue   # inherited constructors
                if q and qual and qual.group(1) != b'signorini': note(f'{f}:{d[:o].count(10) + 1}: qualified by {qual.group(1)!r} {nm}'); 
                if q and d[max(0, o-3):o] in (b' ::', b'(::', b'\n::') : note(f'{f}: global {nm}')
                if not q and f'{h}::{nm}' in using.get(f, ()) and c != h: continue
                edit(f, o)[0] = h + '::'; qualified[h] += 1
    print('qualified:', sum(qualified.values()), dict(qualified.most_common()))

# ---- renames
rn = []
for n, l in enumerate(open(HERE + '/data/renames.txt')):
    l = l.split('#')[0].strip()
    if not l: continue
    m = re.match(r'(\S+) -> (\w+)$', l)
    if not m: sys.exit(f'renames.txt:{n + 1}: {l}')
    rn.append(m.groups())
renamed = {}
if do_r:
    exact = collections.defaultdict(list)
    for a, b in rn: exact[a.split('::')[-1].split(':')[-1]].append((a, b))
    used = collections.Counter()
    for g, locs in group.items():
        for l in locs:
            for kind, name, space, df, qn in decls[l]:
                for a, b in exact.get(name, ()):
                    # local:name, member:name (any class), Class::name, name (direct in signorini or anywhere below by full path), *::name
                    pre = a[:-len(name)]
                    qq = qn.replace('signorini::', '', 1).replace('(anonymous namespace)::', '')
                    if pre == 'local:': ok = kind == 'local'
                    elif pre == '*::': ok = True
                    elif pre == 'member:': ok = kind in ('member', 'method', 'enumerator') and split(l)[0].startswith(('src/', 'include/'))
                    elif pre == '': ok = space in ('signorini', 'signorini::(anon)') and kind != 'namespace'
                    elif pre.startswith('@'):  # @path-prefix:name
                        ok = split(l)[0].startswith(pre[1:-1]) or pm.get(split(l)[0], '').startswith(pre[1:-1])
                    else: ok = qq == a or qq.endswith('::' + a)
                    if ok and not any(x in external for x in locs):
                        renamed.setdefault(g, (name, b)); used[a] += 1
    for a, b in rn:
        if not used[a]: note(f'no declaration for {a}')
    count = 0
    def change(f, o, old, new):
        global count
        d = text(f)
        m = re.match(rb'\w+', d[o:])
        if not m or m.group().decode() != old: note(f'{f}:{d[:o].count(10)+1}: not {old}: {d[o:o+20]!r}'); return
        e = edit(f, o)
        if e[2] is not None and e[2] != new: note(f'{f}:{o}: two renames {e[2]} {new}'); return
        e[1] = len(old); e[2] = new; count += 1
    for g, (old, new) in renamed.items():
        for l in group[g]: change(*split(l), old, new)
    for loc, ts in refs.items():
        rs = {renamed.get(find(t)) for t in ts}
        if rs == {None}: continue
        if len(rs) > 1: note(f'{loc}: renamed and not {rs}'); rs.discard(None)
        change(*split(loc), *rs.pop())
    for loc, nm in unresolved.items():
        if loc not in refs and any(nm == o for o, _ in renamed.values()): note(f'{loc}: dependent {nm} not resolved')
    print('renames:', len(renamed), 'declarations,', count, 'places')
for s, n in sorted(notes.items()): print('note:', s, f'x{n}' if n > 1 else '')
if dry: sys.exit()
for f, es in edits.items():
    d = text(f)
    out = []; pos = 0
    for o in sorted(es):
        ins, ln, new = es[o]
        if o < pos:  # inside something that was replaced
            print('overlap', f, o); continue
        out.append(d[pos:o]); out.append(ins.encode())
        if new is not None: out.append(new.encode()); pos = o + ln
        else: pos = o
    out.append(d[pos:])
    open(f, 'wb').write(b''.join(out))

# ---- names in comments and documents
if do_r:
    words = {}
    for g, (old, new) in renamed.items():
        words.setdefault(old, set()).add(new)
    sure = {o: next(iter(n)) for o, n in words.items() if len(n) == 1}
    # a name that is no English word: with a capital within, or an underscore
    plain = {o for o in sure if re.search(r'_|[a-z][A-Z]', o) and not o.endswith('_')}
    other = {o for o in sure if o not in plain}
    still = {d[1] for g, ls in group.items() if g not in renamed for l in ls for d in decls[l]}
    plain -= still
    rx = re.compile(r'\b(' + '|'.join(sorted(map(re.escape, plain), key=len, reverse=True)) + r')\b(?!\.(hpp|cpp))') if plain else None
    ry = re.compile(r'(?<=`)(' + '|'.join(sorted(map(re.escape, other - still), key=len, reverse=True)) + r')(?=`|::|\(|\.)') if other else None
    capital = {o for o in other - still if o[0].isupper()}
    rz = re.compile(r'(?<=[a-z,(] )(' + '|'.join(sorted(map(re.escape, capital), key=len, reverse=True)) + r')\b(?!\.(hpp|cpp))') if capital else None
    rt = re.compile(r'`(' + '|'.join(sorted(map(re.escape, capital), key=len, reverse=True)) + r')`') if capital else None
    def prose(s):
        if rx: s = rx.sub(lambda m: sure[m.group(1)], s)
        if rz: s = rz.sub(lambda m: sure[m.group(1)], s)
        if ry: s = ry.sub(lambda m: sure[m.group(1)], s)
        return s
    for t in ['src', 'include', 'tests', 'validation', 'benchmarks', 'python', 'examples']:
        for dd, _, fs in os.walk(t):
            for f in fs:
                if not f.endswith(('.hpp', '.cpp')): continue
                p = f'{dd}/{f}'; s = open(p).read()
                n = '\n'.join((lambda m: m.group(1) + prose(m.group(2)) if m else l)(re.match(r'^((?:[^"]|"(?:[^"\\]|\\.)*")*?)(//.*)$', l)) for l in s.split('\n'))
                if n != s: open(p, 'w').write(n)
    for p in ['CONTRIBUTING.md'] + glob.glob('docs/**/*.md', recursive=True):
        s = open(p).read()
        n = re.sub(r'`[^`\n]+`', lambda m: (rx.sub(lambda k: sure[k.group(1)], m.group(0)) if rx else m.group(0)), s)
        if rt: n = rt.sub(lambda k: '`' + sure[k.group(1)] + '`', n)
        if n != s: open(p, 'w').write(n)
if do_n:
    # `signorini::X` and folders' names in comments: by the table of homes
    hs = collections.defaultdict(set)
    for g, n in home.items():
        if g in anon: continue
        for l in group[g]:
            for d in decls[l]: hs[d[1]].add(n)
