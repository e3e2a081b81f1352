"use strict";
// Draws the panels of the page when they come into view; the data are in the element "data", see encode.py.
const read = (id) => JSON.parse(document.getElementById(id).textContent);
const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));

async function unsqueezed(id) {
  const text = document.getElementById(id).textContent.trim();
  const stream = new Blob([bytes(text)]).stream().pipeThrough(new DecompressionStream("gzip"));
  return new Response(stream).text();
}

function unpack(item) {
  const numbers = new Int16Array(bytes(item.packed).buffer);
  const values = Array.from(numbers, (n) => (n === -32768 ? null : item.at + item.step * n));
  const found = item.power ? values.map((v) => 10 ** v) : values;
  if (!item.columns) return found;
  const rows = [];
  for (let k = 0; k < found.length; k += item.columns) rows.push(found.slice(k, k + item.columns));
  return rows;
}

function opened(value) {
  if (Array.isArray(value)) return value.map(opened);
  if (value === null || typeof value !== "object") return value;
  if ("packed" in value) return unpack(value);
  return Object.fromEntries(Object.entries(value).map(([key, item]) => [key, opened(item)]));
}

function moving(panel, plot, film) {
  const bar = panel.querySelector(".slider");
  const input = bar.querySelector("input"), output = bar.querySelector("output"), button = bar.querySelector("button");
  let timer = null;
  const show = (k) => {
    const byTrace = {};
    for (const [key, rows] of Object.entries(film.values)) {
      const dot = key.indexOf(".");
      (byTrace[key.slice(0, dot)] ??= {})[key.slice(dot + 1)] = [rows[k]];
    }
    for (const [trace, update] of Object.entries(byTrace)) Plotly.restyle(plot, update, [Number(trace)]);
    output.textContent = `t = ${film.time[k].toFixed(4)} s`;
  };
  input.max = film.time.length - 1;
  input.value = film.start;
  output.textContent = `t = ${film.time[film.start].toFixed(4)} s`;
  input.addEventListener("input", () => show(Number(input.value)));
  button.addEventListener("click", () => {
    if (timer) { clearInterval(timer); timer = null; button.textContent = "Play"; return; }
    button.textContent = "Stop";
    timer = setInterval(() => {
      input.value = (Number(input.value) + 1) % film.time.length;
      show(Number(input.value));
    }, 90);
  });
}

function draw(panel, content) {
  if (panel.dataset.drawn) return;
  panel.dataset.drawn = "drawing";
  const plot = panel.querySelector(".plot");
  const figure = opened(content);
  const scene = figure.layout.scene;
  if (scene) {
    if (innerWidth < 760) plot.style.height = "330px";
    const back = Math.max(1, 2.1 * plot.clientHeight / plot.clientWidth); // a narrow window sees less along the shaft
    for (const axis of ["x", "y", "z"]) scene.camera.eye[axis] *= back;
  }
  const pointer = matchMedia("(hover: hover)").matches && !panel.closest(".small, .side"); // else the bar hides what is small
  const config = { responsive: true, displaylogo: false, displayModeBar: pointer ? "hover" : false, modeBarButtonsToRemove: ["lasso2d", "select2d"] };
  Plotly.newPlot(plot, figure.data, figure.layout, config).then(() => {
    panel.dataset.drawn = "yes";
    if (figure.moving) moving(panel, plot, figure.moving);
  }).catch((error) => { panel.dataset.drawn = "failed"; console.error(error); });
}

function choose(bearing) {
  document.querySelectorAll(".panel[data-bearing]").forEach((panel) => {
    panel.classList.toggle("other", panel.dataset.bearing !== bearing);
  });
  document.querySelectorAll("tr[data-bearing]").forEach((row) => {
    row.classList.toggle("chosen", row.dataset.bearing === bearing);
  });
}

async function start() {
  if (typeof DecompressionStream === "undefined") throw new Error("this browser is older than 2023 and cannot unpack the page");
  const script = document.createElement("script");
  script.textContent = await unsqueezed("library");
  document.head.append(script);
  const content = JSON.parse(await unsqueezed("data"));
  const watcher = new IntersectionObserver((entries) => {
    for (const entry of entries) if (entry.isIntersecting) draw(entry.target, content[entry.target.id]);
  }, { rootMargin: "300px" });
  document.querySelectorAll(".panel").forEach((panel) => watcher.observe(panel));
  const select = document.getElementById("bearing");
  select?.addEventListener("change", () => choose(select.value));
  document.querySelectorAll("tr[data-bearing]").forEach((row) => row.addEventListener("click", () => {
    if (select) { select.value = row.dataset.bearing; choose(select.value); }
  }));
  if (select) choose(select.value);
  addEventListener("beforeprint", () => document.querySelectorAll(".panel:not(.other)").forEach((p) => draw(p, content[p.id])));
  document.body.dataset.ready = "yes";
}

start().catch((error) => {
  const note = document.createElement("p");
  note.className = "failed";
  note.textContent = `The figures cannot be drawn: ${error.message}. Tables and verdicts are complete.`;
  document.querySelector("main").prepend(note);
  console.error(error);
});
