// player.js: plays, pauses and steps from event to event.
class Player {
  constructor() {
    this.last = data.curve.times.reduce((last, t) => t.length ? Math.max(last, t[t.length - 1]) : last, 0);
    this.times = [...new Set(data.events.map((event) => event[0]))].filter((t) => t <= this.last);
    this.t = 0;
    this.playing = false;
    this.scales();
    this.shapes();
    this.bands();
    this.legend();
    this.table();
    this.controls();
    this.show(0);
    window.addEventListener("resize", () => {
      plan();
      this.shapes();
      this.bands();
      this.show(this.t);
    });
    byId("bands").addEventListener("click", (event) => {
      const box = byId("bands").getBoundingClientRect();
      this.stop(this.last * (event.clientX - box.left) / box.width);
    });
  }
  scales() {
    const fit = this.magnification = data.magnification;
    for (const factor of [...new Set([1, fit / 10, fit / 2, fit, 2 * fit, 10 * fit])].sort((a, b) => a - b)) {
      const option = document.createElement("option");
      option.value = factor;
      option.textContent = Number(factor.toPrecision(3)).toString();
      option.selected = factor === fit;
      byId("scale").append(option);
    }
  }
  shapes() {
    this.stage = new Stage(byId("stage"));
    const svg = this.stage.svg, still = data.nodes.map(() => [0, 0, 0]);
    const ghost = drawn("g", { class: "ghost" }, svg), g = drawn("g", {}, svg);
    this.stage.fixed(g, this.magnification);
    if (data.mesh.length) drawn("path", { class: "mesh", d: this.stage.mesh(still, 0) }, ghost);
    for (const piece of data.pieces) drawn("path", { class: "member bar", d: this.stage.piece(piece, still, 0) }, ghost);
    this.springShapes = data.springs.map(() => drawn("path", { class: "spring" }, g));
    this.touchShapes = data.contacts.map((c) => c.against.length && c.node >= 0 ? drawn("path", { class: "spring" }, g) : null);
    this.mesh = drawn("path", { class: "mesh" }, g);
    this.members = drawn("path", { class: "member" }, g);
    this.bars = drawn("path", { class: "member bar" }, g);
    this.nodes = drawn("path", { class: "dots", "stroke-width": data.nodes.length <= 40 ? 6 : 3 }, g);
    this.loads = data.loads.map(() => drawn("path", { class: "load" }, g));
    this.marks = data.contacts.map((contact) => drawn("circle",
      { r: contact.node < 0 ? 0 : Math.max(1.5, Math.min(7, this.stage.mark / 2, 0.5 * this.stage.room(contact))) }, g));
    this.forces = data.contacts.map((contact) => drawn("path",  // on top, so that arrow heads are visible
      { class: "force", "stroke-width": Math.max(1, Math.min(3, 0.4 * this.stage.room(contact))) }, g));
    this.greatest = 1e-300;
    for (const { motion } of data.contacts)
      motion.N.forEach((N, i) => { this.greatest = Math.max(this.greatest, Math.hypot(N, motion.T[i])); });
    this.greatestGap = 0;
    for (const { motion } of data.contacts) for (const g of motion.gap) this.greatestGap = Math.max(this.greatestGap, Math.abs(g));
    this.greatestLoad = data.loads.map((load) => Math.max(1e-300, ...load.f.map(Math.abs)));
  }
  // Legend of the states that occur.
  legend() {
    const occurring = new Set(data.contacts.flatMap((contact) => contact.motion.state));
    data.states.forEach(([name, colour], k) => {
      if (!occurring.has(k)) return;
      const entry = document.createElement("span"), chip = document.createElement("span");
      chip.className = "chip";
      chip.style.background = colour;
      entry.append(chip, name);
      byId("legend").append(entry);
    });
  }
  // The states of the first 24 contacts over time, one path per state and contact.
  bands() {
    const svg = byId("bands"), height = 16, shown = data.contacts.slice(0, 24);
    svg.replaceChildren();
    this.wide = Math.max(300, svg.clientWidth);
    svg.setAttribute("viewBox", `0 0 ${this.wide} ${height * shown.length + 2}`);
    const x = (t) => this.last > 0 ? this.wide * t / this.last : 0;
    shown.forEach((contact, row) => {
      const paths = data.states.map(() => ""), { t, state } = contact.motion;
      for (let i = 0, from = 0; i < t.length; ++i) {
        if (i + 1 < t.length && state[i + 1] === state[from]) continue;
        const end = i + 1 < t.length ? t[i + 1] : this.last;
        paths[state[from]] += `M${x(t[from]).toFixed(2)} ${row * height + 1}H${x(end).toFixed(2)}v${height - 3}H${x(t[from]).toFixed(2)}z`;
        from = i + 1;
      }
      paths.forEach((d, k) => { if (d) drawn("path", { d, fill: data.states[k][1] }, svg); });
      drawn("text", { x: 4, y: row * height + 12 }, svg, contact.name);
    });
  }
  table() {
    const body = byId("states").tBodies[0], [force, length] = data.units;
    byId("unitN").textContent = `N [${force}]`;
    byId("unitT").textContent = `T [${force}]`;
    byId("unitg").textContent = `gap [${length}]`;
    this.rows = data.contacts.slice(0, 24).map((contact) => {
      const row = body.insertRow(), name = row.insertCell(), state = row.insertCell();
      const chip = document.createElement("span");
      chip.className = "chip";
      name.append(chip, contact.name);
      const cells = [0, 1, 2].map(() => { const cell = row.insertCell(); cell.className = "n"; return cell; });
      return { chip, state, cells };
    });
  }
  controls() {
    const on = (id, act) => byId(id).addEventListener("click", act);
    on("first", () => this.stop(0));
    on("last", () => this.stop(this.last));
    on("previous", () => this.step(-1));
    on("next", () => this.step(1));
    on("play", () => this.toggle());
    byId("time").addEventListener("input", (event) => this.stop(this.last * event.target.value));
    byId("scale").addEventListener("change", (event) => {
      this.magnification = Number(event.target.value);
      this.shapes();
      this.show(this.t);
    });
    document.addEventListener("keydown", (event) => {
      const kind = event.target.tagName;
      if (event.ctrlKey || event.altKey || event.metaKey || kind === "SELECT" || kind === "BUTTON" && event.key === " ") return;
      const acts = { ArrowRight: () => this.step(1), ArrowLeft: () => this.step(-1), " ": () => this.toggle(),
        Home: () => this.stop(0), End: () => this.stop(this.last) };
      if (!acts[event.key]) return;
      event.preventDefault();
      acts[event.key]();
    });
  }
  stop(t) {
    this.playing = false;
    this.show(t);
  }
  step(direction) {
    const row = rowAt(this.times, this.t), exact = row >= 0 && this.times[row] === this.t;
    const next = direction > 0 ? row + 1 : exact ? row - 1 : row;
    this.stop(next < 0 ? 0 : next < this.times.length ? this.times[next] : this.last);
  }
  toggle() {
    this.playing = !this.playing;
    if (this.playing && this.t >= this.last) this.t = 0;
    this.before = this.shownAt = undefined;
    if (this.playing) requestAnimationFrame((now) => this.frame(now));
    this.show(this.t);
  }
  frame(now) {
    if (!this.playing) return;
    const passed = this.before === undefined ? 0 : Math.min(0.1, (now - this.before) / 1000);
    this.before = now;
    const t = this.t + passed * this.last / Number(byId("speed").value);
    if (t >= this.last) this.playing = false;
    this.show(Math.min(t, this.last));
    if (this.playing) requestAnimationFrame((next) => this.frame(next));
  }
  show(t) {
    this.t = Math.min(Math.max(t, 0), this.last);
    const u = displacementsAt(this.t), m = this.magnification, stage = this.stage;
    let beams = "", bars = "";
    for (const piece of data.pieces) if (piece.bar) bars += stage.piece(piece, u, m); else beams += stage.piece(piece, u, m);
    if (data.mesh.length) put(this.mesh, "d", stage.mesh(u, m));
    put(this.members, "d", beams);
    put(this.bars, "d", bars);
    let dots = "";
    data.nodes.forEach((node, k) => {
      if (node.mesh) return;
      const [x, y] = stage.place(k, u, m);
      dots += `M${x.toFixed(1)} ${y.toFixed(1)}h0`;
    });
    put(this.nodes, "d", dots);
    data.springs.forEach((spring, k) => put(this.springShapes[k], "d", stage.spring(spring, u, m)));
    data.loads.forEach((load, k) => {
      const size = 70 * valueAt(load.t, load.f, this.t) / this.greatestLoad[k];
      put(this.loads[k], "d", stage.arrow(stage.place(load.node, u, m), size * load.dx, size * load.dy, false));
    });
    // During play numbers are updated only ten times per second, since faster ones cannot be read.
    // At a node with several contacts, a closed one determines the dot's colour.
    const closed = new Set(data.contacts.filter((contact) => this.stateOf(contact) !== "open").map((contact) => contact.node));
    const now = performance.now(), updatesValues = !this.playing || !(now - this.shownAt < 100);
    if (updatesValues) this.shownAt = now;
    data.contacts.forEach((contact, k) => {
      this.contact(contact, k, u, m, updatesValues);
      put(this.marks[k], "visibility", closed.has(contact.node) && this.stateOf(contact) === "open" ? "hidden" : "visible");
    });
    byId("needle").style.transform = `translateX(${(this.last > 0 ? this.wide * this.t / this.last : 0).toFixed(1)}px)`;
    if (updatesValues) this.showValues();
    if (window.charts) window.charts.read(this.t, updatesValues);
  }
  stateOf({ motion: { t, state } }) {
    return t.length ? data.states[state[Math.max(0, rowAt(t, this.t))]]?.[0] : "open";
  }
  // A rounding error, compared with the greatest value of its kind, is shown as zero.
  figure(x, digits, greatest) {
    return Math.abs(x) <= 2.2e-13 * greatest ? "0" : x.toPrecision(digits);
  }
  contact(contact, k, u, m, updatesValues) {
    const { t, state, N, T, gap } = contact.motion;
    if (!t.length) return;
    const [name, colour] = data.states[state[Math.max(0, rowAt(t, this.t))]] || ["", "#999999"];
    const n = valueAt(t, N, this.t), s = valueAt(t, T, this.t);
    if (contact.node >= 0) {
      const [x, y] = this.stage.place(contact.node, u, m), size = 90 / this.greatest;
      put(this.marks[k], "cx", x.toFixed(1));
      put(this.marks[k], "cy", y.toFixed(1));
      put(this.marks[k], "fill", colour);
      // Force on the structure: -N n - T t, t = (ny, -nx); it points to the node.
      const fx = -n * contact.nx - s * contact.ny, fy = -n * contact.ny + s * contact.nx;
      put(this.forces[k], "d", this.stage.arrow([x, y], size * fx, size * fy, false));
      put(this.forces[k], "stroke", colour);
      if (this.touchShapes[k]) put(this.touchShapes[k], "d", this.stage.touched(contact, u, m));
    }
    const row = this.rows[k];
    if (!row || !updatesValues) return;
    const g = valueAt(t, gap, this.t);
    row.chip.style.background = colour;
    row.state.textContent = name;
    row.cells[0].textContent = this.figure(n, 5, this.greatest);
    row.cells[1].textContent = this.figure(s, 5, this.greatest);
    row.cells[2].textContent = contact.slider || gap[0] === null ? "" : this.figure(g, 4, this.greatestGap);
  }
  showValues() {
    const row = rowAt(this.times, this.t), exact = row >= 0 && this.times[row] === this.t;
    let text = `t = ${Number(this.t.toPrecision(exact ? 10 : 6))} ${data.units[2]}`;
    if (exact) {
      const here = data.events.filter((event) => event[0] === this.t);
      text += ": " + here.map(([, k, event, from, to]) =>
        k < 0 ? "a load jumps" : `${data.contacts[k].name} ${event}, ${from} to ${to}`).join("; ");
    }
    byId("now").textContent = text;
    byId("time").value = this.last > 0 ? this.t / this.last : 0;
    byId("play").textContent = this.playing ? "Pause" : "Play";
    if (this.onShow) this.onShow(exact ? this.t : null);
  }
}
