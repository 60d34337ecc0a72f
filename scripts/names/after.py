#!/usr/bin/python3
"""after.py TREE: what the namespaces change besides C++: embed.cmake, includes.sh, CONTRIBUTING, words.sh."""
import os, re, sys, shutil
HERE = os.path.dirname(os.path.abspath(__file__))
os.chdir(sys.argv[1])
def change(p, pairs):
    s = open(p).read()
    for a, b in pairs:
        if a in s: s = s.replace(a, b)
        elif b not in s: print(f'note: {p}: not found: {a[:60]!r}')
    open(p, 'w').write(s)
change('scripts/embed.cmake', [('namespace signorini {\\n\\nnamespace {\\n\\n', 'namespace signorini::base {\\nnamespace {\\n\\n'),
                               ('}  // namespace signorini\\n', '}  // namespace signorini::base\\n')])
change('scripts/includes.sh', [
    ('# folders, and the folders themselves; and where two headers define types of one name.', '# folders, and the folders themselves; and where two headers define types of one name in one namespace.'),
    ("""twice=$(grep -rhoE '^(struct|class) [A-Za-z]+( final)?( :.*)? \\{' --include='*.hpp' . ../include --exclude-dir=cli |
  sed -E 's/^(struct|class) ([A-Za-z]+).*/\\2/' | sort | uniq -d)""",
     """twice=$(find . ../include -name '*.hpp' -print0 | xargs -0 awk '
  /^namespace [a-z_:]+ \\{/ { space = $2 }
  /^(struct|class) [A-Za-z]+( final)?( :.*)? \\{/ { print space "::" $2 }' | sort | uniq -d)""")])
change('CONTRIBUTING.md', [
    ('are unique within a folder, and names of types in headers within the whole program (`scripts/includes.sh` checks the latter).',
     'are unique within a folder. Each folder of `src` has a namespace below `signorini`, mostly its own name (`src/linear`:\n'
     '`signorini::linear`); what `include/signorini` declares is in `signorini` itself. Names of types in headers are unique within\n'
     'their namespace (`scripts/includes.sh` checks this). Folders whose namespace has another name:\n'
     + ', '.join(f'`{a}`: `{b}`' for a, b in (l.split() for l in open(HERE + '/data/namespaces.txt') if not l.startswith('#'))
                 if os.path.basename(a) != b and os.path.isdir(a)) + '.')])
# A declaration that the qualifiers have wrapped is no function.
change('scripts/lengths.sh', [
    ("    !/^(  )?[^ #\\/]/ || /^ *(public|private|protected):/ { next }\n",
     "    !/^(  )?[^ #\\/]/ {\n      for (i = 0; i <= 2; i += 2)\n        if (first[i] && !opened[i]) { if (/\\{$/) opened[i] = 1; else if (/;$/) first[i] = 0 }\n      next\n    }\n    /^ *(public|private|protected):/ { next }\n"),
    ("      first[indent] = FNR\n", "      first[indent] = FNR\n      opened[indent] = /\\{$/\n")])
for l in open(HERE + '/data/comments.txt'):
    if l.startswith('#') or not l.strip(): continue
    f, a, b = l.rstrip('\n').split('\t')
    if os.path.exists(f): change(f, [(a, b)])
    else: print('note: comments.txt: no', f)
shutil.copy(HERE + '/words.sh', 'scripts/words.sh')
