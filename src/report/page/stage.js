// stage.js: the structure at a time, as the shapes of one SVG. Text of the scene never becomes markup.
const data = JSON.parse(document.getElementById("data").textContent);
const byId = (id) => document.getElementById(id);
const drawn = (name, attributes, parent, text) => {
  const shape = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const key in attributes) shape.setAttribute(key, attributes[key]);
  if (text !== undefined) shape.textContent = text;
  return parent.appendChild(shape);
};

// The last index whose time is <= t, after a jump at t; -1 before the first.
const rowAt = (times, t) => {
  let low = -1, high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= t) low = middle; else high = middle;
  }
  return low;
};
// The last row that is not later than t, and the fraction of the interval to the next row.
const between = (times, t) => {
  const row = Math.max(0, rowAt(times, t));
  const step = row + 1 < times.length ? times[row + 1] - times[row] : 0;
  return [row, step > 0 ? Math.min(1, Math.max(0, (t - times[row]) / step)) : 0];
};
const valueAt = (times, values, t) => {
  if (!times.length) return 0;
  const [row, part] = between(times, t);
  return part ? values[row] + part * (values[row + 1] - values[row]) : values[row];
};

// Displacements [ux, uy, rz] of all nodes at a time, zero for fixed nodes. Every call fills the same arrays.
const moved = data ? data.nodes.map(() => [0, 0, 0]) : [];
// Displacements of meshes: a sum of shapes times their parts at that time. A node with a curve follows its curve.
const moveMesh = (t) => {
  const motion = data.mesh_motion;
  if (!motion) return;
  const free = motion.free ??= motion.nodes.map((k, i) => [k, i]).filter(([k]) => data.nodes[k].mesh);
  const parts = motion.parts.map((part) => valueAt(motion.t, part, t));
  for (const [k, i] of free) {
    let x = 0, y = 0;
    for (let j = 0; j < parts.length; ++j) {
      x += parts[j] * motion.shapes[j][2 * i];
      y += parts[j] * motion.shapes[j][2 * i + 1];
    }
    moved[k][0] = x;
    moved[k][1] = y;
  }
};
const displacementsAt = (t) => {
  const { times, columns } = data.curve;
  data.nodes.forEach((node, k) => {
    for (let i = 0; i < 3; ++i) {
      const column = columns[node.u[i]];
      if (column) moved[k][i] = valueAt(times[column.t], column.u, t);
    }
  });
  moveMesh(t);
  return moved;
};

// Sets an attribute only if it has changed: unchanged shapes are not drawn again.
const put = (shape, key, value) => {
  const last = shape.put ??= {};
  if (last[key] !== value) shape.setAttribute(key, last[key] = value);
};

class Stage {
  constructor(svg) {
    this.svg = svg;
    const xs = data.nodes.map((n) => n.x), ys = data.nodes.map((n) => n.y);
    const low = [Math.min(...xs), Math.min(...ys)], high = [Math.max(...xs), Math.max(...ys)];
    this.size = Math.max(high[0] - low[0], high[1] - low[1], 1e-12);
    if (data.nodes.length < 2) this.size = 1;
    const margin = 0.22 * this.size;
    const width = high[0] - low[0] + 2 * margin, height = high[1] - low[1] + 2 * margin;
    this.wide = Math.max(300, svg.clientWidth);  // one unit is one pixel, so lines and letters keep their size
    this.pixels = Math.min(this.wide / width, (data.nodes.length < 2 ? 260 : 480) / height);
    this.high = Math.max(150, height * this.pixels);
    this.mark = Math.min(26, Math.max(4, 0.3 * this.wide / (data.contacts.length + 1)));
    svg.replaceChildren();
    this.middle = [(low[0] + high[0]) / 2, (low[1] + high[1]) / 2];
    svg.setAttribute("viewBox", `0 0 ${this.wide} ${this.high}`);
  }
  at(x, y) {
    return [this.wide / 2 + (x - this.middle[0]) * this.pixels, this.high / 2 - (y - this.middle[1]) * this.pixels];
  }
  // A piece as a polyline, its motion magnified by m; data.shapes has the shape functions of its ends.
  piece(piece, u, m) {
    const a = data.nodes[piece.a], b = data.nodes[piece.b], ua = u[piece.a], ub = u[piece.b];
    const length = Math.hypot(b.x - a.x, b.y - a.y), c = (b.x - a.x) / length, s = (b.y - a.y) / length;
    const along = [c * ua[0] + s * ua[1], c * ub[0] + s * ub[1]], across = [c * ua[1] - s * ua[0], c * ub[1] - s * ub[0]];
    let path = "";
    for (const [x, fromA, turnA, fromB, turnB] of data.shapes[piece.shape]) {
      const p = along[0] + x * (along[1] - along[0]);
      const q = fromA * across[0] + fromB * across[1] + length * (turnA * ua[2] + turnB * ub[2]);
      const [X, Y] = this.at(a.x + x * length * c + m * (c * p - s * q), a.y + x * length * s + m * (s * p + c * q));
      path += `${path ? "L" : "M"}${X.toFixed(1)} ${Y.toFixed(1)}`;
    }
    return path;
  }
  place(k, u, m) {
    const node = data.nodes[k];
    return this.at(node.x + m * u[k][0], node.y + m * u[k][1]);
  }
  // A zigzag line from one place to another, with `turns` turns.
  zigzag([x, y], [X, Y]) {
    const length = Math.hypot(X - x, Y - y) || 1, c = (X - x) / length, s = (Y - y) / length, turns = 8;
    let path = `M${x} ${y}`;
    for (let i = 1; i < turns; ++i) {
      const p = length * i / turns, q = i % 2 ? 6 : -6;
      path += `L${(x + c * p - s * q).toFixed(1)} ${(y + s * p + c * q).toFixed(1)}`;
    }
    return path + `L${X} ${Y}`;
  }
  // An arrow that ends (or with `leaves` begins) at a place; dx, dy in pixels, upwards positive.
  arrow([x, y], dx, dy, leaves) {
    const length = Math.hypot(dx, dy);
    if (!(length > 2)) return "";
    const [X, Y] = leaves ? [x + dx, y - dy] : [x, y], c = dx / length, s = -dy / length, h = Math.min(9, length / 2);
    const to = (x, y) => `${x.toFixed(1)} ${y.toFixed(1)}`, tip = to(X, Y);
    const head = `M${tip}L${to(X - h * (c - 0.5 * s), Y - h * (s + 0.5 * c))}M${tip}L${to(X - h * (c + 0.5 * s), Y - h * (s - 0.5 * c))}`;
    return `M${to(X - c * length, Y - s * length)}L${tip}` + head;
  }
  // Draws what does not move: grounds of contacts, supports. A ground is drawn at the distance of the gap, magnified by m
  // like the motion; its width is the range of motion of the contact's node.
  fixed(parent, m) {
    const symbols = [];
    for (const support of data.supports) {
      const node = data.nodes[support.node], kind = `${support.ux}${support.uy}${support.rz}`;
      if (node.mesh) {  // draw only as many symbols along a boundary as there is room for
        const here = this.at(node.x, node.y);
        if (symbols.some(([x, y, of]) => of === kind && Math.hypot(x - here[0], y - here[1]) < 24)) continue;
        symbols.push([...here, kind]);
      }
      const [x, y] = this.at(data.nodes[support.node].x, data.nodes[support.node].y);
      const clamp = support.rz ? `M${x - 8} ${y - 8}h16v16h-16z` : "";
      const down = support.uy ? `M${x} ${y}l-9 14h18zM${x - 12} ${y + 17}h24` : "";
      const side = support.ux ? `M${x} ${y}l-14 -9v18zM${x - 17} ${y - 12}v24` : "";
      drawn("path", { class: "held", d: clamp || down + side }, parent);
    }
    for (const contact of data.contacts) {
      if (contact.node < 0 || contact.against.length) continue;
      const [x, y] = this.at(data.nodes[contact.node].x, data.nodes[contact.node].y);
      const nx = contact.nx, ny = -contact.ny, tx = -ny, ty = nx, off = 9 + m * this.pixels * (contact.gap || 0);
      const foot = [x - off * nx, y - off * ny], far = m * this.pixels * this.reach(contact);
      const half = Math.min(this.wide, this.mark + far), hatches = Math.floor(half / 8);
      let path = `M${foot[0] - half * tx} ${foot[1] - half * ty}L${foot[0] + half * tx} ${foot[1] + half * ty}`;
      const every = Math.ceil(16 / this.room(contact));  // along a seam, so that symbols do not overlap
      if (every > 1 && data.contacts.indexOf(contact) % every) { drawn("path", { class: "ground", d: path }, parent); continue; }
      for (let i = -hatches; i <= hatches; ++i)
        path += `M${foot[0] + 8 * i * tx} ${foot[1] + 8 * i * ty}l${-7 * nx - 5 * tx} ${-7 * ny - 5 * ty}`;
      drawn("path", { class: "ground", d: path }, parent);
    }
  }
  // Distance to the nearest other contact in pixels, at most 100.
  room(contact) {
    if (!this.rooms) {
      const at = data.contacts.map((c) => c.node < 0 ? [Infinity, 0] : this.at(data.nodes[c.node].x, data.nodes[c.node].y));
      this.rooms = new Map(data.contacts.map((c, k) => [c, Math.min(100, ...at.filter((_, i) => i !== k && data.contacts[i].node !== c.node)
        .map(([x, y]) => Math.hypot(x - at[k][0], y - at[k][1]) || 100))]));
    }
    return this.rooms.get(contact);
  }
  // Largest displacement of a contact's node along the tangent; for a node of a mesh, from the shapes and their parts.
  reach(contact) {
    const [cx, cy] = data.nodes[contact.node].u;
    if (contact.reach === undefined && data.nodes[contact.node].mesh && data.mesh_motion) {
      const { nodes, shapes, parts, t } = data.mesh_motion, i = nodes.indexOf(contact.node);
      const along = shapes.map((shape) => shape[2 * i] * contact.ny - shape[2 * i + 1] * contact.nx);
      contact.reach = i < 0 ? 0 : Math.max(...t.map((_, j) => Math.abs(along.reduce((sum, a, k) => sum + a * parts[k][j], 0))));
    }
    if (contact.reach === undefined) {
      const { times, columns } = data.curve, both = [columns[cx], columns[cy]];
      const along = (t) => {
        const [x, y] = both.map((column) => column ? valueAt(times[column.t], column.u, t) : 0);
        return Math.abs(x * contact.ny - y * contact.nx);
      };
      contact.reach = 0;
      for (const column of both) if (column) for (const t of times[column.t]) contact.reach = Math.max(contact.reach, along(t));
    }
    return contact.reach;
  }
  spring(spring, u, m) {
    const end = this.place(spring.a, u, m);
    if (spring.b >= 0) return this.zigzag(end, this.place(spring.b, u, m));
    const node = data.nodes[spring.a], [x, y] = this.at(node.x, node.y);
    return this.zigzag(end, [x - 70 * spring.dx, y + 70 * spring.dy]);
  }
  mesh(u, m) {  // bodies
    const places = [];
    const text = (k) => {
      if (!places[k]) {
        const [x, y] = this.place(k, u, m);
        places[k] = `${x.toFixed(1)} ${y.toFixed(1)}`;
      }
      return places[k];
    };
    let path = "";
    for (const [a, b] of data.mesh) path += `M${text(a)}L${text(b)}`;
    return path;
  }
  touched(contact, u, m) {
    const [x, y] = this.place(contact.node, u, m);
    let X = 0, Y = 0;  // weighted sum; the weights add up to one
    for (const [k, part] of contact.against) {
      const place = this.place(k, u, m);
      X += part * place[0];
      Y += part * place[1];
    }
    return `M${x.toFixed(1)} ${y.toFixed(1)}L${X.toFixed(1)} ${Y.toFixed(1)}`;
  }
}

// Puts each label at the first place around its point where it covers no other label, node or member: eight directions,
// then farther away. If there is no such place, the label is placed where it covers least; a contact then has no label,
// since it is also named at the bars of states.
const placeLabels = (stage, g, labels) => {
  const taken = [], still = data.nodes.map(() => [0, 0, 0]);
  for (const node of data.nodes) {
    if (node.mesh) continue;
    const [x, y] = stage.at(node.x, node.y);
    taken.push([x - 5, y - 5, x + 5, y + 5]);
  }
  for (const piece of data.pieces) {  // labels must not cover members: small boxes along them
    const [x, y] = stage.place(piece.a, still, 0), [X, Y] = stage.place(piece.b, still, 0);
    const count = Math.ceil(Math.hypot(X - x, Y - y) / 6);
    for (let i = 0; i <= count; ++i) {
      const px = x + (X - x) * i / count, py = y + (Y - y) * i / count;
      taken.push([px - 2, py - 2, px + 2, py + 2]);
    }
  }
  for (const contact of data.contacts) {  // small boxes along grounds
    if (contact.node < 0 || contact.against.length) continue;
    const [x, y] = stage.place(contact.node, still, 0), nx = contact.nx, ny = -contact.ny;
    for (let s = -stage.mark; s <= stage.mark; s += 6) {
      const px = x - 13 * nx - s * ny, py = y - 13 * ny + s * nx;
      taken.push([px - 4, py - 4, px + 4, py + 4]);
    }
  }
  for (const load of data.loads) {  // small boxes along arrows of loads
    const [x, y] = stage.place(load.node, still, 0);
    for (let s = 0; s <= 60; s += 6) {
      const px = x - s * load.dx, py = y + s * load.dy;
      taken.push([px - 3, py - 3, px + 3, py + 3]);
    }
  }
  const covered = (box) => taken.reduce((sum, other) => sum + Math.max(0, Math.min(box[2], other[2]) - Math.max(box[0], other[0])) *
    Math.max(0, Math.min(box[3], other[3]) - Math.max(box[1], other[1])), 0);
  const around = [[1, -1], [-1, -1], [1, 1], [-1, 1], [0, -1.3], [0, 1.3], [1.2, 0], [-1.2, 0]];
  for (const { text, x, y, far, pale } of labels) {
    const label = drawn("text", pale ? { class: "pale" } : {}, g, text), size = label.getBBox();
    let best = null;
    for (const distance of [far, 2 * far, 3.5 * far, 5 * far, 7 * far, 10 * far]) {
      for (const [dx, dy] of around) {
        const wide = size.width, high = 14, cx = x + dx * distance + Math.sign(dx) * wide / 2, cy = y + dy * distance;
        const left = Math.min(stage.wide - wide - 2, Math.max(2, cx - wide / 2));
        const box = [left - 1, cy - high / 2, left + wide + 1, cy + high / 2];
        const outside = box[1] < 0 || box[3] > stage.high ? 1e6 : 0, cost = covered(box) + outside;
        if (!best || cost < best.cost - 1e-9) best = { cost, box, left, base: cy + 4.5, distance };
      }
      if (best.cost < 1) break;
    }
    if (pale && best.cost > 30) { label.remove(); continue; }  // contacts are also named at the bars of states
    label.setAttribute("x", best.left.toFixed(1));
    label.setAttribute("y", best.base.toFixed(1));
    taken.push(best.box);
    if (best.distance > 2 * far) {  // a line connects a distant label to its point
      const bx = Math.min(best.box[2], Math.max(best.box[0], x)), by = Math.min(best.box[3], Math.max(best.box[1], y));
      drawn("path", { class: "leader", d: `M${x.toFixed(1)} ${y.toFixed(1)}L${bx.toFixed(1)} ${by.toFixed(1)}` }, g);
    }
  }
};

const plan = () => {
  const stage = new Stage(byId("plan")), still = data.nodes.map(() => [0, 0, 0]), g = drawn("g", {}, stage.svg);
  stage.fixed(g, 0);
  if (data.mesh.length) drawn("path", { class: "mesh", d: stage.mesh(still, 0) }, g);
  for (const spring of data.springs) drawn("path", { class: "spring", d: stage.spring(spring, still, 0) }, g);
  for (const piece of data.pieces) drawn("path", { class: piece.bar ? "member bar" : "member", d: stage.piece(piece, still, 0) }, g);
  const few = data.nodes.filter((node) => !node.mesh).length <= 40, labels = [];
  data.nodes.forEach((node, k) => {
    if (node.mesh) return;
    const [x, y] = stage.at(node.x, node.y);
    drawn("circle", { class: "node", cx: x, cy: y, r: few ? 4 : 2 }, g);
    if (few) labels.push({ text: node.name, x, y, far: 12 });
  });
  for (const load of data.loads) {
    const [x, y] = stage.place(load.node, still, 0);
    drawn("path", { class: "load", d: stage.arrow([x, y], 60 * load.dx, 60 * load.dy, false) }, g);
    labels.push({ text: load.name, x: x - 66 * load.dx, y: y + 66 * load.dy, far: 8 });
  }
  data.contacts.forEach((contact) => {
    if (contact.node < 0) return;
    if (contact.against.length) drawn("path", { class: "spring", d: stage.touched(contact, still, 0) }, g);
    const [x, y] = stage.place(contact.node, still, 0);
    if (few) labels.push({ text: contact.name, x: x - 22 * contact.nx, y: y + 22 * contact.ny, far: 10, pale: true });
  });
  placeLabels(stage, g, labels);
};
