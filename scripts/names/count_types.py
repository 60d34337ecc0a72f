#!/usr/bin/python3
"""count_types.py TREE: types (struct, class, enum, union; definitions) by namespace, from the format: what opens in column 0."""
import os, re, sys, collections
os.chdir(sys.argv[1])
n = collections.Counter()
for t in ['src', 'include']:
    for d, _, fs in os.walk(t):
        for f in fs:
            if not f.endswith(('.hpp', '.cpp')): continue
            ns = []
            for l in open(f'{d}/{f}'):
                m = re.match(r'^namespace ?([\w:]*) ?\{', l)
                if m: ns.append(m.group(1) or '(anon)'); continue
                if re.match(r'^\}  // namespace', l): ns and ns.pop(); continue
                m = re.match(r'^(?:struct|class|enum class|enum|union) (?:\[\[\w+\]\] )?(\w+)(?: final)?(?: : [^;]*)?(?: \{.*|)$', l)
                if m and ';' not in l.split('{')[0]: n['::'.join(ns)] += 1
direct = n['signorini'] ; anon = n['signorini::(anon)']
print('directly in signorini:', direct, '(and', anon, 'in its unnamed namespaces);', 'of all:', sum(n.values()))
if '-v' in sys.argv:
    for k, v in n.most_common(): print(f'{v:5} {k}')
