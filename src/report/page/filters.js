// filters.js: table of contents, filters of the event table by contact and type, and start of the page.
for (const heading of document.querySelectorAll("section > h2")) {
  const link = document.createElement("a");
  link.href = "#" + heading.parentElement.id;
  link.textContent = heading.textContent;
  byId("contents").append(link);
}

const filterEvents = (player) => {
  const table = document.querySelector("#events table");
  if (!table) return;
  const rows = [...table.tBodies[0].rows], column = {};
  [...table.tHead.rows[0].cells].forEach((cell, k) => { column[cell.textContent] = k; });
  const text = (row, name) => row.cells[column[name]].textContent;
  const fill = (id, name) => {
    const values = [...new Set(rows.map((row) => text(row, name)))].filter((value) => value !== "").sort();
    for (const value of values) byId(id).append(new Option(value, value));
    byId(id).addEventListener("change", apply);
  };
  const apply = () => {
    const contact = byId("byContact").value, type = byId("byType").value;
    let count = 0;
    for (const row of rows) {
      row.hidden = contact !== "" && text(row, "contact") !== contact || type !== "" && text(row, "event") !== type;
      count += row.hidden ? 0 : 1;
    }
    byId("shown").textContent = `${count} of ${rows.length}`;
  };
  fill("byContact", "contact");
  fill("byType", "event");
  apply();
  // Rows have the order of data.events, whose times have all digits.
  rows.forEach((row, k) => row.addEventListener("click", () => {
    if (k < data.events.length) player.stop(data.events[k][0]);
  }));
  let marked = [];
  player.onShow = (t) => {
    for (const row of marked) row.classList.remove("here");
    marked = t === null ? [] : rows.filter((row, k) => k < data.events.length && data.events[k][0] === t);
    for (const row of marked) row.classList.add("here");
  };
  player.show(0);
};

// Times in tables are links to the player.
const linkTimes = (player) => {
  for (const cell of document.querySelectorAll("td[data-t]")) {
    cell.tabIndex = 0;
    const go = () => { player.stop(Number(cell.dataset.t)); byId("now").scrollIntoView({ block: "center" }); };
    cell.addEventListener("click", go);
    cell.addEventListener("keydown", (event) => { if (event.key === "Enter") go(); });
  }
};

if (data) {
  plan();
  window.player = new Player();
  window.charts = new Charts(window.player);
  linkTimes(window.player);
  filterEvents(window.player);
}
