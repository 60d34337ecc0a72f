// charts.js: curves over time on canvases. All charts share the time window and the cursor, which is the player's time.
// Colours on paper, and on a dark background.
const palette = [["#2166ac", "#6aaef0"], ["#c0182b", "#ff7b7b"], ["#1b7837", "#5fc97e"], ["#b35806", "#f0a350"],
  ["#762a83", "#c792d8"], ["#008080", "#4fd0d0"], ["#a0508a", "#f0a8dc"], ["#525252", "#b0b0b0"]];
const darkGround = matchMedia("(prefers-color-scheme: dark)");

// Round tick values from low to high, about `count` of them.
const ticksOf = (low, high, count) => {
  const rough = (high - low) / count, ten = 10 ** Math.floor(Math.log10(rough)), digit = rough / ten;
  const step = (digit < 1.5 ? 1 : digit < 3.5 ? 2 : digit < 7.5 ? 5 : 10) * ten, ticks = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) ticks.push(k * step);
  return ticks;
};
const tickText = (value, step) => {
  if (Math.abs(value) < 1e-9 * step) return "0";
  return Math.abs(value) >= 1e5 || step < 1e-4 ? Number(value.toPrecision(6)).toExponential() : String(Number(value.toPrecision(8)));
};

// One chart. series: { name, t, y } each; y may hold null.
class Chart {
  constructor(charts, title, unit, series) {
    this.charts = charts;
    this.series = series.map((one) => ({ ...one }));
    // At first, the curves with the largest ranges are shown.
    const spans = this.series.map((one) => {
      let low = Infinity, high = -Infinity;
      for (const y of one.y) if (y !== null) { low = Math.min(low, y); high = Math.max(high, y); }
      return high - low;
    });
    const order = spans.map((_, k) => k).sort((a, b) => spans[b] - spans[a]), most = Math.max(...spans);
    // If no curve changes by more than rounding errors, the curves with the largest values are shown.
    const sizes = this.series.map((one) => one.y.reduce((size, y) => Math.max(size, Math.abs(y ?? 0)), 0));
    const still = !(most > 1e-9 * Math.max(...sizes));
    if (still) order.sort((a, b) => sizes[b] - sizes[a] || a - b);
    order.forEach((k, place) => {
      this.series[k].colours = palette[place % palette.length];
      this.series[k].dash = place >= palette.length;
    });
    this.series.forEach((one, k) => { one.shown = order.indexOf(k) < 6 && (still || spans[k] > 1e-9 * most || series.length <= 6); });
    this.figure = document.createElement("figure");
    this.figure.className = "chart";
    const head = document.createElement("figcaption");
    head.textContent = unit ? `${title} [${unit}]` : title;
    this.area = document.createElement("div");
    this.area.className = "area";
    this.canvas = document.createElement("canvas");
    this.canvas.setAttribute("role", "img");
    this.canvas.setAttribute("aria-label", `${head.textContent} over time`);
    this.cursor = document.createElement("div");
    this.cursor.className = "cursor";
    this.chosen = document.createElement("div");
    this.chosen.className = "chosen";
    this.area.append(this.canvas, this.cursor, this.chosen);
    this.names = document.createElement("p");
    this.names.className = "names";
    for (const one of this.series) this.legend(one);
    this.figure.append(head, this.area, this.names);
    this.listen();
  }
  legend(one) {
    const button = document.createElement("button"), chip = document.createElement("span");
    button.type = "button";
    button.setAttribute("aria-pressed", one.shown);
    button.title = "show or hide";
    chip.className = "chip";
    one.chip = chip;
    one.value = document.createElement("output");
    button.append(chip, one.name, " ", one.value);
    button.addEventListener("click", () => {
      one.shown = !one.shown;
      button.setAttribute("aria-pressed", one.shown);
      this.draw();
      this.read(this.charts.player.t);
    });
    this.names.append(button);
  }
  // A drag selects a time window, a double click shows everything; the cursor follows the pointer.
  listen() {
    const timeOf = (event) => {
      const box = this.canvas.getBoundingClientRect();
      const x = Math.min(1, Math.max(0, (event.clientX - box.left - this.left) / (box.width - this.left - this.right)));
      return this.charts.from + x * (this.charts.to - this.charts.from);
    };
    this.canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      this.began = { t: timeOf(event), x: event.offsetX };
      this.canvas.setPointerCapture(event.pointerId);
    });
    this.canvas.addEventListener("pointermove", (event) => {
      if (!this.began) {
        if (event.pointerType === "mouse" && !this.charts.player.playing) this.charts.player.show(timeOf(event));
        return;
      }
      const [a, b] = [this.began.x, event.offsetX].sort((p, q) => p - q);
      this.chosen.style.cssText = `display: block; left: ${a}px; width: ${b - a}px`;
    });
    const end = (event) => {
      if (!this.began) return;
      const began = this.began, t = timeOf(event);
      this.began = null;
      this.chosen.style.display = "none";
      if (event.type === "pointercancel") return;
      if (Math.abs(event.offsetX - began.x) > 5) this.charts.zoom(Math.min(began.t, t), Math.max(began.t, t));
      else this.charts.player.stop(t);
    };
    this.canvas.addEventListener("pointerup", end);
    this.canvas.addEventListener("pointercancel", end);
    this.canvas.addEventListener("dblclick", () => this.charts.zoom(0, this.charts.last));
  }
  range() {
    const { from, to } = this.charts;
    let low = Infinity, high = -Infinity;
    for (const one of this.series) {
      if (!one.shown) continue;
      const first = Math.max(0, rowAt(one.t, from)), last = Math.min(one.t.length - 1, rowAt(one.t, to) + 1);
      for (let i = first; i <= last; ++i) {
        const y = one.y[i];
        if (y !== null) { low = Math.min(low, y); high = Math.max(high, y); }
      }
    }
    if (!(low <= high)) return [0, 1];
    const least = 1e-12 * Math.max(Math.abs(low), Math.abs(high));
    if (!(high - low > least)) return [low - (Math.abs(low) || 1) * 0.1, high + (Math.abs(high) || 1) * 0.1];
    return [low - 0.05 * (high - low), high + 0.05 * (high - low)];
  }
  draw() {
    const box = this.area.getBoundingClientRect(), wide = Math.max(240, box.width), high = wide < 500 ? 170 : 210;
    const scale = Math.max(1, window.devicePixelRatio || 1), { from, to } = this.charts;
    this.canvas.width = Math.round(wide * scale);
    this.canvas.height = Math.round(high * scale);
    this.canvas.style.height = `${high}px`;
    const pen = this.canvas.getContext("2d");
    pen.setTransform(scale, 0, 0, scale, 0, 0);
    pen.clearRect(0, 0, wide, high);
    const [bottom, top] = this.range(), styles = getComputedStyle(document.documentElement);
    const colour = (name, print) => this.charts.printed ? print : styles.getPropertyValue(name).trim();
    const ink = colour("--ink", "#000"), pale = colour("--pale", "#444"), line = colour("--line", "#bbb");
    pen.font = '12px system-ui, "DejaVu Sans", sans-serif';
    const ys = ticksOf(bottom, top, 4), step = ys.length > 1 ? ys[1] - ys[0] : 1, texts = ys.map((y) => tickText(y, step));
    this.left = 8 + Math.max(...texts.map((text) => pen.measureText(text).width), 48);  // equal in most charts
    this.right = 10;
    const below = 20, above = 6, X = (t) => this.left + (t - from) / (to - from) * (wide - this.left - this.right);
    const Y = (y) => above + (top - y) / (top - bottom) * (high - above - below);
    this.X = X;
    pen.lineWidth = 1;
    pen.fillStyle = pale;
    pen.textBaseline = "middle";
    pen.textAlign = "right";
    ys.forEach((y, k) => {
      pen.strokeStyle = line;
      pen.beginPath();
      pen.moveTo(this.left, Y(y));
      pen.lineTo(wide - this.right, Y(y));
      pen.stroke();
      pen.fillText(texts[k], this.left - 5, Y(y));
    });
    pen.textAlign = "center";
    pen.textBaseline = "alphabetic";
    const ts = ticksOf(from, to, Math.max(3, Math.floor(wide / 110))), stepT = ts.length > 1 ? ts[1] - ts[0] : 1;
    for (const t of ts) {
      const text = tickText(t, stepT), half = pen.measureText(text).width / 2;
      pen.fillText(text, Math.min(wide - half - 1, X(t)), high - 5);
      pen.strokeStyle = line;
      pen.beginPath();
      pen.moveTo(X(t), above);
      pen.lineTo(X(t), high - below);
      pen.stroke();
    }
    // Dotted lines at the events, if there are at most 80.
    const events = this.charts.player.times.filter((t) => t >= from && t <= to);
    if (events.length <= 80) {
      pen.strokeStyle = pale;
      pen.setLineDash([1, 3]);
      pen.beginPath();
      for (const t of events) { pen.moveTo(X(t), above); pen.lineTo(X(t), high - below); }
      pen.stroke();
      pen.setLineDash([]);
    }
    pen.save();
    pen.beginPath();
    pen.rect(this.left, 0, wide - this.left - this.right, high - below + 1);
    pen.clip();
    for (const one of this.series) {
      one.colour = one.colours[darkGround.matches && !this.charts.printed ? 1 : 0];
      one.chip.style.background = one.colour;
      if (one.shown) this.curve(pen, one, X, Y);
    }
    pen.restore();
    pen.strokeStyle = ink;
    pen.strokeRect(this.left, above, wide - this.left - this.right, high - above - below);
  }
  // Draws the first, smallest, largest and last of the rows in one pixel.
  curve(pen, one, X, Y) {
    const { from, to } = this.charts, first = Math.max(0, rowAt(one.t, from) - 1);
    pen.strokeStyle = one.colour;
    pen.lineWidth = 1.6;
    pen.setLineDash(one.dash ? [6, 3] : []);
    pen.beginPath();
    let column = null, low = 0, high = 0, drawn = false;
    const flush = () => { if (column !== null && low !== high) { pen.moveTo(column, Y(low)); pen.lineTo(column, Y(high)); } };
    for (let i = first; i < one.t.length; ++i) {
      const y = one.y[i], x = X(one.t[i]);
      if (y === null) { drawn = false; continue; }
      if (drawn) pen.lineTo(x, Y(y)); else pen.moveTo(x, Y(y));
      drawn = true;
      const pixel = Math.round(x);
      if (pixel === column) { low = Math.min(low, y); high = Math.max(high, y); } else { column = pixel; low = high = y; }
      if (one.t[i] > to) break;
    }
    flush();
    pen.stroke();
    pen.setLineDash([]);
  }
  // Moves the cursor to t; updatesValues: also shows the values at t.
  read(t, updatesValues = true) {
    const inside = t >= this.charts.from && t <= this.charts.to;
    this.cursor.style.display = inside ? "block" : "none";
    if (inside && this.X) this.cursor.style.transform = `translateX(${this.X(t).toFixed(1)}px)`;
    if (!updatesValues) return;
    for (const one of this.series) {
      if (!one.shown) { one.value.textContent = ""; continue; }
      const [row, part] = between(one.t, t), a = one.y[row], b = one.y[Math.min(row + 1, one.y.length - 1)];
      one.value.textContent = a === null || a === undefined || b === null ? "-"
        : Number((part ? a + part * (b - a) : a).toPrecision(5)).toString();
    }
  }
}

class Charts {
  constructor(player) {
    this.player = player;
    this.last = player.last;
    this.from = 0;
    this.to = this.last > 0 ? this.last : 1;
    this.list = [];
    const place = byId("chartList"), [force, length] = data.units;
    const add = (title, unit, series) => {
      const useful = series.filter((one) => one.t.length > 1);
      if (!useful.length) return;
      const chart = new Chart(this, title, unit, useful);
      this.list.push(chart);
      place.append(chart.figure);
    };
    const few = data.contacts.slice(0, 40);
    add("N of contacts", force, few.map(({ name, motion }) => ({ name, t: motion.t, y: motion.N })));
    add("T of contacts", force, few.map(({ name, motion }) => ({ name, t: motion.t, y: motion.T })));
    const groups = new Map();
    (data.responses.columns || []).forEach((column) => {
      const unit = data.response_units[column.name] || "";
      if (!groups.has(unit)) groups.set(unit, []);
      groups.get(unit).push({ name: column.name, t: data.responses.t, y: column.y });
    });
    for (const [unit, series] of groups) add("Responses", unit, series.slice(0, 40));
    const curves = data.curve.columns.map((column, k) => ({ name: data.curve_names[k], t: data.curve.times[column.t], y: column.u }));
    add("Displacements", length, curves.filter(({ name }) => !name.endsWith(".rz")).slice(0, 80));
    if (!this.list.length) { byId("chartSection").hidden = true; return; }
    this.controls();
    this.draw();
    window.addEventListener("resize", () => this.draw());
    darkGround.addEventListener("change", () => this.draw());
    window.addEventListener("beforeprint", () => this.print(true));
    window.addEventListener("afterprint", () => this.print(false));
  }
  print(on) {
    this.printed = on;
    this.draw();
  }
  controls() {
    const on = (id, act) => byId(id).addEventListener("click", act);
    const about = (factor) => {
      const middle = Math.min(this.to, Math.max(this.from, this.player.t)), size = (this.to - this.from) * factor;
      const part = (middle - this.from) / (this.to - this.from);
      this.zoom(middle - part * size, middle + (1 - part) * size);
    };
    const shift = (part) => {
      const size = this.to - this.from, from = Math.min(this.last - size, Math.max(0, this.from + part * size));
      this.zoom(from, from + size);
    };
    on("closer", () => about(0.5));
    on("farther", () => about(2));
    on("earlier", () => shift(-0.5));
    on("later", () => shift(0.5));
    on("whole", () => this.zoom(0, this.last));
  }
  zoom(from, to) {
    const least = 1e-9 * this.last;
    if (!(to - from > least)) return;
    this.from = Math.max(0, from);
    this.to = Math.min(this.last, to);
    this.draw();
  }
  draw() {
    for (const chart of this.list) chart.draw();
    byId("timesShown").textContent = `${Number(this.from.toPrecision(6))} to ${Number(this.to.toPrecision(6))} ${data.units[2]}`;
    this.read(this.player.t);
  }
  // updatesValues: also update the displayed values; during play this happens ten times per second.
  read(t, updatesValues = true) {
    for (const chart of this.list) chart.read(t, updatesValues);
  }
}
