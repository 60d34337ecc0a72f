"""The pages of `signorini report` in a headless Chromium.

page.py PROGRAM MODELS [PICTURES]     PICTURES: a folder for screenshots, to be looked at
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

from browser import Browser

program, models = pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()
work = pathlib.Path(tempfile.mkdtemp(prefix="signorini-page-"))
pictures = pathlib.Path(sys.argv[3]).resolve() if len(sys.argv) > 3 else work
pictures.mkdir(parents=True, exist_ok=True)
failed = []


def check(what, true):
    print(("ok    " if true else "WRONG ") + what)
    if not true:
        failed.append(what)


def signorini(*arguments):
    subprocess.run([program, *map(str, arguments)], check=True, capture_output=True, cwd=work)


def page_of(directory):
    signorini("report", directory)
    return work / directory / "report.html"


def rows(browser):
    return browser.run("return [...document.querySelectorAll('#events tbody tr')].filter(r => !r.hidden).length")


def time_shown(browser):
    return float(re.match(r"t = (\S+)", browser.run("return document.getElementById('now').textContent")).group(1))


def same(shown, t):
    """The line shows ten digits of a time."""
    return abs(shown - t) <= 1e-9 * abs(t)


def clean(browser, name):
    messages = browser.console()
    check(f"{name}: nothing in the console {messages}", messages == [])


def pipeline(browser):
    signorini("run", models / "pipeline.toml", "-o", "pipeline", "--quiet")
    path = page_of("pipeline")
    check(f"pipeline: {path.stat().st_size / 1e6:.2f} MB, less than 3", path.stat().st_size < 3e6)
    text = path.read_text()
    check("pipeline: no address but names of XML", set(re.findall(r"https?://[^\"'\s%]*", text)) <=
          {"http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"})
    browser.look()
    browser.open(path)
    clean(browser, "pipeline")
    paint = browser.run("return performance.getEntriesByName('first-contentful-paint')[0].startTime")
    check(f"pipeline: first paint after {paint:.0f} ms, less than 1000", paint < 1000 or os.getloadavg()[0] > 1.5)

    events = sorted({float(line.split(",")[0]) for line in (work / "pipeline/events.csv").read_text().splitlines()[1:]})
    check("pipeline: it begins at 0", time_shown(browser) == 0)
    browser.click("#next")
    check("a click steps to the first event", same(time_shown(browser), events[0]))
    browser.key("ArrowRight")
    check("a key steps to the second", same(time_shown(browser), events[1]))
    check("which is named", "first separation, slip- to open" in browser.run("return document.getElementById('now').textContent"))
    check("and holds: the contact is open", browser.run("return document.querySelector('#states tbody tr').cells[1].textContent") == "open")
    check("its row is marked", browser.run("return document.querySelector('tr.here').rowIndex") == 2)
    browser.key("ArrowLeft")
    check("and back", same(time_shown(browser), events[0]))
    browser.click("#previous")
    check("before the first event is the start", time_shown(browser) == 0)
    browser.key("End")
    check("End goes to the end", time_shown(browser) == 1.2)
    browser.key("Home")
    browser.run("document.activeElement.blur()")  # Space on a button presses it
    browser.key(" ")
    browser.wait_for("setTimeout(arguments[0], 600)")
    playing = time_shown(browser)
    browser.key(" ")
    check("Space plays", 0 < playing < 1.2)
    paused = time_shown(browser)
    browser.wait_for("setTimeout(arguments[0], 200)")
    check("and pauses", time_shown(browser) == paused)
    browser.run("document.getElementById('play').click()")
    before = browser.costs()
    frames = browser.wait_for("""const done = arguments[0]; let n = 0; const start = performance.now();
        const count = () => { if (performance.now() - start < 2000) { ++n; requestAnimationFrame(count); } else done(n / 2); };
        count();""")
    costs = {name: 1000 * (after - before[name]) / (2 * frames) for name, after in browser.costs().items()}
    browser.run("document.getElementById('play').click()")
    # Beside other work a picture comes seldom, and each has more to tell.
    free = os.getloadavg()[0] < 1.5
    check(f"{frames:.0f} pictures a second while it plays; of 16.7 ms one takes {costs['TaskDuration']:.2f} of processor time, "
          f"{costs['ScriptDuration']:.2f} of it in the script{'' if free else ' (beside other work)'}",
          costs["ScriptDuration"] < 3 and (not free or frames >= 57 and costs["TaskDuration"] < 6))
    still = browser.run("return document.querySelector('#stage .member:not(.bar)').getAttribute('d')")
    browser.run("player.stop(0.05)")
    check("the structure moves", still != browser.run("return document.querySelector('#stage .member:not(.bar)').getAttribute('d')"))
    check("contact first flies", browser.run("return document.querySelector('#states tbody tr').cells[1].textContent") == "open")
    browser.run("player.stop(0)")
    weight = browser.run("return [...document.querySelectorAll('#states tbody tr')].map(r => +r.cells[2].textContent)")
    check(f"at rest contacts carry the weight, 24 m of 0.4 t/m {weight}", abs(sum(weight) + 24 * 0.4 * 9.81) < 1e-2)

    everything = rows(browser)
    browser.run("const s = document.getElementById('byContact'); s.value = 'second'; s.dispatchEvent(new Event('change'))")
    second = rows(browser)
    browser.run("const s = document.getElementById('byType'); s.value = 'separation'; s.dispatchEvent(new Event('change'))")
    lines = (work / "pipeline/events.csv").read_text().splitlines()[1:]
    check("filters filter", (everything, second, rows(browser)) == (
        len(lines), sum(",second," in line for line in lines), sum(",second,separation," in line for line in lines)))
    browser.run("document.querySelectorAll('#events tbody tr:not([hidden])')[1].click()")
    chosen = [float(line.split(",")[0]) for line in lines if ",second,separation," in line][1]
    check("a click on a row goes to its event", same(time_shown(browser), chosen))
    charts(browser)
    looks(browser)
    check("pictures are there", browser.run("return [...document.images].every(i => i.complete || i.loading === 'lazy')"))
    noise = browser.run("""return [...document.querySelectorAll('#events td.n')].filter((cell, k) =>
        cell.textContent.startsWith('-0') && Number(cell.textContent) === 0).length""")
    check(f"no negative zero among the events ({noise})", noise == 0)
    check("units stand in the header of the events", "N [kN]" in browser.run("return document.querySelector('#events thead').textContent"))
    check("the colours of states are named", "stick" in browser.run("return document.getElementById('legend').textContent"))
    apart = browser.run("""player.stop(0); const far = (m) => { const s = byId('scale'); s.value = m; s.dispatchEvent(new Event('change'));
        return document.querySelector('#stage .ground').getAttribute('d'); };
        const [all, one] = [[...byId('scale').options].map((o) => o.value), byId('scale').value];
        const paths = [far(all[0]), far(all[all.length - 1])]; far(one); return paths""")
    check("grounds are drawn as far off as the motion is magnified", apart[0] != apart[1])
    clean(browser, "pipeline, used")


def charts(browser):
    first = browser.run("return document.querySelector('main section').id")
    check(f"the page opens with support loads ({first})", first == "loads")
    order = browser.run("return [...document.querySelectorAll('main section')].map(s => s.id)")
    check(f"events come after charts and motion {order}", order.index("chartSection") < order.index("motion") < order.index("events"))
    check("charts of N, T and displacements", browser.run("return document.querySelectorAll('.chart canvas').length") >= 3)
    point = """const c = document.querySelector('.chart canvas'), box = c.getBoundingClientRect(), left = charts.list[0].left, right = 10;
        const at = (part) => box.left + left + part * (box.width - left - right);
        const send = (type, part) => c.dispatchEvent(new PointerEvent(type, { clientX: at(part), clientY: box.top + 20, button: 0,
            pointerId: 1, pointerType: 'mouse', bubbles: true }));
        c.setPointerCapture = () => {};"""
    browser.run("document.getElementById('chartSection').scrollIntoView(); player.stop(0)")
    browser.run(point + "send('pointermove', 0.5)")
    check("the pointer over a chart is the cursor of the motion", abs(time_shown(browser) - 0.6) < 0.01)
    read = browser.run("return [...document.querySelectorAll('.chart')].slice(0, 2).map(c => +c.querySelector('.names output').textContent)")
    exact = browser.run("const m = data.contacts[0].motion; return [valueAt(m.t, m.N, player.t), valueAt(m.t, m.T, player.t)]")
    check(f"and reads N and T {read}", all(abs(a - b) <= 1e-4 * max(1, abs(b)) for a, b in zip(read, exact)))
    browser.run("player.stop(0.3)")
    where = browser.run("return [...document.querySelectorAll('.cursor')].map(c => c.style.transform)")
    check(f"an event or the slider moves the cursor of all charts {where[:2]}", len(set(where[:2])) == 1 and "translateX" in where[0])
    browser.run(point + "send('pointerdown', 0.25); send('pointermove', 0.5); send('pointerup', 0.5)")
    shown = browser.run("return [charts.from, charts.to]")
    check(f"a drag chooses times {shown}", abs(shown[0] - 0.3) < 0.01 and abs(shown[1] - 0.6) < 0.01)
    browser.click("#closer")
    closer = browser.run("return charts.to - charts.from")
    check("closer is closer", abs(closer - (shown[1] - shown[0]) / 2) < 1e-6)
    browser.run("document.querySelector('.chart canvas').dispatchEvent(new MouseEvent('dblclick'))")
    check("a double click shows all", browser.run("return [charts.from, charts.to]") == [0, 1.2])
    browser.run("document.querySelector('td[data-t]').click()")
    check("a time of a table goes there", browser.run("return player.t === Number(document.querySelector('td[data-t]').dataset.t)"))


def everywhere(browser, name, whole=True):
    """What every page keeps in every light and width; `whole`: a picture of the whole page for each."""
    for scheme in ("light", "dark"):
        for kind, width in (("wide", 1200), ("narrow", 390)):
            browser.look(scheme, width)
            browser.wait_for("setTimeout(arguments[0], 150)")
            where = f"{name}, {scheme}, {kind}"
            wider = browser.run("return document.documentElement.scrollWidth - window.innerWidth")
            check(f"{where}: nothing stands out to the side ({wider})", wider <= 0)
            cut = browser.run("""const plan = document.getElementById('plan'); if (!plan) return [];
                const out = plan.getBoundingClientRect();
                return [...plan.querySelectorAll('text')].filter(label => { const box = label.getBoundingClientRect();
                  return box.left < out.left || box.right > out.right || box.top < out.top || box.bottom > out.bottom; })
                  .map(label => label.textContent);""")
            check(f"{where}: no label of the drawing is cut {cut}", cut == [])
            over = browser.run("""const labels = [...document.querySelectorAll('#plan text')].map(t => [t.textContent, t.getBoundingClientRect()]);
                const found = []; labels.forEach(([a, p], i) => labels.slice(0, i).forEach(([b, q]) => {
                  if (Math.min(p.right, q.right) - Math.max(p.left, q.left) > 1 && Math.min(p.bottom, q.bottom) - Math.max(p.top, q.top) > 4)
                    found.push(a + ' / ' + b); }));
                return found;""")
            check(f"{where}: labels of the drawing do not overlap {over[:3]}", over == [])
            empty = browser.run("""return [...document.querySelectorAll('.chart')].filter(chart => {
                const canvas = chart.querySelector('canvas'); if (!canvas || !canvas.width) return true;
                const blank = document.createElement('canvas'); blank.width = canvas.width; blank.height = canvas.height;
                return canvas.toDataURL() === blank.toDataURL(); }).map(chart => chart.textContent.slice(0, 40));""")
            check(f"{where}: no chart is empty {empty[:3]}", empty == [])
            faint = browser.run("""const light = (c) => { const v = c.match(/[\\d.]+/g).map(Number).slice(0, 3).map(x => x / 255)
                  .map(x => x <= 0.04045 ? x / 12.92 : ((x + 0.055) / 1.055) ** 2.4); return 0.2126 * v[0] + 0.7152 * v[1] + 0.0722 * v[2]; };
                const paper = light(getComputedStyle(document.body).backgroundColor);
                return [...document.querySelectorAll('h1, h2, h3, p, th, td, label, figcaption')].filter(e => e.textContent.trim()).map(e => {
                  let b = e; while (b && /rgba\\(0, 0, 0, 0\\)/.test(getComputedStyle(b).backgroundColor)) b = b.parentElement;
                  const ground = b ? light(getComputedStyle(b).backgroundColor) : paper, ink = light(getComputedStyle(e).color);
                  return [(Math.max(ground, ink) + 0.05) / (Math.min(ground, ink) + 0.05), e.textContent.slice(0, 30)]; })
                  .filter(([ratio]) => ratio < 4.5).slice(0, 3);""")
            check(f"{where}: text stands out from its ground {faint}", faint == [])
            if whole:
                browser.screenshot(pictures / f"{name}-{scheme}-{kind}.png", whole=True)
    browser.look("light", 800, media="print")
    buttons = browser.run("return [...document.querySelectorAll('.buttons button, .filters, .hint')].filter(b => b.offsetParent !== null).length")
    check(f"{name}, printed: no buttons ({buttons})", buttons == 0)
    stuck = browser.run("return [...document.querySelectorAll('th')].filter(th => getComputedStyle(th).position === 'sticky').length")
    check(f"{name}, printed: no heading covers rows ({stuck})", stuck == 0)
    if whole:
        browser.screenshot(pictures / f"{name}-print.png", whole=True)
    browser.look()


def looks(browser):
    browser.run("player.stop(0.06)")
    everywhere(browser, "pipeline")
    browser.look("dark")
    paper = browser.run("return getComputedStyle(document.body).backgroundColor")
    browser.look("light")
    check(f"dark is dark ({paper})", paper == "rgb(21, 24, 28)" and
          browser.run("return getComputedStyle(document.body).backgroundColor") == "rgb(255, 255, 255)")
    browser.look()


def bodies(browser):
    signorini("run", models / "dry-joint.toml", "-o", "joint", "--quiet")
    path = page_of("joint")
    check(f"dry-joint: {path.stat().st_size / 1e6:.2f} MB, less than 3", path.stat().st_size < 3e6)
    browser.look()
    browser.open(path)
    clean(browser, "dry-joint")
    # Where the page draws the nodes of the mesh beside what frame_bodies.csv says of them, at the magnification of the page.
    rows = [line.split(",") for line in (work / "joint/frame_bodies.csv").read_text().splitlines()[1:]]
    late = [row for row in rows if float(row[0]) == 0.12]
    drawn = browser.run("""player.stop(0.12); const u = displacementsAt(0.12);
        return data.nodes.map((node, k) => [node.name, u[k][0], u[k][1]]);""")
    places = {name: (x, y) for name, x, y in drawn}
    size = max(max(abs(float(row[5])), abs(float(row[6]))) for row in late)
    off = max(max(abs(places[row[2]][0] - float(row[5])), abs(places[row[2]][1] - float(row[6]))) for row in late)
    check(f"dry-joint: the mesh moves with the blocks, {off / size:.1e} of the greatest displacement off", size > 0 and off < 0.01 * size)
    paths = browser.run("""const at = (t) => { player.stop(t); return document.querySelector('#stage > g:not(.ghost) .mesh').getAttribute('d'); };
        return [at(0), at(0.12)]""")
    check("dry-joint: and is drawn there", paths[0] != paths[1])
    colours = browser.run("""player.stop(0.12); return [...document.querySelectorAll('#stage circle')].map(c => c.getAttribute('fill'))""")
    check(f"dry-joint: nodes of the seam have the colour of their state {set(colours)}", len(colours) == 15 and len(set(colours)) == 1 and
          colours[0] == browser.run("return data.states.find(([name]) => name === 'slip-')[1]"))
    marks = browser.run("""const at = [...document.querySelectorAll('#stage circle')].map(c => [+c.getAttribute('cx'), +c.getAttribute('r')])
        .sort((a, b) => a[0] - b[0]); return Math.min(...at.slice(1).map(([x, r], k) => x - at[k][0] - r - at[k][1]))""")
    check(f"dry-joint: marks along the seam do not cover each other ({marks:.1f} px)", marks > -1)
    browser.screenshot(pictures / "dry-joint-moved.png", whole=True)


def hostile(browser):
    names = ["<script>owned()</script>", "%s%n", "a&amp", "</script>", "@script@", "`x`$(y)"]
    text = 'schema = 1\ntitle = "</title><script>window.owned=1</script> %s \' @data@ <!--"\n'
    text += 'units = { force = "N", mass = "kg", length = "m", time = "s" }\ngravity = [0.0, -9.81]\n[run]\nt_end = 0.3\n[nodes]\n'
    text += "".join(f'"{name}" = [{i}.0, 0.0]\n' for i, name in enumerate(names))
    for i, name in enumerate(names):
        text += f'[[masses]]\nnode = "{name}"\nmass = 1.0\n[[contacts]]\nname = "{name}"\nnode = "{name}"\nlaw = "rigid"\n'
        text += f'normal = [0.0, 1.0]\ngap = {0.01 * (i + 1)}\nfriction = 0.3\nrestitution = 0.3\n'
    (work / "hostile.toml").write_text(text)
    signorini("run", "hostile.toml", "-o", "hostile", "--quiet")
    browser.open(page_of("hostile"))
    clean(browser, "hostile names")
    check("hostile names are not run", browser.run("return window.owned === undefined"))
    check("and stand as they are", browser.run("return [...document.querySelectorAll('#states tbody tr')].map(r => r.cells[0].textContent)") == names)
    check("the title, too", browser.run("return document.title") == "</title><script>window.owned=1</script> %s ' @data@ <!--")
    browser.click("#next")
    check("and events are named", "contact" in browser.run("return document.getElementById('now').textContent") or
          "impact" in browser.run("return document.getElementById('now').textContent"))


def others(browser):
    belt = models / "belt.toml"
    signorini("run", models / "matrices.toml", "-o", "matrices", "--quiet", "--no-plots")
    signorini("compare", belt, "--engines", "exact,ida", "-o", "compared", "--quiet", "--set", "run.t_end=20")
    signorini("sweep", belt, "--vary", "contacts.belt.friction.static=1.2:1.6:0.2", "-o", "swept", "--quiet", "--set", "run.t_end=20")
    signorini("study", belt, "--engines", "exact,ida", "--rtol", "1e-6,1e-7", "--repeats", "1", "-o", "studied", "--quiet",
              "--set", "run.t_end=10")
    subprocess.run([program, "verify", belt, "-o", "verified", "--quiet", "--set", "run.t_end=10", "--set", "run.dt=1e-2"], cwd=work)
    for name, tables in (("matrices", 3), ("compared", 4), ("swept", 1), ("studied", 1), ("verified", 1)):
        browser.open(page_of(name))
        clean(browser, name)
        count = browser.run("return document.querySelectorAll('table').length")
        check(f"{name}: {count} tables", count >= tables)
        everywhere(browser, name)
    signorini("run", models / "pipeline.toml", "-o", "soft", "--quiet", "--no-plots", "--set", "contacts.*.friction=0.1")
    signorini("report", "pipeline", "soft", "-o", "cases.html")
    browser.open(work / "cases.html")
    clean(browser, "load cases")
    check("load cases: support loads of both", browser.run("return document.querySelectorAll('#loads tbody tr').length") == 14)
    everywhere(browser, "cases")
    for name in sorted(p.name for p in models.glob("*.toml")):
        if name in ("pipeline.toml", "matrices.toml"):
            continue
        signorini("run", models / name, "-o", name + "-run", "--quiet", "--no-plots")
        browser.open(page_of(name + "-run"))
        clean(browser, name)
        browser.click("#next")
        everywhere(browser, pathlib.Path(name).stem)


browser = Browser()
try:
    pipeline(browser)
    hostile(browser)
    bodies(browser)
    others(browser)
finally:
    browser.close()
print(f"{len(failed)} wrong; screenshots in {pictures}")
sys.exit(1 if failed else 0)
